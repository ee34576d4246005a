// What a person can do with the arm as a whole; its joints and its goal are moved by panels and the view.
#include "ui/actions/arm_bench.h"
#include "ui/actions/at_rest.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/actions/workshop.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using drivers::DriverState;
using widgets::Permission;

Permission drawn(const Workbench& now) {
    if (now.session.workspace != Workspace::arm || !now.arm.loaded()) {
        return Permission::refused("Available only in the Arm workspace (Shift+F6).");
    }
    return now.arm_connected() ? Permission::refused("The view follows the connected controller.")
                               : Permission{};
}

Permission can_go(const Workbench& now) {
    const Permission able = drawn(now);
    return able.allowed && now.arm.chosen() < 0
               ? Permission::refused("Set a goal that the arm can reach first.")
               : able;
}

Permission moves(const Workbench& now) {
    return now.arm.moving() || now.arm.works_out_path_motion() ? Permission{}
                                                               : Permission::refused("Nothing is moving.");
}

Permission can_enable(const Workbench& now) {
    if (!now.controller.connected() || !now.controller.can.power) {
        return Permission::refused("No controller is connected whose motors can be enabled here.");
    }
    if (const Permission in_sight = seen(now); !in_sight.allowed) {
        return in_sight;
    }
    if (now.controller.status.powered) {
        return Permission::refused("The motors already have power.");
    }
    const DriverState state = now.controller.status.state;
    if (state == DriverState::alarm) {
        return Permission::refused("Alarm: inspect the arm, then unlock it.");
    }
    return state == DriverState::idle || state == DriverState::stopped
               ? Permission{}
               : Permission::refused("The arm is moving.");
}

void enable(Hands& hands) {
    hands.workshop.controller().tell([](drivers::Driver& driver) { driver.enable(); });
}

template <ArmMove how> void move_arm(Hands& hands) {
    hands.workshop.arm().go(how);
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
        [](Hands& hands) { hands.workshop.arm().go_home(); });
    add(actions,
        {"arm.open", menu, "Open an arm", "Loads an arm description from a file.", "", icons::folder},
        drawn,
        [](Hands& hands) { hands.session.question = FileQuestion::open_arm; });
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
        [](Hands& hands) { hands.workshop.arm().stop(); });
    add(
        actions,
        {"arm.clear_trace",
         menu,
         "Clear the trace",
         "Clears the recorded path of the tip.",
         "",
         icons::remove},
        [](const Workbench& now) {
            return now.arm.loaded() ? Permission{} : Permission::refused("No arm is loaded.");
        },
        [](Hands& hands) { hands.workshop.arm().clear_trace(); });
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
