#include "core/simulation/comparison.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/simulation/internal/block_index.h"
#include "core/simulation/internal/block_sweep.h"
#include "core/simulation/internal/material_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace millwright::simulation {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
/// Material beside a point counts where it is nearer than this share of the distance along the normal.
constexpr double much_nearer = 0.5;

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

/// The same for a cylinder or a tube.
double height_of_cylinder(const CylinderStock& stock, const PartPoint& at) {
    const int k = stock.axis, u = (k + 1) % 3, v = (k + 2) % 3;
    const Vec3 from = at.point - stock.base;
    const Vec2 across(from[u], from[v]), slope(at.normal[u], at.normal[v]);
    const double outer = 0.5 * stock.diameter, inner = 0.5 * stock.bore;
    const double beside = std::max({across.norm() - outer, inner - across.norm(), 0.0});
    const double beyond = std::max({-from[k], from[k] - stock.length, 0.0});
    if (beside > 0.0 || beyond > 0.0) {
        return -std::hypot(beside, beyond);
    }
    double height = never;
    if (std::abs(at.normal[k]) > 0.0) {
        height = ((at.normal[k] > 0.0 ? stock.length : 0.0) - from[k]) / at.normal[k];
    }
    const double square = slope.squaredNorm();
    if (square > 0.0) {
        const double half = across.dot(slope) / square;
        const auto root = [&](double radius) {
            return half * half - (across.squaredNorm() - radius * radius) / square;
        };
        height = std::min(height, -half + std::sqrt(std::max(root(outer), 0.0)));
        const double bore = root(inner);
        if (inner > 0.0 && bore >= 0.0 && half <= 0.0) {
            height = std::min(height, std::max(-half - std::sqrt(bore), 0.0));
        }
    }
    return height;
}

/// Of the uncut stock, along the normal; infinite where only moves can have made the end. Of a mesh by the
/// lines of the field.
double height_of_stock(const Stock& stock, const MaterialProbe& probe, const PartPoint& at) {
    if (const auto* box = std::get_if<BoxStock>(&stock)) {
        return height_of_box(Box3(box->low, box->high), at);
    }
    if (const auto* cylinder = std::get_if<CylinderStock>(&stock)) {
        return height_of_cylinder(*cylinder, at);
    }
    const std::optional<MaterialEnd> end = probe.end(at.point, at.normal);
    return end && end->move == stock_surface ? end->way : never;
}

/// Of blocks around a point: all long moves, and of the short ones those that are lowest at a glance.
std::vector<int>
promising(const SimulationInput& input, const std::vector<int>& blocks, const PartPoint& at) {
    std::vector<std::pair<double, int>> seen;
    for (const int block : blocks) {
        const double height = BlockSweep(input, block, *tool_of(input, block)).glance(at.point, at.normal);
        if (height < never) {
            seen.emplace_back(height, block);
        }
    }
    std::ranges::sort(seen);
    constexpr int most_short_moves = 6;
    int short_moves = 0;
    std::vector<int> chosen;
    for (const auto& [height, block] : seen) {
        if (!(height > -never) || ++short_moves <= most_short_moves) {
            chosen.push_back(block);
        }
    }
    return chosen;
}

/// By the moves that made the ends near the point, and those whose tool passed it.
Deviation deviation_by_moves(const SimulationInput& input,
                             const DexelField& field,
                             const BlockIndex& index,
                             const MaterialProbe& probe,
                             const PartPoint& at) {
    Deviation deviation{height_of_stock(input.stock, probe, at), -1};
    if (deviation.height < 0.0) {
        return deviation;
    }
    const NearBlocks near(field, at.point);
    std::vector<int> passing;
    index.add_around(at.point, passing);
    double deepest = 0.0; // in any tool, whatever the direction
    for (const int block : near.blocks()) {
        const ToolUse* tool = tool_of(input, block);
        if (tool == nullptr) {
            continue;
        }
        const BlockSweep sweep(input, block, *tool);
        const double height = sweep.height(at.point, at.normal);
        if (height < 0.0) {
            deepest = std::max(deepest, sweep.depth(at.point, at.normal));
        }
        if (height < deviation.height) {
            deviation = {height, block};
        }
    }
    for (const int block : promising(input, passing, at)) {
        if (std::ranges::binary_search(near.blocks(), block)) {
            continue;
        }
        const BlockSweep sweep(input, block, *tool_of(input, block));
        const double depth = sweep.depth(at.point, at.normal);
        if (!(depth > 0.0)) {
            continue;
        }
        deepest = std::max(deepest, depth);
        const double height = sweep.height(at.point, at.normal);
        if (height < deviation.height) {
            deviation = {height, block};
        }
    }
    // At an edge of the part the normal can run along a cut that is hardly touched.
    if (deviation.height < 0.0 && deepest < -much_nearer * deviation.height) {
        deviation.height = -deepest;
    }
    return deviation;
}

/// Of a point that has no material within a cell: down to the next material, or to that beside the point
/// where it is much nearer.
Deviation deviation_of_void(const DexelField& field, const MaterialProbe& probe, const PartPoint& at) {
    const Vec3 inwards = -at.normal;
    const double outside = std::sqrt(field.box().squaredExteriorDistance(at.point));
    const double least = std::max(outside, field.cell().minCoeff());
    Deviation deviation;
    const std::optional<MaterialEnd> below = probe.next(at.point, inwards);
    deviation.height = -std::max(below ? below->way : probe.way_out(at.point, inwards), least);
    deviation.block = below ? below->move : -1;
    const std::optional<MaterialEnd> beside = probe.nearest_on_lines(at.point);
    if (beside && beside->way < (below ? -much_nearer : -1.0) * deviation.height) {
        deviation.height = -std::max(beside->way, least);
        deviation.block = beside->move;
    }
    deviation.at_least = !below && !beside;
    return deviation;
}

/// Of a point outside of the stock: whether the stock's nearest point still has material.
bool is_uncut_beside(const Stock& stock, const MaterialProbe& probe, const PartPoint& at) {
    constexpr double apart = 1e-4; // mm, of the differences
    const auto outside = [&](const Vec3& point) {
        return std::min(height_of_stock(stock, probe, {point, at.normal, 0.0}), 0.0);
    };
    Vec3 towards = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = apart * Vec3::Unit(axis);
        towards[axis] = outside(at.point + step) - outside(at.point - step);
    }
    const double length = towards.norm();
    return length > 0.0 && probe.is_near(at.point - outside(at.point) / length * towards);
}

Deviation deviation_at(const SimulationInput& input,
                       const DexelField& field,
                       const BlockIndex& index,
                       const PartPoint& at) {
    const MaterialProbe probe(field);
    Deviation deviation = deviation_by_moves(input, field, index, probe, at);
    const double uncertain = 2.0 * field.cell().norm();
    if (deviation.height < 0.0 && deviation.block < 0 && is_uncut_beside(input.stock, probe, at)) {
        return deviation;
    }
    if (!probe.is_near(at.point)) {
        const Deviation missing = deviation_of_void(field, probe, at);
        if (deviation.height >= 0.0 || missing.at_least || missing.height < deviation.height - uncertain) {
            const double known = std::min(deviation.height, missing.height);
            deviation = {known, missing.block >= 0 ? missing.block : deviation.block, missing.at_least};
        }
    } else if (!(deviation.height < never)) {
        const std::optional<MaterialEnd> end = probe.end(at.point, at.normal);
        deviation = end ? Deviation{end->way, end->move} : Deviation{0.0, -1};
    }
    return deviation;
}

} // namespace

std::vector<Deviation> deviations(const SimulationInput& input,
                                  const Simulation& found,
                                  std::span<const PartPoint> points,
                                  const Progress& progress) {
    return deviations(input, *found.field, found.first_block, points, progress);
}

std::vector<Deviation> deviations(const SimulationInput& input,
                                  const DexelField& field,
                                  int first_block,
                                  std::span<const PartPoint> points,
                                  const Progress& progress) {
    std::vector<Deviation> result(points.size());
    const BlockIndex index(input, first_block);
    constexpr std::ptrdiff_t points_per_chunk = 16, points_per_report = 1024;
    const std::ptrdiff_t count = std::ssize(result);
    for (std::ptrdiff_t first = 0; first < count; first += points_per_report) {
        parallel_for(std::min(points_per_report, count - first), points_per_chunk, [&](std::ptrdiff_t n) {
            progress.check();
            const auto at = static_cast<std::size_t>(first + n);
            result[at] = deviation_at(input, field, index, points[at]);
        });
        progress.report(static_cast<double>(std::min(first + points_per_report, count)) /
                        static_cast<double>(count));
    }
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
        if (std::abs(here.height) <= tolerance && !here.at_least) {
            summary.within += area;
        } else {
            (here.height < 0.0 ? summary.gouged : summary.in_excess) += area;
        }
        auto& worst = here.height < 0.0 ? summary.gouge : summary.excess;
        if (!worst || std::abs(here.height) > std::abs(worst->height)) {
            worst = WorstDeviation{here.height, here.block, points[n].point, here.at_least};
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
