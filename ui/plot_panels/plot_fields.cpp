#include "ui/plot_panels/plot_fields.h"

#include "core/base/units.h"
#include "core/project/gcode_file.h"
#include "core/project/level_settings.h"
#include "core/project/plot_choices.h"
#include "core/project/plot_settings.h"
#include "ui/panels/fields.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <optional>
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
    {{"nominal", "0.025 mm", {}, "HP's nominal plotter unit, also used by the 2006 thesis"},
     {"table", "0.02488 mm", {}, "The unit that explains the errors in the decoder thesis"},
     {"own", "Custom", {}, "Custom unit, set below"}}};
constexpr std::array<Option, 2> machines{
    {{"forming-table", "Forming table", {}, "Forming table, 480 x 550 x 150 mm, as in the 2006 thesis"},
     {"router-xyz", "Router", {}, "Faster three-axis router"}}};
constexpr std::array<Option, 2> posts{
    {{"linuxcnc-xyz", "LinuxCNC", {}, "LinuxCNC, with tool changes and arcs"},
     {"grbl", "Grbl", {}, "Only words that Grbl 1.1 supports"}}};

void change_plot_settings(ActionQueue& ask, std::string_view what, std::function<void(PlotSettings&)> set) {
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
        change_plot_settings(
            ask, label, [set, chosen = *chosen](PlotSettings& settings) { set(settings, chosen); });
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
    const int at = now.hpgl.unit == hpgl::nominal_unit ? 0 : now.hpgl.unit == hpgl::table_unit ? 1 : 2;
    if (const auto chosen = ui.choice("unit", "Plotter unit", at, units); chosen && *chosen < 2) {
        const hpgl::PlotterUnit unit = *chosen == 0 ? hpgl::nominal_unit : hpgl::table_unit;
        change_plot_settings(
            ask, "Plotter unit", [unit](PlotSettings& settings) { settings.hpgl.unit = unit; });
    }
    numbers(ui, ask, now, {"unit_x_mm", "unit_y_mm"});
}

void reading_fields(Ui& ui, ActionQueue& ask, const PlotSettings& now) {
    const auto section = ui.section("reading", "HPGL import", false);
    if (!section) {
        return;
    }
    numbers(ui, ask, now, {"arc_tolerance_mm"});
    choice<hpgl::FillMode>(
        ui, ask, "fill", "Filled areas", project::fill_modes(), now.hpgl.fill, [](Project& draft, auto fill) {
            draft.plot.settings.hpgl.fill = fill;
        });
    toggle(ui,
           ask,
           "dashes",
           "Dashes",
           now.hpgl.dashes,
           "On: draw dashed line types; off: draw all lines solid",
           [](PlotSettings& s, bool on) { s.hpgl.dashes = on; });
    choice<hpgl::LineEnds>(ui,
                           ask,
                           "line_ends",
                           "Line breaks",
                           project::line_ends(),
                           now.hpgl.line_ends,
                           [](Project& draft, auto ends) { draft.plot.settings.hpgl.line_ends = ends; });
    toggle(ui,
           ask,
           "strict",
           "Strict",
           now.hpgl.strictness == hpgl::Strictness::strict,
           "Stop reading at the first error",
           [](PlotSettings& s, bool on) {
               s.hpgl.strictness = on ? hpgl::Strictness::strict : hpgl::Strictness::tolerant;
           });
}

void tip_fields(Ui& ui, ActionQueue& ask, const PlotSettings& now) {
    choice<plot::TipKind>(ui,
                          ask,
                          "tip",
                          "Tool type",
                          project::tip_kinds(),
                          now.tip.kind,
                          [](Project& draft, plot::TipKind kind) { draft.plot.settings.tip.kind = kind; });
    if (now.tip.kind != plot::TipKind::point) {
        numbers(ui, ask, now, {"tip_diameter_mm"});
    }
    if (now.tip.kind == plot::TipKind::v) {
        numbers(ui, ask, now, {"tip_angle_deg", "tip_end_mm", "tip_end_radius_mm"});
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
        change_plot_settings(ask, setting.label, [&setting, speed = *chosen](PlotSettings& settings) {
            setting.set(settings.level, speed);
            for (plot::Level& level : settings.levels) {
                setting.set(level, speed);
            }
        });
    }
}

void size_fields(Ui& ui, ActionQueue& ask, const PlotSettings& set) {
    if (const auto section = ui.section("size", "Pixels and region", false)) {
        numbers(ui,
                ask,
                set,
                {"dpi",
                 "pixel_mm",
                 "pixel_aspect",
                 "region_left_px",
                 "region_top_px",
                 "region_width_px",
                 "region_height_px"});
    }
}

void trace_fields(Ui& ui, ActionQueue& ask, const PlotSettings& set) {
    numbers(ui, ask, set, {"threshold", "speckle_px", "corner", "curve_tolerance_px"});
    choice<plot::TurnPolicy>(ui,
                             ask,
                             "turns",
                             "Turn policy",
                             project::turn_policies(),
                             set.tracing.turns,
                             [](Project& draft, auto turns) { draft.plot.settings.tracing.turns = turns; });
    if (set.use == PictureUse::outlines) {
        numbers(ui, ask, set, {"chords_mm"});
    }
}

void relief_fields(Ui& ui, ActionQueue& ask, const PlotSettings& set, const plan::PlotResult* made) {
    numbers(ui, ask, set, {"step_over_mm"});
    if (!set.step_over && made != nullptr && made->step_over > 0.0) {
        ui.note(fmt::format("Auto (from tool): {:.3f} mm.", made->step_over));
    }
    numbers(ui, ask, set, {"merge_mm"});
    if (const auto section = ui.section("roughing", "Roughing", false)) {
        numbers(ui, ask, set, {"depth_per_pass_mm", "allowance_mm", "rough_step_over_mm"});
    }
    if (const auto section = ui.section("frame", "Cut out of stock (frame)", false)) {
        numbers(ui,
                ask,
                set,
                {"frame_mm", "frame_margin_mm", "frame_tabs", "frame_tab_width_mm", "frame_tab_height_mm"});
    }
}

void dot_fields(Ui& ui, ActionQueue& ask, const PlotSettings& set) {
    numbers(ui, ask, set, {"dot_pitch_mm"});
    if (set.use == PictureUse::halftone) {
        numbers(ui, ask, set, {"dot_angle_deg"});
        return;
    }
    toggle(ui,
           ask,
           "join_dots",
           "Join dots",
           set.join_dots,
           "Join neighbouring dots of a row into one cut",
           [](PlotSettings& s, bool on) { s.join_dots = on; });
}

void carving_fields(Ui& ui, ActionQueue& ask, const PlotSettings& set, const plan::PlotResult* made) {
    tip_fields(ui, ask, set);
    numbers(ui, ask, set, {"largest_depth_mm", "depth_per_pass_mm"});
    toggle(ui,
           ask,
           "clear_floor",
           "Clear floor",
           set.clear_floor,
           "Clear areas that are wider than the bit can cut. Off: only their edges are cut, the rest is left "
           "for an end mill",
           [](PlotSettings& s, bool on) { s.clear_floor = on; });
    if (set.clear_floor) {
        numbers(ui, ask, set, {"step_over_mm"});
    }
    numbers(ui, ask, set, {"carving_tolerance_mm", "close_gaps_mm"});
    if (made != nullptr && made->carved) {
        const plot::CarvingFigures& carved = *made->carved;
        ui.value("deepest", "Max. depth", fmt::format("{:.3f}", carved.deepest), "mm");
        if (carved.floor_area > 0.0) {
            ui.value("floor", "Floor area", fmt::format("{:.4g}", carved.floor_area), "mm\u00b2");
            ui.value("floor_left", "Floor uncut", fmt::format("{:.4g}", carved.floor_left), "mm\u00b2");
        }
        ui.value("deviation", "Overcut", fmt::format("{:.4f}", std::max(0.0, carved.deviation)), "mm");
    }
}

/// Dots as deep as a relief would run into one another.
double usual_depth(PictureUse use) {
    constexpr double of_dots = 0.3;
    return use == PictureUse::dots ? of_dots : PlotSettings().depth;
}

void picture_fields(Ui& ui, ActionQueue& ask, const PlotSettings& set, const plan::PlotResult* made) {
    choice<PictureUse>(
        ui, ask, "use", "Operation", project::picture_uses(), set.use, [](Project& draft, PictureUse use) {
            PlotSettings& settings = draft.plot.settings;
            const bool untouched = !(std::abs(settings.depth - usual_depth(settings.use)) > 0.0);
            settings.depth = untouched ? usual_depth(use) : settings.depth;
            settings.use = use;
            if (use == PictureUse::carving) {
                project::take_v_bit(settings);
            }
        });
    numbers(ui, ask, set, {"width_mm"});
    if (made != nullptr && made->picture_size.x() > 0.0) {
        ui.note(fmt::format("{}{:.2f} x {:.2f} mm.",
                            set.size.width ? "" : "Auto (from image resolution): ",
                            made->picture_size.x(),
                            made->picture_size.y()));
    }
    choice<plot::GrayRule>(ui,
                           ask,
                           "gray",
                           "Brightness",
                           project::gray_rules(),
                           set.picture.gray,
                           [](Project& draft, auto rule) { draft.plot.settings.picture.gray = rule; });
    toggle(ui,
           ask,
           "invert",
           "Invert",
           set.picture.invert,
           "Swap dark and bright",
           [](PlotSettings& s, bool on) { s.picture.invert = on; });
    numbers(ui, ask, set, {"gray_steps"});
    if (set.use == PictureUse::outlines) {
        trace_fields(ui, ask, set);
    } else if (set.use == PictureUse::carving) {
        carving_fields(ui, ask, set, made);
        trace_fields(ui, ask, set);
    } else {
        if (set.use != PictureUse::halftone) {
            numbers(ui, ask, set, {"depth_mm"});
        }
        tip_fields(ui, ask, set);
        set.use == PictureUse::relief ? relief_fields(ui, ask, set, made) : dot_fields(ui, ask, set);
    }
    size_fields(ui, ask, set);
}

/// That of a G-code program counts until a person types another; the reset button gives it back.
void spindle_field(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto made = now.plot.latest();
    const double usual = made && made->program_rpm > 0.0 ? made->program_rpm : project::usual_spindle_rpm;
    const auto& setting = project::plot_number("spindle_rpm");
    const FieldInfo info{setting.id,
                         setting.label,
                         setting.unit,
                         setting.tip,
                         setting.min,
                         setting.max,
                         usual,
                         setting.decimals};
    if (const auto chosen = ui.number(now.plot.settings().spindle_rpm.value_or(usual), info)) {
        const bool typed = std::abs(*chosen - usual) > 0.0;
        change_plot_settings(ask, setting.label, [typed, rpm = *chosen](PlotSettings& settings) {
            settings.spindle_rpm = typed ? std::optional(rpm) : std::nullopt;
        });
    }
}

/// One of a few names, which is what the settings keep.
void name_choice(Ui& ui,
                 ActionQueue& ask,
                 std::string_view id,
                 std::string_view label,
                 std::span<const Option> names,
                 const std::string& now,
                 std::string PlotSettings::*member) {
    int at = 0;
    for (std::size_t n = 0; n < names.size(); ++n) {
        at = names[n].id == now ? static_cast<int>(n) : at;
    }
    if (const auto chosen = ui.choice(id, label, at, names)) {
        change_plot_settings(ask,
                             label,
                             [name = std::string(names[static_cast<std::size_t>(*chosen)].id),
                              member](PlotSettings& s) { s.*member = name; });
    }
}

void drawing_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const PlotSettings& set = now.plot.settings();
    choice<project::DrawingUse>(ui,
                                ask,
                                "use",
                                "Operation",
                                project::drawing_uses(),
                                set.drawing_use,
                                [](Project& draft, project::DrawingUse use) {
                                    draft.plot.settings.drawing_use = use;
                                    if (use == project::DrawingUse::carving) {
                                        project::take_v_bit(draft.plot.settings);
                                    }
                                });
    unit_fields(ui, ask, set);
    if (set.drawing_use == project::DrawingUse::carving) {
        const std::shared_ptr<const plan::PlotResult> made = now.plot.latest();
        carving_fields(ui, ask, set, made.get());
    }
    reading_fields(ui, ask, set);
}

bool stands_as_it_is(const FrameState& now) {
    return project::is_path_file(now.plot.file()) || project::is_point_file(now.plot.file()) ||
           project::is_gcode_file(now.plot.file());
}

widgets::Permission unless_path(const FrameState& now, const char* reason) {
    return stands_as_it_is(now) ? widgets::Permission::refused(reason) : widgets::Permission{};
}

} // namespace

bool cuts_strokes(const FrameState& now) {
    return !project::is_cut_by_tip({now.plot.file(), now.plot.settings()});
}

void source_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (project::is_picture_file(now.plot.file())) {
        const std::shared_ptr<const plan::PlotResult> made = now.plot.latest();
        picture_fields(ui, ask, now.plot.settings(), made.get());
    } else if (const auto made = now.plot.latest(); made && made->points) {
        ui.note("Points for an XYZ table: the table plays them unchanged, one per period. A program made "
                "from them uses the feed rates set under Work.");
    } else if (project::is_path_file(now.plot.file())) {
        ui.note("A path file: it is cut unchanged.");
    } else if (project::is_gcode_file(now.plot.file())) {
        ui.note("A G-code program: it is cut unchanged, with its own heights and feed rates.");
        numbers(ui, ask, now.plot.settings(), {"chord_length_mm"});
    } else {
        drawing_fields(ui, now, ask);
    }
}

void stroke_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const PlotSettings& set = now.plot.settings();
    const plot::StrokePlan& plan = set.strokes;
    const widgets::Permission shaping = unless_path(
        now, "Files with their own path are cut unchanged. This setting applies to drawings only.");
    if (const auto section = ui.section("cutter", "Cutter")) {
        numbers(ui, ask, set, {"tool_mm"}); // how wide it cuts is seen of path files, too
        const auto permitted = ui.permitted(shaping);
        choice<plot::CutterSide>(
            ui,
            ask,
            "side",
            "Cutter side",
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
        const auto permitted = ui.permitted(shaping);
        numbers(ui, ask, set, {"hatch_mm", "hatch_angle_deg"});
        toggle(ui,
               ask,
               "cross",
               "Crosshatch",
               plan.hatch_cross,
               "Add a second hatch at a right angle",
               [](PlotSettings& s, bool on) { s.strokes.hatch_cross = on; });
        numbers(ui, ask, set, {"contours_mm"});
    }
    if (const auto section = ui.section("travel", "Travel")) {
        const auto permitted = ui.permitted(shaping);
        toggle(ui,
               ask,
               "order",
               "Optimise order",
               plan.order,
               "Reorder and reverse strokes to shorten the travel",
               [](PlotSettings& s, bool on) { s.strokes.order = on; });
        numbers(ui, ask, set, {"link_mm"});
        toggle(ui,
               ask,
               "inside",
               "Stay inside",
               plan.link_inside,
               "Links do not cross closed strokes",
               [](PlotSettings& s, bool on) { s.strokes.link_inside = on; });
    }
}

void work_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("work", "Work");
    if (!section) {
        return;
    }
    const PlotSettings& set = now.plot.settings();
    {
        const bool has_feeds = stands_as_it_is(now) && !project::is_point_file(now.plot.file());
        const auto permitted = ui.permitted(
            has_feeds ? widgets::Permission::refused("The file has its own feed rates and heights.")
                      : widgets::Permission{});
        speed_of_all(ui, ask, set, "feed_mm_per_min", "Feed rate along strokes and rows, for all pens");
        speed_of_all(ui, ask, set, "plunge_mm_per_min", "Plunge feed rate, for all pens");
        numbers(ui, ask, set, {"safe_height_mm"});
    }
    numbers(ui, ask, set, {"plate_mm"});
    const bool relief = project::is_picture_file(now.plot.file()) && set.use == PictureUse::relief;
    const bool cut_out = relief && set.frame;
    if (set.plate > 0.0 || cut_out) {
        toggle(ui,
               ask,
               "through",
               "Cut through",
               set.through,
               "The path may be deeper than the plate thickness",
               [](PlotSettings& s, bool on) { s.through = on; });
    }
    spindle_field(ui, now, ask);
    numbers(ui, ask, set, {"origin_x_mm", "origin_y_mm"});
    numbers(ui, ask, set, {"change_x_mm", "change_y_mm", "change_z_mm"});
    name_choice(ui, ask, "machine", "Machine", machines, set.machine, &PlotSettings::machine);
    name_choice(ui, ask, "post", "Controller", posts, set.post, &PlotSettings::post);
}

void light_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    numbers(ui, ask, now.plot.settings(), {"half_light_mm"});
}

} // namespace millwright::panels
