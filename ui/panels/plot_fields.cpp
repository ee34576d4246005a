#include "ui/panels/plot_fields.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/project/assets.h"
#include "ui/widgets/field_info.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace millwright::panels {

namespace {

using plot::TipKind;
using project::PictureUse;
using project::PlotSettings;
using widgets::FieldInfo;
using widgets::Option;

constexpr std::array<Option, 4> uses{{{"relief", "Relief", {}, "As deep as pixels are bright"},
                                      {"outlines", "Outlines", {}, "Around what is dark, by tracing"},
                                      {"halftone", "Halftone", {}, "Dots whose size says how dark it is"},
                                      {"dots", "Dots", {}, "Dots of one size, as many as it is dark"}}};
constexpr std::array<Option, 2> grays{
    {{"mean", "Mean", {}, "(R + G + B) / 3, as the thesis of 2006"},
     {"luminance", "Luminance", {}, "As the eye weighs colours (ITU-R BT.709)"}}};
constexpr std::array<Option, 3> tips{{{"ball", "Ball"}, {"flat", "End mill"}, {"v", "V"}}};
constexpr std::array<TipKind, 3> tip_of{TipKind::ball, TipKind::flat, TipKind::v};
constexpr std::array<Option, 3> sides{{{"line", "On line", {}, "The middle of the tool on the strokes"},
                                       {"outside", "Outside", {}, "Where the outer size matters"},
                                       {"inside", "Inside", {}, "Where the size of a hole matters"}}};
constexpr std::array<Option, 2> corners{{{"sharp", "Sharp"}, {"round", "Round"}}};
constexpr std::array<Option, 2> units{
    {{"nominal", "0.025 mm", {}, "HP's nominal unit, and that of the thesis of 2006"},
     {"table", "0.02488 mm", {}, "The unit that explains the errors of the thesis on the decoder"}}};
constexpr double table_unit = 0.02488;
constexpr double nominal_unit = 0.025;

void change(ActionQueue& ask, std::function<void(PlotSettings&)> what) {
    ask.plot([what = std::move(what)](actions::PlotBench& bench) {
        PlotSettings settings = bench.settings();
        what(settings);
        bench.set(settings);
    });
}

void number(Ui& ui,
            ActionQueue& ask,
            const FieldInfo& info,
            double value,
            const std::function<void(PlotSettings&, double)>& set) {
    if (const auto chosen = ui.number(value, info)) {
        change(ask, [set, chosen = *chosen](PlotSettings& settings) { set(settings, chosen); });
    }
}

void toggle(Ui& ui,
            ActionQueue& ask,
            std::string_view id,
            std::string_view label,
            bool on,
            std::string_view tip,
            const std::function<void(PlotSettings&, bool)>& set) {
    if (const auto chosen = ui.toggle(id, label, on, tip)) {
        change(ask, [set, chosen = *chosen](PlotSettings& settings) { set(settings, chosen); });
    }
}

void choice(Ui& ui,
            ActionQueue& ask,
            std::string_view id,
            std::string_view label,
            int at,
            std::span<const Option> options,
            const std::function<void(PlotSettings&, int)>& set) {
    if (const auto chosen = ui.choice(id, label, at, options)) {
        change(ask, [set, chosen = *chosen](PlotSettings& settings) { set(settings, chosen); });
    }
}

void tip_fields(Ui& ui, ActionQueue& ask, const PlotSettings& now) {
    const auto* const kind = std::ranges::find(tip_of, now.tip.kind);
    choice(ui, ask, "tip", "Tool", static_cast<int>(kind - tip_of.begin()), tips, [](PlotSettings& s, int n) {
        s.tip.kind = tip_of[static_cast<std::size_t>(n)];
    });
    number(ui,
           ask,
           {"diameter", "Diameter", "mm", "Of the tool", 0.05, 50.0, 1.0, 2},
           now.tip.diameter,
           [](PlotSettings& s, double v) { s.tip.diameter = v; });
    if (now.tip.kind == TipKind::v) {
        number(ui,
               ask,
               {"angle", "Angle", "deg", "Of a V between its sides", 5.0, 170.0, 60.0, 1},
               to_degrees(now.tip.angle),
               [](PlotSettings& s, double v) { s.tip.angle = from_degrees(v); });
    }
}

void relief_fields(Ui& ui, ActionQueue& ask, const PlotSettings& now) {
    number(ui,
           ask,
           {"step_over", "Step-over", "mm", "Between rows; 0: a tenth of the tool", 0.0, 10.0, 0.0, 2},
           now.step_over.value_or(0.0),
           [](PlotSettings& s, double v) { s.step_over = v > 0.0 ? std::optional(v) : std::nullopt; });
    number(ui,
           ask,
           {"roughing", "Depth a pass", "mm", "Of roughing before the last pass; 0: none", 0.0, 50.0, 0.0, 2},
           now.depth_per_pass.value_or(0.0),
           [](PlotSettings& s, double v) { s.depth_per_pass = v > 0.0 ? std::optional(v) : std::nullopt; });
    number(ui,
           ask,
           {"frame",
            "Cut out",
            "mm",
            "Of a plate so thick, with four tabs; 0: it stays in it",
            0.0,
            100.0,
            0.0,
            2},
           now.frame.value_or(0.0),
           [](PlotSettings& s, double v) { s.frame = v > 0.0 ? std::optional(v) : std::nullopt; });
}

} // namespace

bool cuts_brightness(const Workbench& now) {
    const auto made = now.plot.latest();
    return made && made->picture && now.plot.settings().use != PictureUse::outlines;
}

void picture_fields(Ui& ui, const Workbench& now, ActionQueue& ask) {
    const PlotSettings& set = now.plot.settings();
    const auto made = now.plot.latest();
    if (!made || !made->picture) {
        choice(ui,
               ask,
               "unit",
               "Plotter unit",
               exactly_equal(set.plotter_unit, table_unit) ? 1 : 0,
               units,
               [](PlotSettings& s, int n) { s.plotter_unit = n == 1 ? table_unit : nominal_unit; });
        return;
    }
    choice(ui, ask, "use", "Becomes", static_cast<int>(set.use), uses, [](PlotSettings& s, int n) {
        s.use = static_cast<PictureUse>(n);
    });
    number(ui,
           ask,
           {"width",
            "Width",
            "mm",
            "Of the picture; 0: as the file says, else 0.26 mm a pixel",
            0.0,
            2000.0,
            0.0,
            1},
           set.picture_width,
           [](PlotSettings& s, double v) { s.picture_width = v; });
    choice(ui, ask, "gray", "Brightness", static_cast<int>(set.gray), grays, [](PlotSettings& s, int n) {
        s.gray = static_cast<plot::GrayRule>(n);
    });
    toggle(ui, ask, "invert", "Invert", set.invert, "Dark becomes bright", [](PlotSettings& s, bool on) {
        s.invert = on;
    });
    if (set.use == PictureUse::outlines) {
        number(ui,
               ask,
               {"threshold", "Dark up to", "", "What is not brighter is dark", 0.0, 1.0, 0.5, 2},
               set.threshold,
               [](PlotSettings& s, double v) { s.threshold = v; });
        return;
    }
    if (set.use != PictureUse::halftone) {
        number(ui,
               ask,
               {"depth", "Depth", "mm", "Of white, or of each dot", 0.01, 100.0, 1.0, 2},
               set.depth,
               [](PlotSettings& s, double v) { s.depth = v; });
    }
    tip_fields(ui, ask, set);
    if (set.use == PictureUse::relief) {
        relief_fields(ui, ask, set);
    } else {
        number(ui,
               ask,
               {"pitch", "Between dots", "mm", "Across and down", 0.05, 20.0, 1.0, 2},
               set.dot_pitch,
               [](PlotSettings& s, double v) { s.dot_pitch = v; });
    }
}

void stroke_fields(Ui& ui, const Workbench& now, ActionQueue& ask) {
    const plot::StrokePlan& plan = now.plot.settings().strokes;
    if (const auto section = ui.section("cutter", "Cutter")) {
        number(ui,
               ask,
               {"tool", "Tool", "mm", "Diameter of the end mill", 0.05, 50.0, 3.0, 2},
               plan.tool_diameter,
               [](PlotSettings& s, double v) { s.strokes.tool_diameter = v; });
        choice(ui, ask, "side", "Goes", static_cast<int>(plan.side), sides, [](PlotSettings& s, int n) {
            s.strokes.side = static_cast<plot::CutterSide>(n);
        });
        choice(ui,
               ask,
               "corners",
               "Corners",
               static_cast<int>(plan.corners),
               corners,
               [](PlotSettings& s, int n) { s.strokes.corners = static_cast<plot::Corners>(n); });
    }
    if (const auto section = ui.section("fill", "Fill closed strokes")) {
        number(
            ui,
            ask,
            {"hatch", "Lines every", "mm", "0: none; 1.5875 mm is the thesis's 1/16 inch", 0.0, 50.0, 0.0, 4},
            plan.hatch_pitch.value_or(0.0),
            [](PlotSettings& s, double v) {
                s.strokes.hatch_pitch = v > 0.0 ? std::optional(v) : std::nullopt;
            });
        number(ui,
               ask,
               {"angle", "At", "deg", "Of the lines to x", -180.0, 180.0, 0.0, 1},
               to_degrees(plan.hatch_angle),
               [](PlotSettings& s, double v) { s.strokes.hatch_angle = from_degrees(v); });
        toggle(ui,
               ask,
               "cross",
               "Crossed",
               plan.hatch_cross,
               "Once more at right angles",
               [](PlotSettings& s, bool on) { s.strokes.hatch_cross = on; });
        number(ui,
               ask,
               {"contours",
                "Outlines every",
                "mm",
                "The outline again and again inside; 0: none",
                0.0,
                50.0,
                0.0,
                3},
               plan.contour_pitch.value_or(0.0),
               [](PlotSettings& s, double v) {
                   s.strokes.contour_pitch = v > 0.0 ? std::optional(v) : std::nullopt;
               });
    }
    if (const auto section = ui.section("travel", "Travel")) {
        toggle(ui,
               ask,
               "order",
               "Shorten",
               plan.order,
               "Reorders and reverses strokes",
               [](PlotSettings& s, bool on) { s.strokes.order = on; });
        number(ui,
               ask,
               {"link",
                "Link gaps below",
                "mm",
                "Strokes are joined without lifting; 0: none",
                0.0,
                100.0,
                0.0,
                2},
               plan.link,
               [](PlotSettings& s, double v) { s.strokes.link = v; });
        toggle(ui,
               ask,
               "inside",
               "Stay inside",
               plan.link_inside,
               "Links cross no closed stroke",
               [](PlotSettings& s, bool on) { s.strokes.link_inside = on; });
    }
}

void work_fields(Ui& ui, const Workbench& now, ActionQueue& ask) {
    const auto section = ui.section("work", "Work");
    if (!section) {
        return;
    }
    const PlotSettings& set = now.plot.settings();
    const auto mm_per_min = [&](const FieldInfo& info, double plot::Level::*speed) {
        number(ui, ask, info, to_mm_per_min(set.level.*speed), [speed](PlotSettings& s, double v) {
            s.level.*speed = from_mm_per_min(v);
            for (plot::Level& level : s.levels) {
                level.*speed = from_mm_per_min(v);
            }
        });
    };
    mm_per_min({"feed", "Feed", "mm/min", "Along strokes and rows, of all pens", 1.0, 1e5, 480.0, 0},
               &plot::Level::cutting);
    mm_per_min({"plunge", "Plunge", "mm/min", "Into the work, of all pens", 1.0, 1e5, 120.0, 0},
               &plot::Level::plunging);
    number(ui,
           ask,
           {"safe", "Safe height", "mm", "Where the tool travels, above the top", 0.1, 100.0, 5.0, 1},
           set.safe_height,
           [](PlotSettings& s, double v) { s.safe_height = v; });
    number(ui,
           ask,
           {"plate",
            "Plate",
            "mm",
            "The path must not go deeper than its thickness; 0: not known",
            0.0,
            500.0,
            0.0,
            2},
           set.plate,
           [](PlotSettings& s, double v) { s.plate = v; });
    number(ui,
           ask,
           {"spindle", "Spindle", "1/min", "0 leaves it alone", 0.0, 1e5, 10'000.0, 0},
           set.spindle_rpm,
           [](PlotSettings& s, double v) { s.spindle_rpm = v; });
    number(ui,
           ask,
           {"x", "Origin X", "mm", "Where that of the drawing lies on the machine", -1e4, 1e4, 0.0, 2},
           set.origin.x(),
           [](PlotSettings& s, double v) { s.origin.x() = v; });
    number(ui,
           ask,
           {"y", "Origin Y", "mm", "Where that of the drawing lies on the machine", -1e4, 1e4, 0.0, 2},
           set.origin.y(),
           [](PlotSettings& s, double v) { s.origin.y() = v; });
    const std::array<Option, 2> machines{
        {{"forming-table", "Forming table", {}, "480 x 550 x 150 mm, as in the thesis of 2006"},
         {"router-xyz", "Router", {}, "A faster router of three axes"}}};
    choice(ui,
           ask,
           "machine",
           "Machine",
           set.machine == "router-xyz" ? 1 : 0,
           machines,
           [](PlotSettings& s, int n) { s.machine = n == 1 ? "router-xyz" : "forming-table"; });
}

} // namespace millwright::panels
