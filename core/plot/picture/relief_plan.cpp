#include "core/plot/picture/relief_plan.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::plot {

namespace {

CutPath frame_path(const HeightField& field, const ReliefPlan& plan) {
    const ReliefSettings& relief = plan.relief;
    if (relief.tip.kind == TipKind::point) {
        throw Error("a point without a diameter cuts no frame", {}, "name the tool, as ball:1.0");
    }
    Level level;
    level.depth = *plan.plate;
    const double per_pass = relief.roughing ? relief.roughing->depth_per_pass : relief.tip.diameter / 2.0;
    constexpr double most_passes = 1e4;
    level.passes = static_cast<int>(std::clamp(std::ceil(level.depth / per_pass), 1.0, most_passes));
    level.cutting = relief.cutting;
    level.plunging = relief.plunging;
    level.tabs = plan.tabs;
    CutSettings settings;
    settings.levels = {level};
    settings.safe_height = relief.safe_height;
    settings.change_position.z() = std::max(settings.change_position.z(), settings.safe_height);
    return cut_path({frame(field, relief.tip.diameter, plan.frame_margin)}, settings);
}

/// What is deeper than the plate is in the bed.
void check_depth(const CutPath& path, double plate) {
    double deepest = 0.0;
    for (const CutPoint& point : path) {
        deepest = std::max(deepest, -point.at.z());
    }
    constexpr double rounding = 1e-5; // of heights in single precision
    if (deepest > plate + rounding) {
        throw Error(fmt::format("the relief is {:.3f} mm deep and the plate {:.3f} mm thick", deepest, plate),
                    {},
                    "less depth or a thicker plate");
    }
}

} // namespace

double usual_step_over(const ToolTip& tip, double pitch) {
    constexpr double part = 0.1;
    const bool wide = tip.kind == TipKind::ball || tip.kind == TipKind::flat;
    return wide ? part * tip.diameter : pitch;
}

CutPath relief_path(const HeightField& field, const ReliefPlan& plan, const Progress& progress) {
    ReliefSettings settings = plan.relief;
    settings.step_over = settings.step_over.value_or(usual_step_over(settings.tip, field.pitch));
    CutPath path = relief(field, settings, progress);
    if (plan.plate) {
        if (!plan.through) {
            check_depth(path, *plan.plate);
        }
        const CutPath around = frame_path(field, plan);
        path.insert(path.end(), around.begin(), around.end());
    }
    return path;
}

} // namespace millwright::plot
