// What is left of a stock, as the material along three families of parallel lines (tri-dexels). The lines
// along X, Y and Z pass through the same lattice: the middles of cells that divide the stock's box evenly.
// Each end of a piece of material keeps the move that made it. Lines lie in tiles of 8 x 8. Lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/simulation/stock.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace millwright::simulation {

/// The id of an end that is the stock's own surface.
inline constexpr std::int32_t stock_surface = -1;

/// A piece of material along a line, counted from the box's lower face.
struct Dexel {
    float from = 0.0F, to = 0.0F;
    std::int32_t from_move = stock_surface, to_move = stock_surface;

    friend bool operator==(const Dexel&, const Dexel&) = default;
};

/// Lines of 8 x 8 cells. Material never grows.
struct Tile {
    static constexpr int side = 8;
    static constexpr std::size_t lines = 64;

    std::vector<Dexel> dexels;                    ///< of all lines, one after another
    std::array<std::uint32_t, lines + 1> first{}; ///< where each begins
    float low = 0.0F, high = 0.0F;                ///< all material is between
    float void_from = 0.0F, void_to = 0.0F;       ///< no line has any between; may be empty
    std::uint32_t version = 0;                    ///< how many steps have removed anything from it

    [[nodiscard]] std::span<const Dexel> line(std::size_t n) const {
        return std::span(dexels).subspan(first[n], first[n + 1] - first[n]);
    }
    /// Finds low and high anew, and the void around `middle` if it is the longer one.
    void look(float middle);
};

/// How many lines a stock asks for, before any are made.
struct FieldSize {
    std::array<int, 3> count{}; ///< cells along X, Y and Z
    std::size_t lines = 0;      ///< of the three families
    std::size_t bytes = 0;      ///< forecast for a part of usual shape: two pieces of material a line
};

/// Throws Defect unless `pitch` is above 0 and the box is not empty.
[[nodiscard]] FieldSize field_size(const Box3& box, double pitch);
/// The finest pitch whose forecast stays within `bytes`, mm.
[[nodiscard]] double pitch_within(const Box3& box, std::size_t bytes);

class DexelField {
public:
    /// The stock uncut. Cells are not longer than `pitch` mm. Throws Error for a stock with a fault, and with
    /// the numbers where the forecast is above `most_bytes`; Cancelled.
    DexelField(const Stock& stock, double pitch, std::size_t most_bytes, const Progress& progress);

    [[nodiscard]] const Box3& box() const { return box_; }
    [[nodiscard]] const std::array<int, 3>& count() const { return size_.count; }
    /// Length of a cell along each axis.
    [[nodiscard]] const Vec3& cell() const { return cell_; }
    /// The middle of cell `n` along an axis.
    [[nodiscard]] double middle(int axis, int n) const { return box_.min()[axis] + (n + 0.5) * cell_[axis]; }

    /// The material of the line along axis `k` through cells i, j of axes (k+1)%3 and (k+2)%3.
    [[nodiscard]] std::span<const Dexel> line(int k, int i, int j) const;
    /// Whether the point at the middle of a cell is material, by its line along Z.
    [[nodiscard]] bool filled(int x, int y, int z) const;

    /// mm^3. Every cell that the surface passes through is weighed by the line of the three that passes the
    /// surface nearest to its middle: exact for planes across the axes, of second order for others.
    [[nodiscard]] double volume() const;

    /// Bytes that are in use now.
    [[nodiscard]] std::size_t bytes() const;

    /// For callers that remove material. Tiles of one family, the first axis fastest.
    [[nodiscard]] std::array<int, 2> tile_count(int k) const;
    [[nodiscard]] Tile& tile(int k, int i, int j);
    [[nodiscard]] const Tile& tile(int k, int i, int j) const;
    /// All tiles of a family, in that order.
    [[nodiscard]] std::span<Tile> tiles(int k) { return tiles_[static_cast<std::size_t>(k)]; }
    [[nodiscard]] std::span<const Tile> tiles(int k) const { return tiles_[static_cast<std::size_t>(k)]; }

private:
    void fill(const Stock& stock, int k);
    [[nodiscard]] double filled_part(int k, const std::array<int, 3>& cell) const;
    /// Cells of a layer across X, by `layer_key`; a cell may be there twice.
    using LayerCells = std::vector<std::uint64_t>;
    [[nodiscard]] int cell_at(int axis, float at) const;
    [[nodiscard]] std::uint64_t layer_key(int y, int z) const;
    [[nodiscard]] std::vector<LayerCells> ends_along_x() const;
    void add_ends_across_x(int x, LayerCells& ends) const;
    [[nodiscard]] double length_along_z(int x) const;
    [[nodiscard]] double layer_volume(int x, LayerCells ends) const;

    Box3 box_;
    FieldSize size_;
    Vec3 cell_ = Vec3::Ones();
    std::array<std::vector<Tile>, 3> tiles_;
};

} // namespace millwright::simulation
