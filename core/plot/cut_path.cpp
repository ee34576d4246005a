#include "core/plot/cut_path.h"

#include "core/base/counted.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace millwright::plot {

std::vector<Level> with_tab_widths(std::vector<Level> levels, double tool_diameter) {
    expects(tool_diameter >= 0.0, "a tool has a width");
    for (Level& level : levels) {
        level.tabs.width += level.tabs.count > 0 ? level.tool_diameter.value_or(tool_diameter) : 0.0;
    }
    return levels;
}

void expect_not_too_long(std::size_t points) {
    if (points > most_path_points) {
        throw Error(fmt::format("the path has more than {} million points", most_path_points / 1'000'000),
                    {},
                    "use a larger step-over or pitch, fewer pixels or passes, or part of the drawing");
    }
}

namespace {

void check_cut_settings(const CutSettings& settings) {
    const auto refuse = [](const Level& level, const std::string& what) {
        throw Error(fmt::format("pen {}: {}", level.pen, what));
    };
    for (const Level& level : settings.levels) {
        if (!(level.depth >= 0.0) || !std::isfinite(level.depth)) {
            refuse(level, "the depth must be 0 mm or more");
        }
        if (level.passes < 1) {
            refuse(level, "the number of passes must be 1 or more");
        }
        const bool moves = level.cutting > 0.0 && level.plunging > 0.0;
        if (!moves || !std::isfinite(level.cutting + level.plunging)) {
            refuse(level, "the speeds must be above 0 mm/s");
        }
        const Tabs& tabs = level.tabs;
        const bool sized = tabs.width > 0.0 && tabs.height > 0.0 && std::isfinite(tabs.width + tabs.height);
        if (tabs.count < 0 || !sized) {
            refuse(level, "the width and height of tabs must be above 0 mm");
        }
        if (tabs.count > 0 && tabs.height > level.depth) {
            refuse(level,
                   fmt::format(
                       "tabs of {} mm are higher than the cut is deep, {} mm", tabs.height, level.depth));
        }
    }
    if (!(settings.safe_height > 0.0) || !std::isfinite(settings.safe_height)) {
        throw Error("the safe height must be above 0 mm");
    }
    if (!is_finite(settings.change_position) || settings.change_position.z() < settings.safe_height) {
        throw Error("the tool change position is below the safe height");
    }
}

class CutPathBuilder {
public:
    explicit CutPathBuilder(const CutSettings& settings) : settings_(settings) {}

    void take(int tool) {
        if (tool_ && *tool_ != tool) {
            add({last().x(), last().y(), settings_.change_position.z()}, 0.0, CutMove::rapid);
            add(settings_.change_position, 0.0, CutMove::rapid);
            tool_ = tool;
            add(settings_.change_position, 0.0, CutMove::tool_change);
        }
        tool_ = tool;
    }

    void cut(const Stroke& stroke, const Level& level, double z) {
        const Vec2& start = stroke.points.front();
        const double travel =
            path_.empty() ? settings_.safe_height : std::max(last().z(), settings_.safe_height);
        add({start.x(), start.y(), travel}, 0.0, CutMove::rapid);
        if (travel > settings_.safe_height) {
            add({start.x(), start.y(), settings_.safe_height}, 0.0, CutMove::rapid);
        }
        add({start.x(), start.y(), z}, level.plunging, CutMove::plunge);
        const double top = level.tabs.height - level.depth;
        const bool closed = stroke.points.size() > 2 && stroke.points.front() == stroke.points.back();
        if (level.tabs.count > 0 && closed && z < top) {
            around_with_tabs(stroke, level, z, top);
        } else {
            for (std::size_t n = 1; n < stroke.points.size(); ++n) {
                along(stroke.points[n], z, level);
            }
        }
        add({last().x(), last().y(), settings_.safe_height}, 0.0, CutMove::retract);
    }

    /// Before so many passes are made that they fill the memory.
    void expect_room(const Strokes& strokes, const Level& level) const {
        std::size_t points = 0; // a pass
        for (const Stroke& stroke : strokes) {
            constexpr std::size_t in_the_air = 3;
            points += stroke.pen == level.pen ? stroke.points.size() + in_the_air : 0;
        }
        expect_not_too_long(path_.size() + points * static_cast<std::size_t>(level.passes));
    }

    void along(const Vec2& to, double z, const Level& level) {
        add({to.x(), to.y(), z}, level.cutting, CutMove::cut);
    }

    // Tabs stand in the middle of equal parts of the way around, so never at its start.
    void around_with_tabs(const Stroke& stroke, const Level& level, double z, double top) {
        const Tabs& tabs = level.tabs;
        const double part = length(stroke) / tabs.count;
        if (!(tabs.width < part)) {
            throw Error(fmt::format("pen {}: {} do not fit on a stroke of {:.6g} mm: each needs {:.6g} mm of "
                                    "the tool path, for its own width and that of the tool",
                                    level.pen,
                                    counted(tabs.count, "tab"),
                                    part * tabs.count,
                                    tabs.width));
        }
        double passed = 0.0; // way around up to the segment
        int edge = 0;        // edges of tabs passed: an odd number is on a tab
        const auto place_of = [&](int n) {
            return part * (n / 2 + 0.5) + (n % 2 == 0 ? -0.5 : 0.5) * tabs.width;
        };
        for (std::size_t n = 1; n < stroke.points.size(); ++n) {
            const Vec2& a = stroke.points[n - 1];
            const Vec2& b = stroke.points[n];
            const double distance = (b - a).norm();
            for (; edge < 2 * tabs.count && place_of(edge) < passed + distance; ++edge) {
                const Vec2 p = a + (place_of(edge) - passed) / distance * (b - a);
                const bool up = edge % 2 == 0;
                along(p, up ? z : top, level);
                add({p.x(), p.y(), up ? top : z}, level.plunging, up ? CutMove::cut : CutMove::plunge);
            }
            along(b, edge % 2 == 0 ? z : top, level);
            passed += distance;
        }
    }

    CutPath take_path() { return std::move(path_); }

private:
    [[nodiscard]] const Vec3& last() const { return path_.back().at; }

    void add(const Vec3& at, double speed, CutMove move) {
        path_.push_back({.at = at, .speed = speed, .move = move, .tool = tool_.value_or(1)});
    }

    const CutSettings& settings_;
    CutPath path_;
    std::optional<int> tool_;
};

} // namespace

PathLengths lengths(const CutPath& path) {
    PathLengths lengths;
    if (!path.empty()) {
        const Vec3& first = path.front().at;
        lengths.travel = std::abs(first.z()) + first.head<2>().norm();
    }
    for (std::size_t n = 1; n < path.size(); ++n) {
        const double distance = (path[n].at - path[n - 1].at).norm();
        (path[n].speed > 0.0 ? lengths.cut : lengths.travel) += distance;
    }
    return lengths;
}

double deepest(const CutPath& path) {
    double depth = 0.0;
    for (const CutPoint& point : path) {
        depth = std::max(depth, -point.at.z());
    }
    return depth;
}

void expect_within_plate(const CutPath& path, double thickness) {
    constexpr double rounding = 1e-6;
    const double depth = deepest(path);
    if (!(depth <= thickness + rounding)) {
        throw Error(
            fmt::format("the path is {:.3f} mm deep, but the plate is {:.3f} mm thick", depth, thickness));
    }
}

std::vector<Level> levels_for(const Strokes& strokes, const Level& like) {
    std::vector<Level> levels;
    std::set<int> known;
    for (const Stroke& stroke : strokes) {
        if (known.insert(stroke.pen).second) {
            Level level = like;
            level.pen = stroke.pen;
            level.order = static_cast<int>(levels.size()) + 1;
            levels.push_back(level);
        }
    }
    return levels;
}

CutPath cut_path(const Strokes& strokes, const CutSettings& settings) {
    check_cut_settings(settings);
    std::vector<Level> levels = settings.levels;
    std::ranges::stable_sort(levels, {}, &Level::order);
    CutPathBuilder builder(settings);
    for (const Level& level : levels) {
        const auto drawn = [&](const Stroke& stroke) { return stroke.pen == level.pen; };
        if (!level.enabled || std::ranges::none_of(strokes, drawn)) {
            continue;
        }
        builder.expect_room(strokes, level);
        builder.take(level.tool);
        for (int pass = 1; pass <= level.passes; ++pass) {
            const double z = -level.depth * pass / level.passes;
            for (const Stroke& stroke : strokes) {
                if (drawn(stroke)) {
                    builder.cut(stroke, level, z);
                }
            }
        }
    }
    return builder.take_path();
}

} // namespace millwright::plot
