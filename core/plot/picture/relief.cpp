#include "core/plot/picture/relief.h"

#include "core/base/parallel.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/internal/checks.h"
#include "core/plot/picture/internal/tip_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace millwright::plot {
namespace {

// The moves of one row of a relief. mm.

struct Node {
    double x = 0.0;
    double z = 0.0;
};

/// A node for each height, `pitch` apart from x = 0 on, higher by `allowance`.
std::vector<Node> nodes_of(const std::vector<float>& heights, double pitch, double allowance) {
    std::vector<Node> nodes;
    nodes.reserve(heights.size());
    for (std::size_t j = 0; j < heights.size(); ++j) {
        nodes.push_back({static_cast<double>(j) * pitch, static_cast<double>(heights[j]) + allowance});
    }
    return nodes;
}

/// Some of the nodes, with both ends, in the order given (which may run either way): straight moves between
/// them are nowhere below those between all, and nowhere above them by more than `tolerance`.
// From the last node that is kept, moves to later ones are possible as long as their slope passes above every
// node between, and not too far.
std::vector<Node> merged(const std::vector<Node>& nodes, double tolerance) {
    constexpr double rounding = 5e-7; // of heights that are floats: equal slopes are equal
    std::vector<Node> kept = {nodes.front()};
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    for (std::size_t n = 1; n < nodes.size(); ++n) {
        const Node& from = kept.back();
        const double way = std::abs(nodes[n].x - from.x);
        const double slope = (nodes[n].z - from.z) / way;
        if (slope < least || slope > most) {
            kept.push_back(nodes[n - 1]);
            least = -std::numeric_limits<double>::infinity();
            most = std::numeric_limits<double>::infinity();
            --n;
            continue;
        }
        least = std::max(least, slope - rounding / way);
        most = std::min(most, (nodes[n].z + tolerance + rounding - from.z) / way);
    }
    if (nodes.size() > 1) {
        kept.push_back(nodes.back());
    }
    return kept;
}

/// The parts of the row where something below `ceiling` is to be cut, each with its neighbours on both sides;
/// parts nearer to each other than `nearest` are one.
std::vector<std::vector<Node>> runs_below(const std::vector<Node>& nodes, double ceiling, double nearest) {
    struct Range {
        std::size_t first = 0;
        std::size_t last = 0;
    };
    std::vector<Range> ranges;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (!(nodes[n].z < ceiling)) {
            continue;
        }
        const Range here{n == 0 ? 0 : n - 1, std::min(n + 1, nodes.size() - 1)};
        const bool near =
            !ranges.empty() && std::abs(nodes[here.first].x - nodes[ranges.back().last].x) < nearest;
        if (near) {
            ranges.back().last = here.last;
        } else {
            ranges.push_back(here);
        }
    }
    std::vector<std::vector<Node>> runs;
    for (const Range& range : ranges) {
        runs.emplace_back(nodes.begin() + static_cast<std::ptrdiff_t>(range.first),
                          nodes.begin() + static_cast<std::ptrdiff_t>(range.last) + 1);
    }
    return runs;
}

using internal::check_above_zero;
using internal::check_not_below_zero;
using internal::TipSurface;

constexpr double most_points = 1e8;

void check_relief_settings(const ReliefSettings& settings) {
    check_above_zero("the cutting speed", settings.cutting);
    check_above_zero("the plunge rate", settings.plunging);
    check_above_zero("the safe height", settings.safe_height);
    check_not_below_zero("the tolerance", settings.merge_tolerance);
    if (settings.step_over) {
        check_above_zero("the step-over", *settings.step_over);
    }
    if (settings.roughing) {
        check_above_zero("the depth per pass", settings.roughing->depth_per_pass);
        check_not_below_zero("the stock left by roughing", settings.roughing->allowance);
        if (settings.roughing->step_over) {
            check_above_zero("the step-over", *settings.roughing->step_over);
        }
    }
}

/// y of rows from the top pixel's to the bottom one's, as equally spaced as `step` allows.
std::vector<double> rows_of(const HeightField& field, double step) {
    const double height = field.y_of_row(0);
    const double count = std::ceil(height / step - 1e-9);
    if (count * field.columns > most_points) {
        throw Error(fmt::format("a step-over of {} mm needs more than {:.0f} million points",
                                step,
                                most_points / 1e6),
                    {},
                    "use a larger step-over, part of the picture, or fewer pixels");
    }
    std::vector<double> rows;
    for (double n = 0.0; n < count; n += 1.0) {
        rows.push_back(height - n * height / count);
    }
    rows.push_back(0.0);
    return rows;
}

/// Rows of a surface, a batch at a time computed by all threads, handed out in order.
template <typename Use>
void each_row(const TipSurface& surface,
              const std::vector<double>& rows,
              const Progress& progress,
              const Use& use) {
    constexpr std::size_t batch = 64;
    for (std::size_t begin = 0; begin < rows.size(); begin += batch) {
        progress.check();
        progress.report(static_cast<double>(begin) / static_cast<double>(rows.size()));
        const std::size_t count = std::min(batch, rows.size() - begin);
        std::vector<std::vector<float>> heights(count);
        parallel_for(static_cast<std::ptrdiff_t>(count), 1, [&](std::ptrdiff_t n) {
            heights[static_cast<std::size_t>(n)] = surface.row(rows[begin + static_cast<std::size_t>(n)]);
        });
        for (std::size_t n = 0; n < count; ++n) {
            use(begin + n, heights[n]);
        }
    }
}

class ReliefBuilder {
public:
    ReliefBuilder(const HeightField& field, const ReliefSettings& settings)
        : field_(field), settings_(settings), surface_(field, settings.tip) {}

    void rough(const Roughing& roughing, double floor, double ceiling, const Progress& progress) {
        const double width = std::max(2.0 * radius(settings_.tip), field_.pitch);
        const std::vector<double> rows = rows_of(field_, roughing.step_over.value_or(width / 2.0));
        each_row(surface_, rows, progress, [&](std::size_t n, std::vector<float>& heights) {
            std::vector<Node> nodes = nodes_of(heights, field_.pitch, roughing.allowance);
            for (Node& node : nodes) {
                node.z = std::max(node.z, floor);
            }
            if (n % 2 != 0) {
                std::ranges::reverse(nodes);
            }
            for (const auto& run : runs_below(nodes, ceiling, 2.0 * settings_.safe_height)) {
                lift();
                cut_row(run, rows[n]);
            }
        });
        lift();
    }

    void finish(const Progress& progress) {
        const std::vector<double> rows = rows_of(field_, settings_.step_over.value_or(field_.pitch));
        each_row(surface_, rows, progress, [&](std::size_t n, std::vector<float>& heights) {
            std::vector<Node> nodes = nodes_of(heights, field_.pitch, 0.0);
            const bool backward = n % 2 != 0;
            if (backward) {
                std::ranges::reverse(nodes);
            }
            if (n > 0) {
                cross(backward ? field_.columns - 1 : 0, nodes.front().z, rows[n - 1], rows[n]);
            }
            cut_row(nodes, rows[n]);
        });
        lift();
    }

    CutPath take_path() { return std::move(path_); }

private:
    void add(const Vec3& at, double speed, CutMove move) {
        expect_not_too_long(path_.size() + 1);
        path_.push_back({.at = at, .speed = speed, .move = move, .tool = 1});
    }

    [[nodiscard]] bool up() const { return path_.empty() || path_.back().move == CutMove::retract; }

    void lift() {
        if (!up()) {
            const Vec3 at = path_.back().at;
            add({at.x(), at.y(), settings_.safe_height}, 0.0, CutMove::retract);
        }
    }

    void cut_row(const std::vector<Node>& nodes, double y) {
        const std::vector<Node> kept = settings_.merge ? merged(nodes, settings_.merge_tolerance) : nodes;
        const auto cut = [&](const Node& node) { add({node.x, y, node.z}, settings_.cutting, CutMove::cut); };
        if (up()) {
            add({kept.front().x, y, settings_.safe_height}, 0.0, CutMove::rapid);
            add({kept.front().x, y, kept.front().z}, settings_.plunging, CutMove::plunge);
        } else {
            cut(kept.front());
        }
        std::for_each(kept.begin() + 1, kept.end(), cut);
    }

    /// To the next row over `column`, at the height of what stands between them.
    void cross(int column, double z, double y_from, double y_to) {
        const Vec3 at = path_.back().at;
        const double top = surface_.highest_between(column, y_from, y_to);
        if (top <= std::min(at.z(), z)) {
            return;
        }
        if (top > at.z()) {
            add({at.x(), y_from, top}, settings_.cutting, CutMove::cut);
        }
        if (top > z) {
            add({at.x(), y_to, std::max(top, at.z())}, settings_.cutting, CutMove::cut);
        }
    }

    const HeightField& field_;
    const ReliefSettings& settings_;
    TipSurface surface_;
    CutPath path_;
};

} // namespace

CutPath relief(const HeightField& field, const ReliefSettings& settings, const Progress& progress) {
    check_relief_settings(settings);
    expects(field.columns > 0 && field.rows > 0, "a height field has pixels");
    ReliefBuilder builder(field, settings);
    const auto lowest = static_cast<double>(std::ranges::min(field.z));
    constexpr double finishing_part = 0.5;
    if (settings.roughing) {
        const Roughing& roughing = *settings.roughing;
        const double bottom = lowest + roughing.allowance;
        const double count = std::ceil(-bottom / roughing.depth_per_pass - 1e-9);
        constexpr double most_passes = 1000.0;
        if (count > most_passes) {
            throw Error(
                fmt::format("a depth per pass of {} mm needs {:.0f} passes", roughing.depth_per_pass, count));
        }
        for (double pass = 1.0; pass <= count; pass += 1.0) {
            const double floor = std::max(-pass * roughing.depth_per_pass, bottom);
            const double ceiling = -(pass - 1.0) * roughing.depth_per_pass;
            builder.rough(
                roughing,
                floor,
                ceiling,
                progress.part(finishing_part * (pass - 1.0) / count, finishing_part * pass / count));
        }
    }
    builder.finish(progress.part(settings.roughing ? finishing_part : 0.0, 1.0));
    return builder.take_path();
}

Stroke frame(const HeightField& field, double tool_diameter, double margin) {
    check_above_zero("the tool diameter", tool_diameter);
    check_not_below_zero("the margin", margin);
    const double off = field.pitch / 2.0 + margin + tool_diameter / 2.0;
    const Vec2 low(-off, -off);
    const Vec2 high = Vec2((field.columns - 1) * field.pitch, field.y_of_row(0)) + Vec2(off, off);
    return {.pen = 1, .points = {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y()), low}};
}

} // namespace millwright::plot
