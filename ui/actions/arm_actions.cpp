// What a person can do with the arm as a whole; its joints and its goal are moved by panels and the view.
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/arm_workspace.h"
#include "ui/workspaces/at_rest.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using drivers::DriverState;
using widgets::Permission;

Permission drawn(const FrameState& now) {
    if (now.view_state.workspace != Workspace::arm || !now.arm.loaded()) {
        return Permission::refused("Available only in the Arm workspace (Shift+F6).");
    }
    return now.arm_connected() ? Permission::refused("The view follows the connected controller.")
                               : Permission{};
}

Permission can_go(const FrameState& now) {
    const Permission able = drawn(now);
    return able.allowed && now.arm.chosen() < 0
               ? Permission::refused("Set a goal that the arm can reach first.")
               : able;
}

Permission moves(const FrameState& now) {
    return now.arm.moving() || now.arm.works_out_path_motion() ? Permission{}
                                                               : Permission::refused("Nothing is moving.");
}

Permission can_enable(const FrameState& now) {
    if (!now.connection.connected() || !now.connection.can.manual.power) {
        return Permission::refused("No controller is connected whose motors can be enabled here.");
    }
    if (const Permission in_sight = seen(now); !in_sight.allowed) {
        return in_sight;
    }
    if (now.connection.status.powered) {
        return Permission::refused("The motors already have power.");
    }
    const DriverState state = now.connection.status.state;
    if (state == DriverState::alarm) {
        return Permission::refused("Alarm: inspect the arm, then unlock it.");
    }
    return state == DriverState::idle || state == DriverState::stopped
               ? Permission{}
               : Permission::refused("The arm is moving.");
}

void enable(ActionContext& context) {
    context.app.connection().tell([](drivers::Driver& driver) { driver.enable(); });
}

template <ArmMove how> void move_arm(ActionContext& context) {
    context.app.arm().go(how);
}

} // namespace

void add_arm_actions(Actions& actions) {
    constexpr std::string_view menu = "Arm";
    add(actions,
        {"arm.home",
         menu,
         "Go to home pose (display only)",
         "Shows the arm with the upper arm vertical and the forearm level.",
         "",
         icons::home},
        drawn,
        [](ActionContext& context) { context.app.arm().go_home(); });
    add(actions,
        {"arm.open", menu, "Open an arm", "Loads an arm description from a file.", "", icons::folder},
        drawn,
        [](ActionContext& context) { context.view_state.file_prompt = FilePrompt::open_arm; });
    add(actions,
        {"arm.go_joints",
         menu,
         "Joint move to the goal",
         "Moves all joints at once, as fast as possible; the tool path in between is not controlled.",
         "",
         icons::play},
        can_go,
        move_arm<ArmMove::joints>);
    add(actions,
        {"arm.go_straight",
         menu,
         "Linear move to the goal",
         "Moves the tip along a straight line; the tool orientation changes uniformly.",
         "",
         icons::toolpath},
        can_go,
        move_arm<ArmMove::straight>);
    add(actions,
        {"arm.stop", menu, "Stop the simulated arm", "The arm stays where it is.", "", icons::stop},
        moves,
        [](ActionContext& context) { context.app.arm().stop(); });
    add(
        actions,
        {"arm.clear_trace",
         menu,
         "Clear the trace",
         "Clears the recorded path of the tip.",
         "",
         icons::remove},
        [](const FrameState& now) {
            return now.arm.loaded() ? Permission{} : Permission::refused("No arm is loaded.");
        },
        [](ActionContext& context) { context.app.arm().clear_trace(); });
    add(actions,
        {"arm.enable",
         menu,
         "Enable motors",
         "Closes the servo loops of the motors at their present position. Inspect the arm first.",
         "",
         icons::plug},
        can_enable,
        enable);
}

} // namespace millwright::actions
