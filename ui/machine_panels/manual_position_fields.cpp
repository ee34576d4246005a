#include "ui/machine_panels/manual_position_fields.h"

#include "core/base/units.h"

#include <string>
#include <vector>

namespace millwright::panels {

namespace {

using drivers::DriverState;
using kinematics::AxisKind;

/// Of each axis, mm or degrees: what was entered, at first what is assumed.
std::vector<double> entered(const FrameState& now) {
    const actions::ConnectionView& machine = now.connection;
    std::vector<double> values = now.view_state.manual.position;
    for (std::size_t n = values.size(); n < machine.axes.size(); ++n) {
        const double at = machine.status.position[static_cast<Eigen::Index>(n)];
        values.push_back(machine.axes[n].kind == AxisKind::rotary ? to_degrees(at) : at);
    }
    values.resize(machine.axes.size());
    return values;
}

widgets::Permission can_say(const drivers::DriverStatus& status) {
    if (status.link_lost) {
        return widgets::Permission::refused("The link is lost: reconnect first.");
    }
    if (status.state == DriverState::alarm) {
        return widgets::Permission::refused("Alarm: inspect the machine, then unlock it.");
    }
    const bool rests = status.state == DriverState::idle || status.state == DriverState::stopped;
    return rests ? widgets::Permission{} : widgets::Permission::refused("The machine is moving.");
}

} // namespace

bool needs_manual_position(const actions::ConnectionView& machine) {
    const bool known = machine.status.position_known && machine.status.position_doubt.empty();
    return machine.connected() && !machine.can.reports.position && !known &&
           std::ssize(machine.axes) == machine.status.position.size();
}

void manual_position_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto scope = ui.scope("stands");
    const actions::ConnectionView& machine = now.connection;
    ui.note("This machine does not report its position. Read it at the machine and enter it:");
    const std::vector<double> values = entered(now);
    for (std::size_t n = 0; n < machine.axes.size(); ++n) {
        const std::string letter(1, machine.axes[n].letter);
        const bool turns = machine.axes[n].kind == AxisKind::rotary;
        const widgets::FieldInfo info{letter, letter, turns ? "\u00b0" : "mm", "Machine coordinates"};
        if (const auto value = ui.number(values[n], info)) {
            ask.show([values, n, value = *value](actions::ViewState& view_state) {
                view_state.manual.position = values;
                view_state.manual.position[n] = value;
            });
        }
    }
    if (ui.button("there", "Set position", can_say(machine.status))) {
        kinematics::AxisPositions place(std::ssize(machine.axes));
        for (std::size_t n = 0; n < values.size(); ++n) {
            const bool turns = machine.axes[n].kind == AxisKind::rotary;
            place[static_cast<Eigen::Index>(n)] = turns ? from_degrees(values[n]) : values[n];
        }
        ask.tell([place](drivers::Driver& driver) { driver.stands_at(place); });
        ask.show([](actions::ViewState& view_state) { view_state.manual.position.clear(); });
    }
}

} // namespace millwright::panels
