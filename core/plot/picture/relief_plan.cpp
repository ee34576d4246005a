#include "core/plot/picture/relief_plan.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/plot/cut_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::plot {

namespace {

/// How much deeper than its end a tip has its whole width: 0 for a flat one.
double taper_of(const ToolTip& tip) {
    return rise(tip, radius(tip));
}

/// In the words of a frame, which no pen draws.
void expect_tabs_fit(const Tabs& tabs, double plate, double around, double tool) {
    if (tabs.count < 1) {
        return;
    }
    if (tabs.height > plate) {
        throw Error(fmt::format(
            "frame: tabs of {:.6g} mm are higher than the plate of {:.6g} mm", tabs.height, plate));
    }
    if (!(tabs.count * (tabs.width + tool) < around)) {
        throw Error(fmt::format("frame: {} of {:.6g} mm do not fit on a path of {:.6g} mm around it: each "
                                "also needs {:.6g} mm, the width of the tool",
                                counted(tabs.count, "tab"),
                                tabs.width,
                                around,
                                tool),
                    {},
                    "use fewer or narrower tabs");
    }
}

CutPath frame_path(const HeightField& field, const ReliefPlan& plan) {
    const ReliefSettings& relief = plan.relief;
    if (relief.tip.kind == TipKind::point) {
        throw Error(
            "a point tool without a diameter cannot cut a frame", {}, "give the tool, such as ball:1.0");
    }
    Level level;
    const double below = plan.through ? taper_of(relief.tip) : 0.0;
    level.depth = *plan.plate + below;
    const double per_pass = relief.roughing ? relief.roughing->depth_per_pass : relief.tip.diameter / 2.0;
    constexpr double most_passes = 1e4;
    level.passes = static_cast<int>(std::clamp(std::ceil(level.depth / per_pass), 1.0, most_passes));
    level.cutting = relief.cutting;
    level.plunging = relief.plunging;
    level.tabs = plan.tabs;
    level.tabs.height += below; // so that they stand as high above the underside
    CutSettings settings;
    settings.levels = with_tab_widths({level}, relief.tip.diameter);
    settings.safe_height = relief.safe_height;
    settings.change_position.z() = std::max(settings.change_position.z(), settings.safe_height);
    const Stroke around = frame(field, relief.tip.diameter, plan.frame_margin);
    expect_tabs_fit(plan.tabs, *plan.plate, length(around), relief.tip.diameter);
    return cut_path({around}, settings);
}

/// What is deeper than the plate is in the bed.
void check_depth(const CutPath& path, double plate) {
    double deepest = 0.0;
    for (const CutPoint& point : path) {
        deepest = std::max(deepest, -point.at.z());
    }
    constexpr double rounding = 1e-5; // of heights in single precision
    if (deepest > plate + rounding) {
        throw Error(fmt::format("the relief is {:.3f} mm deep, but the plate is only {:.3f} mm thick",
                                deepest,
                                plate),
                    {},
                    "use less depth or a thicker plate");
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

std::optional<Diagnostic> frame_notice(const ReliefPlan& plan) {
    const double below = plan.plate ? taper_of(plan.relief.tip) : 0.0;
    if (!(below > 0.0)) {
        return std::nullopt;
    }
    if (plan.through) {
        return Diagnostic{{},
                          fmt::format("the frame is cut to {:.3f} mm, {:.3f} mm below the plate, so that the "
                                      "tool has its full width at the underside",
                                      *plan.plate + below,
                                      below),
                          "put a sacrificial board under the plate"};
    }
    return Diagnostic{{},
                      fmt::format("the tip of the tool has no width at the underside of the plate: a flange "
                                  "of up to {:.3f} mm remains there around the part",
                                  radius(plan.relief.tip)),
                      fmt::format("use a flat tool, or cut through the plate (Through under Work, "
                                  "--through): {:.3f} mm deeper cuts the part out at its full size",
                                  below)};
}

} // namespace millwright::plot
