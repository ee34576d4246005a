#include "ui/actions/at_rest.h"

#include "ui/actions/tool_changes.h"
#include "ui/actions/workbench.h"

namespace millwright::actions {

using drivers::DriverState;
using widgets::Permission;

Permission at_rest(const ControllerView& machine) {
    if (machine.status.link_lost) {
        return Permission::refused("The link is lost: reconnect first.");
    }
    const DriverState state = machine.status.state;
    if (state == DriverState::alarm) {
        return Permission::refused(machine.choice.kind == machine::DriverKind::pmac
                                       ? "There is an alarm: look at the arm, then unlock it first."
                                   : machine.can.home
                                       ? "There is an alarm: home or unlock first."
                                       : "There is an alarm: look at the machine, then unlock it first.");
    }
    return state == DriverState::idle || state == DriverState::stopped ||
                   (state == DriverState::holding && waits_for_tool(machine.status))
               ? Permission{}
               : Permission::refused("The machine is moving.");
}

Permission seen(const Workbench& now) {
    const Workspace at = now.session.workspace;
    return at == Workspace::machine || at == Workspace::arm
               ? Permission{}
               : Permission::refused("In the workspaces Machine (F6) and Arm (Shift+F6) only: it moves.");
}

namespace {

bool reaches_arm(const ControllerView& machine) {
    return machine.connected() && machine.choice.kind == machine::DriverKind::pmac &&
           !machine.status.link_lost;
}

} // namespace

bool arm_moves(const ControllerView& machine) {
    return reaches_arm(machine) && drivers::is_at_work(machine.status.state);
}

bool arm_under_power(const ControllerView& machine) {
    return arm_moves(machine) || (reaches_arm(machine) && machine.status.powered);
}

} // namespace millwright::actions
