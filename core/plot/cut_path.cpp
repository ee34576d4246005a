#include "core/plot/cut_path.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace millwright::plot {
namespace {

void check(const CutSettings& settings) {
    const auto refuse = [](const Level& level, const char* what) {
        throw Error(fmt::format("pen {}: {}", level.pen, what));
    };
    for (const Level& level : settings.levels) {
        if (!(level.depth >= 0.0) || !std::isfinite(level.depth)) {
            refuse(level, "the depth has to be 0 mm or more");
        }
        if (level.passes < 1) {
            refuse(level, "there has to be a pass");
        }
        const bool moves = level.cutting > 0.0 && level.plunging > 0.0;
        if (!moves || !std::isfinite(level.cutting + level.plunging)) {
            refuse(level, "the speeds have to be above 0 mm/s");
        }
    }
    if (!(settings.safe_height > 0.0) || !std::isfinite(settings.safe_height)) {
        throw Error("the safe height has to be above 0 mm");
    }
    if (!is_finite(settings.change_position) || settings.change_position.z() < settings.safe_height) {
        throw Error("the tool is changed below the safe height");
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
        for (std::size_t n = 1; n < stroke.points.size(); ++n) {
            add({stroke.points[n].x(), stroke.points[n].y(), z}, level.cutting, CutMove::cut);
        }
        add({last().x(), last().y(), settings_.safe_height}, 0.0, CutMove::retract);
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

std::vector<Level> levels_for(const Strokes& strokes, const Level& like) {
    std::vector<Level> levels;
    std::set<int> known;
    for (const Stroke& stroke : strokes) {
        if (known.insert(stroke.pen).second) {
            Level level = like;
            level.pen = stroke.pen;
            level.order = static_cast<int>(levels.size());
            levels.push_back(level);
        }
    }
    return levels;
}

CutPath cut_path(const Strokes& strokes, const CutSettings& settings) {
    check(settings);
    std::vector<Level> levels = settings.levels;
    std::ranges::stable_sort(levels, {}, &Level::order);
    CutPathBuilder builder(settings);
    for (const Level& level : levels) {
        const auto drawn = [&](const Stroke& stroke) { return stroke.pen == level.pen; };
        if (!level.enabled || std::ranges::none_of(strokes, drawn)) {
            continue;
        }
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
