#include "core/simulation/comparison.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/kinematics/forward.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace millwright::simulation {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The way of one block's tool.
class BlockSweep {
public:
    BlockSweep(const SimulationInput& input, int block, const toolpath::Profile& body)
        : body_(&body), way_(input.machine,
                             program::position_before(input.program, block),
                             input.program.blocks[static_cast<std::size_t>(block)].target) {
        double length = 0.0;
        geometry::ToolPose last = way_.at(0.0);
        constexpr int coarse = 8;
        for (int n = 1; n <= coarse; ++n) {
            const geometry::ToolPose next = way_.at(static_cast<double>(n) / coarse);
            length += (next.tip - last.tip).norm() + body.shape().top * angle_between(last.axis, next.axis);
            last = next;
        }
        const double step = 0.25 * body.shape().radius; // between two looks
        constexpr double least = 12.0, most = 2000.0;
        looks_ = static_cast<int>(std::clamp(std::ceil(length / step), least, most));
    }

    /// The least height over `at` along its normal; infinite where the tool does not come over it.
    [[nodiscard]] double height(const PartPoint& at) const {
        return least(
            [&](double f) { return toolpath::height_over(*body_, way_.at(f), at.point, at.normal); });
    }
    /// How deep the point is in the tool, whatever the direction; below 0: outside.
    [[nodiscard]] double depth(const Vec3& point) const {
        return -least([&](double f) { return toolpath::distance(*body_, way_.at(f), point); });
    }

private:
    /// Of a function of the move's fraction: the least of many looks, and a golden section around it.
    template <class Value> [[nodiscard]] double least(const Value& value) const {
        int best = 0;
        double lowest = never;
        for (int n = 0; n <= looks_; ++n) {
            const double here = value(static_cast<double>(n) / looks_);
            if (here < lowest) {
                lowest = here;
                best = n;
            }
        }
        if (!(lowest < never)) {
            return never;
        }
        double low = std::max(best - 1.0, 0.0) / looks_;
        double high = std::min(best + 1.0, static_cast<double>(looks_)) / looks_;
        constexpr double golden = 0.6180339887498949;
        constexpr int most_steps = 32;
        for (int n = 0; n < most_steps; ++n) {
            const double a = high - golden * (high - low);
            const double b = low + golden * (high - low);
            const double at_a = value(a), at_b = value(b);
            lowest = std::min({lowest, at_a, at_b});
            (at_a < at_b ? high : low) = at_a < at_b ? b : a;
        }
        return lowest;
    }

    const toolpath::Profile* body_;
    kinematics::StraightForward way_;
    int looks_ = 1;
};

/// Blocks that made the ends of material near a place.
class NearBlocks {
public:
    NearBlocks(const DexelField& field, const Vec3& place) : field_(field) {
        for (int k = 0; k < 3; ++k) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            const auto [i0, i1] = cells(place, u);
            const auto [j0, j1] = cells(place, v);
            for (int j = j0; j <= j1; ++j) {
                for (int i = i0; i <= i1; ++i) {
                    add_line(field.line(k, i, j), static_cast<float>(place[k] - field.box().min()[k]));
                }
            }
        }
        std::ranges::sort(blocks_);
        blocks_.erase(std::unique(blocks_.begin(), blocks_.end()), blocks_.end());
    }
    [[nodiscard]] const std::vector<int>& blocks() const { return blocks_; }

private:
    /// The four cells around the place along an axis: two, and one more on each side for narrow cuts.
    [[nodiscard]] std::array<int, 2> cells(const Vec3& place, int axis) const {
        const double at = (place[axis] - field_.box().min()[axis]) / field_.cell()[axis] - 0.5;
        const double last = field_.count()[static_cast<std::size_t>(axis)] - 1;
        return {static_cast<int>(std::clamp(std::floor(at) - 1.0, 0.0, last)),
                static_cast<int>(std::clamp(std::floor(at) + 2.0, 0.0, last))};
    }
    /// The nearest ends on both sides.
    void add_line(std::span<const Dexel> pieces, float at) {
        float below = std::numeric_limits<float>::lowest(), above = std::numeric_limits<float>::max();
        std::int32_t made_below = stock_surface, made_above = stock_surface;
        for (const Dexel& piece : pieces) {
            for (const auto& [end, move] :
                 {std::pair(piece.from, piece.from_move), std::pair(piece.to, piece.to_move)}) {
                if (end <= at && end >= below) {
                    below = end;
                    made_below = move;
                }
                if (end >= at && end < above) {
                    above = end;
                    made_above = move;
                }
            }
        }
        for (const std::int32_t move : {made_below, made_above}) {
            if (move != stock_surface) {
                blocks_.push_back(move);
            }
        }
    }

    const DexelField& field_;
    std::vector<int> blocks_;
};

/// Along the normal to where the box ends; below 0 outside of it.
double height_of_box(const Box3& box, const PartPoint& at) {
    if (!box.contains(at.point)) {
        return -std::sqrt(box.squaredExteriorDistance(at.point));
    }
    double height = never;
    for (int axis = 0; axis < 3; ++axis) {
        const double slope = at.normal[axis];
        if (std::abs(slope) > 0.0) {
            const double face = slope > 0.0 ? box.max()[axis] : box.min()[axis];
            height = std::min(height, (face - at.point[axis]) / slope);
        }
    }
    return height;
}

const toolpath::Profile* tool_of(const SimulationInput& input, int block) {
    const toolpath::Profile* found = nullptr;
    for (const ToolUse& tool : input.tools) {
        if (tool.first_block <= block) {
            found = tool.body ? &*tool.body : nullptr;
        }
    }
    return found;
}

Deviation deviation_at(const SimulationInput& input, const DexelField& field, const PartPoint& at) {
    Deviation deviation{height_of_box(field.box(), at), -1};
    if (deviation.height < 0.0) {
        return deviation;
    }
    const NearBlocks near(field, at.point);
    double deepest = 0.0; // in any tool, whatever the direction
    for (const int block : near.blocks()) {
        const toolpath::Profile* tool = tool_of(input, block);
        if (tool == nullptr) {
            continue;
        }
        const BlockSweep sweep(input, block, *tool);
        const double height = sweep.height(at);
        if (height < 0.0) {
            deepest = std::max(deepest, sweep.depth(at.point));
        }
        if (height < deviation.height) {
            deviation = {height, block};
        }
    }
    // At an edge of the part the normal can run along a cut that is hardly touched.
    constexpr double much_nearer = 0.5;
    if (deviation.height < 0.0 && deepest < -much_nearer * deviation.height) {
        deviation.height = -deepest;
    }
    return deviation;
}

} // namespace

std::vector<Deviation> deviations(const SimulationInput& input,
                                  const Simulation& found,
                                  std::span<const PartPoint> points,
                                  const Progress& progress) {
    std::vector<Deviation> result(points.size());
    constexpr std::ptrdiff_t points_a_chunk = 16;
    parallel_for(std::ssize(result), points_a_chunk, [&](std::ptrdiff_t n) {
        progress.check();
        result[static_cast<std::size_t>(n)] =
            deviation_at(input, *found.field, points[static_cast<std::size_t>(n)]);
    });
    return result;
}

ComparisonSummary
summary_of(std::span<const PartPoint> points, std::span<const Deviation> deviations, double tolerance) {
    expects(points.size() == deviations.size(), "every point of the part has a deviation");
    ComparisonSummary summary;
    for (std::size_t n = 0; n < points.size(); ++n) {
        const Deviation& here = deviations[n];
        const double area = points[n].area;
        summary.area += area;
        if (std::abs(here.height) <= tolerance) {
            summary.within += area;
        } else {
            (here.height < 0.0 ? summary.gouged : summary.in_excess) += area;
        }
        auto& worst = here.height < 0.0 ? summary.gouge : summary.excess;
        if (!worst || std::abs(here.height) > std::abs(worst->height)) {
            worst = WorstDeviation{here.height, here.block, points[n].point};
        }
    }
    if (summary.area > 0.0) {
        summary.within /= summary.area;
        summary.gouged /= summary.area;
        summary.in_excess /= summary.area;
    }
    return summary;
}

} // namespace millwright::simulation
