// One tile of lines and the steps that may reach it.
#pragma once

#include "core/simulation/dexel_field.h"
#include "core/simulation/internal/tile_sweep.h"
#include "core/simulation/removal.h"

#include <array>
#include <optional>
#include <vector>

namespace millwright::simulation {

/// A step with what all tiles need of it.
struct ReadyStep {
    ReadyStep(const CutStep& step, const Vec3& cell);

    const CutStep* step;
    SweptCutter cutter;
    std::optional<SweptCutter> core; ///< of a step whose contact counts
    geometry::ToolPose middle;
    Vec3 across; ///< unit vector across axis and way
    Box3 bounds;
    BodyRay near_line;                 ///< holds all of the swept body, placed at the middle pose
    std::array<TileMotion, 3> motions; ///< a family of lines each
    std::array<BodyRay, 3> near_tile;  ///< near_line and half the diagonal of a tile
};

/// What one step did to one tile.
struct TileCut {
    std::int32_t move = 0;
    ToolPart part = ToolPart::cutter;
    double length = 0.0; ///< of all that was removed, along the lines
    std::optional<Contact> contact{};
    Engagement engaged{};
};

class TileCutter {
public:
    /// The tile in column `i` and row `j` of family `k`.
    TileCutter(DexelField& field, int k, int i, int j);
    TileCutter(const TileCutter&) = delete;
    TileCutter& operator=(const TileCutter&) = delete;
    ~TileCutter();

    /// False where nothing was met.
    bool cut(const ReadyStep& step, TileCut& found);

private:
    struct Pending;
    [[nodiscard]] bool may_reach(const ReadyStep& step) const;
    [[nodiscard]] bool is_void(const Interval& range) const;
    bool find_material(const ReadyStep& step);
    [[nodiscard]] Interval material(std::size_t line, double from, double to) const;
    void settle(const ReadyStep& step, std::size_t line);
    void attempt_between(const TileMotion& motion, Pending* pending, std::size_t count);
    void search_all(const TileMotion& motion);
    void finish(const ReadyStep& step, const TileMotion& motion);
    [[nodiscard]] Vec3 place_of(const ReadyStep& step, std::size_t line) const;
    void touch(const ReadyStep& step, std::size_t line, const Vec3& at, TileCut& found) const;
    void subtract(const ReadyStep& step, std::size_t line, TileCut& found);
    void copy_lines(std::size_t from, std::size_t to);
    void replace_lines(float middle);

    const DexelField& field_;
    Tile& tile_;
    int k_, u_, v_;
    double face_; // coordinate k of the box's lower face: lines are counted from there
    int first_u_, first_v_, count_u_, count_v_; // cells
    Vec3 center_;
    TileLines lines_;
    std::array<Interval, Tile::lines> cuts_{}; // of the step at hand; from > to: none
    std::vector<Pending> pending_;             // lines that need a search
    std::vector<LaneSearch> searches_;
    std::vector<std::uint32_t> owners_; // of the searches: index in pending_, and which end
    std::vector<Dexel> next_;           // of all lines, being made
    std::array<std::uint32_t, Tile::lines + 1> next_first_{};
};

} // namespace millwright::simulation
