#include "ui/panels/plot_fields.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/project/plot_settings.h"
#include "ui/panels/internal/fields.h"

#include <array>
#include <initializer_list>
#include <string>
#include <utility>

namespace millwright::panels {

namespace {

using project::PictureUse;
using project::PlotSettings;
using project::Project;
using widgets::FieldInfo;
using widgets::Option;

constexpr std::array<Option, 3> units{
    {{"nominal", "0.025 mm", {}, "HP's nominal unit, and that of the thesis of 2006"},
     {"table", "0.02488 mm", {}, "The unit that explains the errors of the thesis on the decoder"},
     {"own", "Another", {}, "As the row below says"}}};
constexpr double nominal_unit = 0.025;
constexpr double table_unit = 0.02488;
constexpr std::array<Option, 2> machines{
    {{"forming-table", "Forming table", {}, "480 x 550 x 150 mm, as in the thesis of 2006"},
     {"router-xyz", "Router", {}, "A faster router of three axes"}}};

void change(ActionQueue& ask, std::string_view what, std::function<void(PlotSettings&)> set) {
    ask.edit("Change " + std::string(what),
             [set = std::move(set)](Project& draft) { set(draft.plot.settings); });
}

/// The rows of the table that have these names.
void numbers(Ui& ui,
             ActionQueue& ask,
             const PlotSettings& now,
             std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
        number_fields<PlotSettings>(
            ui, ask, {&project::plot_number(name), 1}, now, [](Project& draft) -> PlotSettings& {
                return draft.plot.settings;
            });
    }
}

void toggle(Ui& ui,
            ActionQueue& ask,
            std::string_view id,
            std::string_view label,
            bool on,
            std::string_view tip,
            void (*set)(PlotSettings&, bool)) {
    if (const auto chosen = ui.toggle(id, label, on, tip)) {
        change(ask, label, [set, chosen = *chosen](PlotSettings& settings) { set(settings, chosen); });
    }
}

template <class Value>
void choice(Ui& ui,
            ActionQueue& ask,
            std::string_view id,
            std::string_view label,
            std::span<const project::Choice<Value>> choices,
            Value now,
            void (*set)(Project&, Value)) {
    choice_field<Value>(ui, ask, id, label, "Change " + std::string(label), choices, now, set);
}

void unit_fields(Ui& ui, ActionQueue& ask, const PlotSettings& now) {
    const int at = exactly_equal(now.plotter_unit, nominal_unit) ? 0
                   : exactly_equal(now.plotter_unit, table_unit) ? 1
                                                                 : 2;
    if (const auto chosen = ui.choice("unit", "Plotter", at, units); chosen && *chosen < 2) {
        change(
            ask, "Plotter unit", [unit = *chosen == 0 ? nominal_unit : table_unit](PlotSettings& settings) {
                settings.plotter_unit = unit;
            });
    }
    numbers(ui, ask, now, {"plotter_unit_mm"});
}

void tip_fields(Ui& ui, ActionQueue& ask, const PlotSettings& now) {
    choice<plot::TipKind>(
        ui, ask, "tip", "Tool", project::tip_kinds(), now.tip.kind, [](Project& draft, plot::TipKind kind) {
            draft.plot.settings.tip.kind = kind;
        });
    if (now.tip.kind != plot::TipKind::point) {
        numbers(ui, ask, now, {"tip_diameter_mm"});
    }
    if (now.tip.kind == plot::TipKind::v) {
        numbers(ui, ask, now, {"tip_angle_deg"});
    }
}

/// A speed of the usual level and of every pen's.
void speed_of_all(
    Ui& ui, ActionQueue& ask, const PlotSettings& now, std::string_view id, std::string_view tip) {
    const auto& setting = project::level_number(id);
    const FieldInfo info{setting.id,
                         setting.label,
                         setting.unit,
                         tip,
                         setting.min,
                         setting.max,
                         setting.value(PlotSettings{}.level),
                         setting.decimals};
    if (const auto chosen = ui.number(setting.value(now.level), info)) {
        change(ask, setting.label, [&setting, speed = *chosen](PlotSettings& settings) {
            setting.set(settings.level, speed);
            for (plot::Level& level : settings.levels) {
                setting.set(level, speed);
            }
        });
    }
}

void picture_fields(Ui& ui, ActionQueue& ask, const PlotSettings& set) {
    choice<PictureUse>(
        ui, ask, "use", "Becomes", project::picture_uses(), set.use, [](Project& draft, PictureUse use) {
            draft.plot.settings.use = use;
        });
    numbers(ui, ask, set, {"width_mm"});
    choice<plot::GrayRule>(ui,
                           ask,
                           "gray",
                           "Brightness",
                           project::gray_rules(),
                           set.gray,
                           [](Project& draft, plot::GrayRule rule) { draft.plot.settings.gray = rule; });
    toggle(ui, ask, "invert", "Invert", set.invert, "Dark becomes bright", [](PlotSettings& s, bool on) {
        s.invert = on;
    });
    if (set.use == PictureUse::outlines) {
        numbers(ui, ask, set, {"threshold"});
        return;
    }
    if (set.use != PictureUse::halftone) {
        numbers(ui, ask, set, {"depth_mm"});
    }
    tip_fields(ui, ask, set);
    if (set.use == PictureUse::relief) {
        numbers(ui, ask, set, {"step_over_mm", "depth_per_pass_mm", "frame_mm"});
    } else {
        numbers(ui, ask, set, {"dot_pitch_mm"});
    }
}

} // namespace

bool cuts_brightness(const Workbench& now) {
    return project::is_picture_file(now.plot.file()) && now.plot.settings().use != PictureUse::outlines;
}

void source_fields(Ui& ui, const Workbench& now, ActionQueue& ask) {
    if (project::is_picture_file(now.plot.file())) {
        picture_fields(ui, ask, now.plot.settings());
    } else if (project::is_path_file(now.plot.file())) {
        ui.note("A path that was made before: it is cut as it stands.");
    } else {
        unit_fields(ui, ask, now.plot.settings());
    }
}

void stroke_fields(Ui& ui, const Workbench& now, ActionQueue& ask) {
    const PlotSettings& set = now.plot.settings();
    const plot::StrokePlan& plan = set.strokes;
    if (const auto section = ui.section("cutter", "Cutter")) {
        numbers(ui, ask, set, {"tool_mm"});
        choice<plot::CutterSide>(
            ui,
            ask,
            "side",
            "Goes",
            project::cutter_sides(),
            plan.side,
            [](Project& draft, plot::CutterSide side) { draft.plot.settings.strokes.side = side; });
        choice<plot::Corners>(
            ui,
            ask,
            "corners",
            "Corners",
            project::corner_kinds(),
            plan.corners,
            [](Project& draft, plot::Corners corners) { draft.plot.settings.strokes.corners = corners; });
    }
    if (const auto section = ui.section("fill", "Fill closed strokes")) {
        numbers(ui, ask, set, {"hatch_mm", "hatch_angle_deg"});
        toggle(ui,
               ask,
               "cross",
               "Crossed",
               plan.hatch_cross,
               "Once more at right angles",
               [](PlotSettings& s, bool on) { s.strokes.hatch_cross = on; });
        numbers(ui, ask, set, {"contours_mm"});
    }
    if (const auto section = ui.section("travel", "Travel")) {
        toggle(ui,
               ask,
               "order",
               "Shorten",
               plan.order,
               "Reorders and reverses strokes",
               [](PlotSettings& s, bool on) { s.strokes.order = on; });
        numbers(ui, ask, set, {"link_mm"});
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
    speed_of_all(ui, ask, set, "feed_mm_per_min", "Along strokes and rows, of all pens");
    speed_of_all(ui, ask, set, "plunge_mm_per_min", "Into the work, of all pens");
    numbers(ui, ask, set, {"safe_height_mm", "plate_mm", "spindle_rpm", "origin_x_mm", "origin_y_mm"});
    const int at = set.machine == machines[1].id ? 1 : 0;
    if (const auto chosen = ui.choice("machine", "Machine", at, machines)) {
        change(ask, "Machine", [id = machines[static_cast<std::size_t>(*chosen)].id](PlotSettings& settings) {
            settings.machine = id;
        });
    }
}

} // namespace millwright::panels
