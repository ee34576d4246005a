#include "ui/toolpath_panels/program_file_panel.h"

#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/assets.h"
#include "ui/panels/axis_positions.h"
#include "ui/panels/fields.h"
#include "ui/panels/lines.h"
#include "ui/simulation_panels/simulation_fields.h"
#include "ui/toolpath_panels/modal_text.h"
#include "ui/widgets/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::panels {

namespace {

constexpr std::array<widgets::Option, 2> dialects{
    {{"linuxcnc", "LinuxCNC", {}, "RS-274/NGC as interpreted by LinuxCNC 2.9"},
     {"grbl", "Grbl 1.1", {}, "The Grbl 1.1 subset, with the errors that Grbl reports"}}};

std::string path_mode_text(program::PathMode mode) {
    switch (mode) {
    case program::PathMode::exact_path:
        return "G61 exact path";
    case program::PathMode::exact_stop:
        return "G61.1 exact stop";
    case program::PathMode::continuous:
        break;
    }
    return "G64 blending";
}

std::string cutter_text(gcode::CutterSide side) {
    return side == gcode::CutterSide::off    ? "G40 off"
           : side == gcode::CutterSide::left ? "G41 left"
                                             : "G42 right";
}

/// What the plan says about one instant.
struct PlannedHere {
    double speed_mm_per_min = 0.0; ///< of the linear axes together
    std::string limit;

    PlannedHere(const plan::OpenedProgram& opened, double time) {
        const motion::Trajectory& planned = *opened.motion->trajectory;
        const motion::Sample sample = planned.at(time);
        double sum = 0.0;
        for (const int axis : opened.machine->linear_axes()) {
            sum += square(sample.velocity[axis]);
        }
        speed_mm_per_min = to_mm_per_min(std::sqrt(sum));
        limit = limit_text(planned.limit_at(time), *opened.motion->program);
    }
};

} // namespace

std::string limit_text(const motion::Cause& limit, const program::Program& program) {
    switch (limit.limit) {
    case motion::Limit::standing:
        return "standstill";
    case motion::Limit::programmed_feed:
        return "programmed feed";
    case motion::Limit::corner:
        return "corner";
    case motion::Limit::axis_velocity:
    case motion::Limit::axis_acceleration:
    case motion::Limit::axis_jerk: {
        const std::string what = limit.limit == motion::Limit::axis_velocity ? "velocity"
                                 : limit.limit == motion::Limit::axis_jerk   ? "jerk"
                                                                             : "acceleration";
        const bool known = limit.axis >= 0 && limit.axis < static_cast<int>(program.axes.size());
        return known
                   ? fmt::format("{} of {}", what, program.axes[static_cast<std::size_t>(limit.axis)].letter)
                   : what;
    }
    }
    return {};
}

void ProgramFilePanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    draw_file(ui, now, ask);
    draw_faults(ui, now, ask);
    simulation_fields(ui, now, ask, catalogue_);
    if (const auto section = ui.section("position", "Axis positions at this line")) {
        axis_positions(ui, now);
    }
    draw_modal(ui, now);
}

void ProgramFilePanel::draw_file(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("file", "G-code file");
    if (!section) {
        return;
    }
    const plan::OpenedProgram& opened = *now.opened;
    ui.value("name", "File", opened.file.filename().string());
    draw_choices(ui, now, ask);
    ui.value("lines", "Lines", opened.text ? fmt::format("{}", opened.text->lines().count()) : "\u2026");
    ui.value("moves", "Moves", fmt::format("{}", std::max<std::int64_t>(opened.path.point_count() - 1, 0)));
    const bool known = opened.execution != nullptr;
    ui.value("length", "Tool-tip travel", known ? fixed(opened.length, 1) : "\u2026", known ? "mm" : "");
    ui.value("time",
             opened.motion ? "Planned time" : "Nominal time",
             known ? clock_time(actions::duration_of(opened)) : "\u2026");
    if (!opened.no_motion.empty()) {
        ui.note(opened.no_motion);
    } else if (opened.cancelled) {
        ui.note("Reading was cancelled: only the first part of the program is shown.");
    }
    const auto row = ui.row(2);
    action_button(ui, now, ask, catalogue_, "file.read_again", widgets::Rank::normal, "Reload");
    action_button(ui, now, ask, catalogue_, "file.close_program", widgets::Rank::normal, "Close");
}

void ProgramFilePanel::draw_choices(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (machines_.empty()) {
        machines_ = project::machine_ids(now.assets);
    }
    const plan::ReadingChoice& choice = now.opened->choice;
    const auto read_with = [&](const plan::ReadingChoice& wanted) {
        ask.show([wanted](actions::ViewState& view_state) { view_state.file.reading = wanted; });
        ask.run("file.read_again");
    };
    std::vector<widgets::Option> options;
    for (const std::string& id : machines_) {
        options.push_back({id, id});
    }
    const auto at = std::ranges::find(machines_, choice.machine);
    const auto can = catalogue_.find("file.read_again").permission(now);
    const auto permitted = ui.permitted(can);
    if (const auto chosen = ui.choice("machine",
                                      "Machine",
                                      static_cast<int>(at - machines_.begin()),
                                      options,
                                      "Machine whose axes and limits are used for display and planning")) {
        read_with({choice.dialect, machines_[static_cast<std::size_t>(*chosen)]});
    }
    if (const auto chosen = ui.choice("dialect",
                                      "Dialect",
                                      static_cast<int>(choice.dialect),
                                      dialects,
                                      "G-code dialect of the program")) {
        read_with({static_cast<gcode::Dialect>(*chosen), choice.machine});
    }
}

void ProgramFilePanel::draw_faults(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    std::vector<const Diagnostic*> all;
    for (const auto* list : {&now.opened->errors, &now.opened->faults}) {
        for (const Diagnostic& fault : *list) {
            all.push_back(&fault);
        }
    }
    if (all.empty()) {
        return;
    }
    const auto section =
        ui.section("faults", all.size() == 1 ? "1 error" : fmt::format("{} errors", all.size()));
    if (!section) {
        return;
    }
    constexpr std::array<widgets::Column, 2> columns{{{"Line", "", 1.0F, true}, {"Error", "", 5.0F, false}}};
    constexpr float rows_shown = 6.0F;
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(all);
    view.cell = [&](std::ptrdiff_t row, int column) {
        const Diagnostic& fault = *all[static_cast<std::size_t>(row)];
        return column == 0 ? (fault.place.line > 0 ? std::to_string(fault.place.line) : std::string("-"))
                           : fault.message;
    };
    view.row_id = [](std::ptrdiff_t row) { return std::to_string(row); };
    view.height = ui.px(26.0F * (1.0F + std::min(rows_shown, static_cast<float>(all.size()))) + 4.0F);
    if (const auto row = widgets::table(ui, "errors", view)) {
        const int line = all[static_cast<std::size_t>(*row)]->place.line;
        if (line > 0) {
            go_to_line(now, ask, line - 1);
        }
    }
}

void ProgramFilePanel::draw_modal(Ui& ui, const FrameState& now) const {
    const auto section = ui.section("modal", "Active modes (G/M)");
    const auto place = now.file_place();
    if (!section) {
        return;
    }
    if (!place) {
        ui.note(now.opened->finished ? "The program has no lines." : "Reading the file \u2026");
        return;
    }
    const gcode::ModalView state = now.opened->execution->state_after(place->step);
    ui.value("line", "Line", fmt::format("{}", place->line));
    if (now.opened->motion) {
        const PlannedHere here(*now.opened, now.time());
        ui.value("speed", "Current speed", fixed(here.speed_mm_per_min, 0), "mm/min");
        ui.value("limit", "Limited by", here.limit);
    }
    ui.value("motion", "Motion", g_word(state.motion));
    ui.value("feed", "Feed", feed_text(state));
    ui.value("spindle", "Spindle", spindle_text(state));
    ui.value("coolant", "Coolant", coolant_text(state));
    ui.value("tool", "Tool", state.tool > 0 ? fmt::format("T{}", state.tool) : "none");
    ui.value("distance", "Distance mode", state.incremental ? "G91 incremental" : "G90 absolute");
    ui.value("units", "Units", state.unit == gcode::LengthUnit::inch ? "G20 inch" : "G21 mm");
    ui.value("plane", "Plane", plane_text(state.plane));
    ui.value("system", "Work offset", coordinate_system_text(state.coordinate_system));
    ui.value("offset", "Offset value", offset_text(state.g5x_offset));
    ui.value("g92", "G92 offset", offset_text(state.g92_offset));
    ui.value("tool_offset", "Tool offset", offset_text(state.tool_offset));
    if (state.rotation_deg < 0.0F || state.rotation_deg > 0.0F) {
        ui.value("rotation", "Rotation", fixed(static_cast<double>(state.rotation_deg), 3), "deg");
    }
    ui.value("cutter", "Cutter comp.", cutter_text(state.cutter));
    ui.value("path_mode", "Path control", path_mode_text(state.path_mode));
}

} // namespace millwright::panels
