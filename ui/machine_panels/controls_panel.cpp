#include "ui/machine_panels/controls_panel.h"

#include "core/base/text.h"
#include "core/drivers/mdi_lines.h"
#include "ui/machine_panels/manual_fields.h"
#include "ui/panels/fields.h"
#include "ui/widgets/icons.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using actions::ConnectionView;
using widgets::Permission;
using widgets::Rank;

Permission can_override(const drivers::Capabilities& can, bool feed) {
    using Range = drivers::Capabilities::OverrideRange;
    if (can.overrides == Range::none) {
        return Permission::refused("This machine has no overrides.");
    }
    return feed || can.overrides == Range::all
               ? Permission{}
               : Permission::refused("This machine supports the feed override only.");
}

/// The steps that controllers have: Grbl knows no others.
void rapid_row(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const drivers::Overrides& all = now.connection.status.overrides;
    const Permission can = can_override(now.connection.can, false);
    ui.value("rapid", "Rapid", fmt::format("{}", all.rapid), "%");
    const auto row = ui.row(3);
    for (const int percent : {25, 50, 100}) {
        if (ui.button(fmt::format("rapid_{}", percent),
                      fmt::format("{} %", percent),
                      can,
                      {{}, Rank::normal, -1.0F, {}})) {
            drivers::Overrides wanted = all;
            wanted.rapid = percent;
            ask.set_overrides(wanted);
        }
    }
}

/// -10 %, the value, +10 %, back to 100 %.
void override_row(Ui& ui,
                  const FrameState& now,
                  ActionQueue& ask,
                  const std::string& id,
                  std::string_view label,
                  int drivers::Overrides::*which) {
    constexpr int step = 10;
    constexpr int least = 10;
    constexpr int most = 200;
    const drivers::Overrides& all = now.connection.status.overrides;
    const Permission can = can_override(now.connection.can, which == &drivers::Overrides::feed);
    const auto set = [&](int percent) {
        drivers::Overrides wanted = all;
        wanted.*which = std::clamp(percent, least, most);
        ask.set_overrides(wanted);
    };
    ui.value(id, label, fmt::format("{}", all.*which), "%");
    const auto row = ui.row(3);
    if (ui.button(id + "_less", fmt::format("\u2212{}", step), can, {{}, Rank::normal, -1.0F, {}})) {
        set(all.*which - step);
    }
    if (ui.button(id + "_full", "100 %", can, {{}, Rank::normal, -1.0F, {}})) {
        set(100);
    }
    if (ui.button(id + "_more", fmt::format("+{}", step), can, {{}, Rank::normal, -1.0F, {}})) {
        set(all.*which + step);
    }
}

void probe_fields(Ui& ui, ActionQueue& ask, const actions::ManualSettings& manual) {
    manual_number(ui,
                  ask,
                  {"probe_way",
                   "Probe distance",
                   "mm",
                   "Maximum distance to search for the part",
                   0.1,
                   500.0,
                   no_default,
                   1},
                  manual.probe_way_mm,
                  &actions::ManualSettings::probe_way_mm);
    manual_number(ui,
                  ask,
                  {"probe_speed",
                   "Probe feed",
                   "mm/min",
                   "Feed rate on contact: keep it low",
                   1.0,
                   2000.0,
                   no_default,
                   0},
                  manual.probe_mm_per_min,
                  &actions::ManualSettings::probe_mm_per_min);
}

/// `z`: of the axis Z among those of the position.
void probed_value(Ui& ui, const drivers::Probing& last, std::optional<std::size_t> z) {
    const bool known = z && last.position.size() > static_cast<Eigen::Index>(*z);
    ui.value("probed",
             "Last probe",
             !last.touched ? "no contact"
             : known       ? "Z " + fixed(last.position[static_cast<Eigen::Index>(*z)], 3)
                           : "contact",
             last.touched && known ? "mm" : "");
}

} // namespace

void ControlsPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    draw_finding(ui, now, ask);
    draw_overrides(ui, now, ask);
    draw_spindle(ui, now, ask);
}

void ControlsPanel::draw_finding(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("finding", "Homing and probing");
    if (!section) {
        return;
    }
    const ConnectionView& machine = now.connection;
    action_button(ui, now, ask, catalogue_, "machine.home");
    const actions::ManualSettings& manual = now.view_state.manual;
    probe_fields(ui, ask, manual);
    const auto z = axis_named(machine, 'Z');
    Permission can = machine.can.manual.probe && z ? can_command(machine)
                                                   : Permission::refused("This machine cannot probe.");
    if (can.allowed && machine.status.spindle != gcode::SpindleTurning::stopped) {
        can = Permission::refused("The spindle is running: stop it first.");
    } else if (machine.status.inputs.probe) {
        can = Permission::refused("The probe is already triggered.");
    }
    if (ui.button(
            "probe",
            "Probe Z",
            can,
            {icons::chevron_down, Rank::normal, -1.0F, "Probe downwards with G38.2. The machine moves."})) {
        command(ask,
                drivers::probe_line(machine.axes[*z],
                                    static_cast<int>(*z),
                                    -manual.probe_way_mm,
                                    manual.probe_mm_per_min / seconds_per_minute,
                                    machine.status));
    }
    if (machine.status.probe) {
        probed_value(ui, *machine.status.probe, z);
    }
}

void ControlsPanel::draw_overrides(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("overrides", "Overrides");
    if (!section) {
        return;
    }
    override_row(ui, now, ask, "feed", "Feed", &drivers::Overrides::feed);
    rapid_row(ui, now, ask);
    override_row(ui, now, ask, "spindle", "Spindle", &drivers::Overrides::spindle);
}

void ControlsPanel::draw_spindle(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("spindle", "Spindle and coolant");
    if (!section) {
        return;
    }
    const drivers::DriverStatus& status = now.connection.status;
    const Permission can = can_command(now.connection);
    const bool turning = status.spindle != gcode::SpindleTurning::stopped;
    const bool clockwise = status.spindle == gcode::SpindleTurning::clockwise;
    ui.value("state",
             "Spindle",
             !now.connection.can.reports.spindle ? std::string("not reported")
             : turning ? fmt::format("{}, {:.0f} rpm", clockwise ? "M3" : "M4", status.spindle_rpm)
                       : std::string("stopped"));
    const double rpm = now.view_state.manual.spindle_rpm;
    manual_number(ui,
                  ask,
                  {"rpm", "Speed", "rpm", "Spindle speed for the buttons below", 0.0, 60000.0, no_default, 0},
                  rpm,
                  &actions::ManualSettings::spindle_rpm);
    {
        const auto row = ui.row(3);
        if (ui.button("clockwise", "M3", can, {{}, Rank::normal, -1.0F, "Start the spindle clockwise"})) {
            command(ask, drivers::start_spindle(rpm, true));
        }
        if (ui.button("counterclockwise",
                      "M4",
                      can,
                      {{}, Rank::normal, -1.0F, "Start the spindle counter-clockwise"})) {
            command(ask, drivers::start_spindle(rpm, false));
        }
        if (ui.button("stop", "M5", can, {{}, Rank::normal, -1.0F, "Stop the spindle"})) {
            command(ask, drivers::stop_spindle());
        }
    }
    const Permission can_mist =
        now.connection.can.mist ? can : Permission::refused("This controller does not support M7.");
    if (const auto on = ui.toggle("mist", "Mist", status.coolant.mist, "M7", can_mist)) {
        command(ask, drivers::set_coolant(*on, status.coolant.flood));
    }
    if (const auto on = ui.toggle("flood", "Flood", status.coolant.flood, "M8", can)) {
        command(ask, drivers::set_coolant(status.coolant.mist, *on));
    }
}

} // namespace millwright::panels
