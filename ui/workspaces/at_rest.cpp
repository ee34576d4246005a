#include "ui/workspaces/at_rest.h"

#include "ui/workspaces/frame_state.h"
#include "ui/workspaces/tool_changes.h"

namespace millwright::actions {

using drivers::DriverState;
using widgets::Permission;

Permission at_rest(const ConnectionView& machine) {
    if (machine.status.link_lost) {
        return Permission::refused("The link is lost: reconnect first.");
    }
    const DriverState state = machine.status.state;
    if (state == DriverState::alarm) {
        return Permission::refused(machine.row().kind == machine::MachineKind::arm
                                       ? "Alarm: inspect the arm, then unlock it."
                                   : machine.can.manual.home ? "Alarm: home or unlock first."
                                                             : "Alarm: inspect the machine, then unlock it.");
    }
    return state == DriverState::idle || state == DriverState::stopped ||
                   (state == DriverState::holding && waits_for_tool(machine.status))
               ? Permission{}
               : Permission::refused("The machine is moving.");
}

Permission seen(const FrameState& now) {
    const Workspace at = now.view_state.workspace;
    return at == Workspace::machine || at == Workspace::arm
               ? Permission{}
               : Permission::refused("Available only in the workspaces Machine (F6) and Arm (Shift+F6), "
                                     "because it causes motion.");
}

namespace {

bool reaches_arm(const ConnectionView& machine) {
    return machine.connected() && machine.row().kind == machine::MachineKind::arm &&
           !machine.status.link_lost;
}

} // namespace

bool arm_moves(const ConnectionView& machine) {
    return reaches_arm(machine) && drivers::is_at_work(machine.status.state);
}

bool arm_under_power(const ConnectionView& machine) {
    return arm_moves(machine) || (reaches_arm(machine) && machine.status.powered);
}

} // namespace millwright::actions
