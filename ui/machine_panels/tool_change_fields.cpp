#include "ui/machine_panels/tool_change_fields.h"

#include "ui/machine_panels/manual_fields.h"
#include "ui/panels/fields.h"
#include "ui/widgets/notices.h"
#include "ui/workspaces/tool_changes.h"

#include <fmt/format.h>

#include <array>
#include <string>

namespace millwright::panels {

namespace {

using actions::ToolChangeSettings;
using drivers::ToolChangeWay;
using drivers::ToolSensor;

constexpr std::array<widgets::Option, 4> way_options{
    {{"none", "Refuse the program", {}, "Do not run programs that contain M6"},
     {"stop", "Stop and wait", {}, "Pause: change the tool and set its zero, then continue"},
     {"probe",
      "Measure at sensor",
      {},
      "Pause for the tool change, then measure the tool length at a fixed sensor"},
     {"macro", "Run macro file", {}, "Pause for the tool change, then send the lines of a file"}}};

void set(ActionQueue& ask, const FrameState& now, ToolChangeSettings settings) {
    ask.show([address = now.connection.choice.address, settings = std::move(settings)](
                 actions::ViewState& view_state) { view_state.manual.tool_changes[address] = settings; });
}

struct SensorField {
    std::string_view id, label, unit, tip;
    double ToolSensor::*value;
    double least, most;
};

constexpr std::array<SensorField, 5> sensor_fields{
    {{"sensor_x", "Sensor X", "mm", "Position in machine coordinates", &ToolSensor::x, -1e5, 1e5},
     {"sensor_y", "Sensor Y", "mm", "Position in machine coordinates", &ToolSensor::y, -1e5, 1e5},
     {"travel_z",
      "Travel height Z",
      "mm",
      "Machine coordinates; the longest tool can move freely at this height",
      &ToolSensor::travel_z,
      -1e5,
      1e5},
     {"deepest_z",
      "Lowest probe Z",
      "mm",
      "Machine coordinates; probing stops here with an alarm",
      &ToolSensor::deepest_z,
      -1e5,
      1e5},
     {"sensor_feed",
      "Probe feed",
      "mm/min",
      "Feed rate of the first contact; the second contact uses one fifth of it",
      &ToolSensor::feed,
      1.0,
      5000.0}}};

void draw_sensor(Ui& ui, const FrameState& now, ActionQueue& ask, const ToolChangeSettings& settings) {
    for (const SensorField& field : sensor_fields) {
        const widgets::FieldInfo info{field.id,
                                      field.label,
                                      field.unit,
                                      field.tip,
                                      field.least,
                                      field.most,
                                      no_default,
                                      field.unit == "mm" ? 3 : 0};
        if (const auto value = ui.number(settings.plan.sensor.*field.value, info)) {
            ToolChangeSettings changed = settings;
            changed.plan.sensor.*field.value = *value;
            set(ask, now, changed);
        }
    }
}

} // namespace

void tool_change_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (!now.connection.connected() || !now.connection.can.program.tool_changes) {
        return;
    }
    const auto section = ui.section("tool_changes", "Tool changes");
    if (!section) {
        return;
    }
    const ToolChangeSettings settings = actions::tool_change_settings(now.view_state.manual, now.connection);
    const bool here = actions::tool_change_plan(now.view_state.manual, now.connection).has_value();
    const int way = here ? 1 + static_cast<int>(settings.plan.way) : 0;
    if (const auto chosen = ui.choice("way", "At M6", way, way_options, "Action at a tool change")) {
        ToolChangeSettings changed = settings;
        changed.here = *chosen > 0;
        changed.plan.way = *chosen > 0 ? static_cast<ToolChangeWay>(*chosen - 1) : changed.plan.way;
        set(ask, now, changed);
    }
    if (!here) {
        return;
    }
    const widgets::FieldInfo spin_up{"spin_up",
                                     "Spin-up time",
                                     "s",
                                     "Time for the spindle to reach its speed before the tool moves down",
                                     0.0,
                                     600.0,
                                     no_default,
                                     1};
    if (const auto value = ui.number(settings.plan.spin_up, spin_up)) {
        ToolChangeSettings changed = settings;
        changed.plan.spin_up = *value;
        set(ask, now, changed);
    }
    if (settings.plan.way == ToolChangeWay::probe) {
        draw_sensor(ui, now, ask, settings);
    } else if (settings.plan.way == ToolChangeWay::macro) {
        if (const auto file = ui.text_field(
                "macro", "File", settings.plan.macro_file, "G-code file to send after the tool change")) {
            ToolChangeSettings changed = settings;
            changed.plan.macro_file = *file;
            set(ask, now, changed);
        }
    }
}

namespace {

std::string_view what_a_person_can_do(const drivers::ToolChangeStatus& change) {
    return change.held         ? "Press Resume to end the hold."
           : change.keeps_zero ? "Change the tool, then press Continue: the tool is raised and measured, "
                                 "then returns to its position."
                               : "Jog and set the Z zero, then press Continue. If the tool has to return, it "
                                 "is raised first.";
}

} // namespace

bool tool_change_banner(Ui& ui, const FrameState& now) {
    const drivers::DriverStatus& status = now.connection.status;
    if (!now.job.running || !actions::waits_for_tool(status)) {
        return false;
    }
    const std::string why = status.message.empty() ? "The job is waiting for a tool change." : status.message;
    (void)widgets::banner(ui,
                          "tool_change",
                          {widgets::Severity::warning,
                           fmt::format("Job waiting: {}. {}", why, what_a_person_can_do(*status.tool_change)),
                           {}});
    return true;
}

} // namespace millwright::panels
