#include "ui/panels/stands_fields.h"

#include "core/base/units.h"

#include <string>
#include <vector>

namespace millwright::panels {

namespace {

using drivers::DriverState;
using kinematics::AxisKind;

/// Of each axis, mm or degrees: what was entered, at first what is assumed.
std::vector<double> entered(const Workbench& now) {
    const actions::ControllerView& machine = now.controller;
    std::vector<double> values = now.session.hand.stands;
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

bool asks_where_it_stands(const actions::ControllerView& machine) {
    const bool known = machine.status.position_known && machine.status.position_doubt.empty();
    return machine.connected() && machine.can.told_place && !known &&
           std::ssize(machine.axes) == machine.status.position.size();
}

void stands_fields(Ui& ui, const Workbench& now, ActionQueue& ask) {
    const auto scope = ui.scope("stands");
    const actions::ControllerView& machine = now.controller;
    ui.note("This machine does not report its position. Read it at the machine and enter it:");
    const std::vector<double> values = entered(now);
    for (std::size_t n = 0; n < machine.axes.size(); ++n) {
        const std::string letter(1, machine.axes[n].letter);
        const bool turns = machine.axes[n].kind == AxisKind::rotary;
        const widgets::FieldInfo info{letter, letter, turns ? "\u00b0" : "mm", "Machine coordinates"};
        if (const auto value = ui.number(values[n], info)) {
            ask.show([values, n, value = *value](actions::Session& session) {
                session.hand.stands = values;
                session.hand.stands[n] = value;
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
        ask.show([](actions::Session& session) { session.hand.stands.clear(); });
    }
}

} // namespace millwright::panels
