// The way of the tool tip through a program, made to be drawn and pointed at: millions of moves in few bytes,
// in chunks that never change, each coarser where it is looked at from afar. Lengths mm.
#pragma once

#include "core/gcode/execution.h"
#include "core/geometry/vectors.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::gcode {

enum class PathKind : std::uint8_t {
    start, ///< nothing leads there
    rapid,
    feed,
    probe
};

/// Where a straight piece of the way ends, and the step that asks for it.
class PreviewPoint {
public:
    PreviewPoint() = default;
    /// Throws Defect if `step` is too large to be kept (2^30).
    PreviewPoint(const Vec3& position, Step step, PathKind kind);

    [[nodiscard]] Vec3 position() const { return Eigen::Vector3f(x_, y_, z_).cast<double>(); }
    [[nodiscard]] const float* xyz() const { return &x_; }
    [[nodiscard]] Step step() const { return packed_ & step_mask; }
    [[nodiscard]] PathKind kind() const { return static_cast<PathKind>(packed_ >> step_bits); }

private:
    static constexpr unsigned step_bits = 30;
    static constexpr std::uint32_t step_mask = (1U << step_bits) - 1U;

    float x_ = 0.0F, y_ = 0.0F, z_ = 0.0F;
    std::uint32_t packed_ = 0;
};
static_assert(sizeof(PreviewPoint) == 16);

/// A stretch of a chunk with a box around it, and what may stand for it from afar.
struct PathBlock {
    static constexpr std::size_t coarse_levels = 3;
    /// A selection of the block's points, the first and the last among them.
    struct Level {
        std::uint32_t first = 0; ///< into PathChunk::indices
        std::uint32_t count = 0;
        float error = 0.0F; ///< mm: no point is farther from the drawn line
    };

    std::uint32_t first = 0; ///< point
    std::uint32_t count = 0; ///< of points; the last is the first of the next block
    std::array<float, 3> min{}, max{};
    std::array<Level, coarse_levels> levels; ///< each coarser than the one before
    double start_time = 0.0;                 ///< s at its first point, as fast as programmed
};

/// A place on a path: in the piece that ends at `point`.
struct PathPlace {
    std::int64_t point = 0;
    double fraction = 1.0; ///< of the piece

    friend bool operator==(const PathPlace&, const PathPlace&) = default;
};

struct PathChunk {
    static constexpr std::size_t most_points = 65'534; ///< indices have 16 bits, one of them is no point

    std::int64_t first = 0;           ///< number of its first point in the whole path
    std::vector<PreviewPoint> points; ///< the first is the last of the chunk before
    std::vector<PathBlock> blocks;
    std::vector<std::uint16_t> indices;
    std::array<float, 3> min{}, max{};
    double start_time = 0.0; ///< s at its first point, as fast as programmed
    double end_time = 0.0;   ///< at its last

    [[nodiscard]] std::size_t bytes() const;
};

/// Puts points together into chunks.
class PathChunker {
public:
    /// A chunk is full, if there is one: to be called after each add.
    [[nodiscard]] std::shared_ptr<const PathChunk> take_full();
    /// What is left; null if nothing is.
    [[nodiscard]] std::shared_ptr<const PathChunk> take_rest();

    /// `seconds`: that the piece takes as programmed.
    void add(const PreviewPoint& point, double seconds);

    [[nodiscard]] std::int64_t count() const { return before_ + std::ssize(points_); }

private:
    [[nodiscard]] std::shared_ptr<const PathChunk> take();

    std::int64_t before_ = 0; ///< points of earlier chunks, without the shared one
    std::vector<PreviewPoint> points_;
    std::vector<float> seconds_; ///< of the piece that ends at each point
    double start_time_ = 0.0;
};

/// All chunks so far. A value: cheap to copy.
struct PreviewPath {
    std::vector<std::shared_ptr<const PathChunk>> chunks;

    [[nodiscard]] std::int64_t point_count() const;
    [[nodiscard]] bool empty() const { return chunks.empty(); }
    [[nodiscard]] Box3 bounds() const;
    /// Throws Defect if there is no such point.
    [[nodiscard]] const PreviewPoint& point(std::int64_t n) const;
    /// The points of a step: the first and one past the last; an empty range at the place where they would
    /// be.
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> points_of(Step step) const;
    [[nodiscard]] Vec3 position(const PathPlace& place) const;
    /// Where the tip is after so many seconds, as fast as programmed; inside of a block of points its speed
    /// is taken as even. Throws Defect if the path is empty.
    [[nodiscard]] PathPlace place_at(double seconds) const;
    [[nodiscard]] double time_of(const PathPlace& place) const;
    [[nodiscard]] std::size_t bytes() const;

private:
    [[nodiscard]] const PathChunk& chunk_of(std::int64_t n) const;
    [[nodiscard]] std::int64_t first_point_from(Step step) const;
};

} // namespace millwright::gcode
