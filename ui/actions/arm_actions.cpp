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
        return Permission::refused("In the Arm workspace (Shift+F6) only.");
    }
    return now.arm_connected() ? Permission::refused("The picture follows the connected controller.")
                               : Permission{};
}

Permission can_go(const Workbench& now) {
    const Permission able = drawn(now);
    return able.allowed && now.arm.chosen() < 0
               ? Permission::refused("Set a goal that the arm reaches first.")
               : able;
}

Permission moves(const Workbench& now) {
    return now.arm.moving() || now.arm.works_out_path_motion() ? Permission{}
                                                               : Permission::refused("Nothing moves.");
}

Permission can_enable(const Workbench& now) {
    if (!now.controller.connected() || !now.controller.can.power) {
        return Permission::refused("Nothing is connected whose motors get their power from here.");
    }
    if (const Permission in_sight = seen(now); !in_sight.allowed) {
        return in_sight;
    }
    if (now.controller.status.powered) {
        return Permission::refused("The motors have power.");
    }
    const DriverState state = now.controller.status.state;
    if (state == DriverState::alarm) {
        return Permission::refused("There is an alarm: look at the arm, then unlock it first.");
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
         "Draw at home",
         "Upper arm upright, forearm level. Only the picture.",
         "",
         icons::home},
        drawn,
        [](Hands& hands) { hands.workshop.arm().go_home(); });
    add(actions,
        {"arm.open",
         menu,
         "Open an arm",
         "The file of an arm that does not ship with the program.",
         "",
         icons::folder},
        drawn,
        [](Hands& hands) { hands.session.question = FileQuestion::open_arm; });
    add(actions,
        {"arm.go_joints",
         menu,
         "Go to the goal by joints",
         "All joints at once, as fast as they can; the tool goes anywhere between.",
         "",
         icons::play},
        can_go,
        move_arm<ArmMove::joints>);
    add(actions,
        {"arm.go_straight",
         menu,
         "Go to the goal in a line",
         "The tip along a straight line, the tool turning evenly.",
         "",
         icons::toolpath},
        can_go,
        move_arm<ArmMove::straight>);
    add(actions,
        {"arm.stop", menu, "Stop the drawn arm", "It stays where it is.", "", icons::stop},
        moves,
        [](Hands& hands) { hands.workshop.arm().stop(); });
    add(
        actions,
        {"arm.clear_trace", menu, "Clear the trace", "Forgets where the tip has been.", "", icons::remove},
        [](const Workbench& now) {
            return now.arm.loaded() ? Permission{} : Permission::refused("There is no arm.");
        },
        [](Hands& hands) { hands.workshop.arm().clear_trace(); });
    add(actions,
        {"arm.enable",
         menu,
         "Give the motors power",
         "Closes the loops of the motors where they are. Look at the arm first.",
         "",
         icons::plug},
        can_enable,
        enable);
}

} // namespace millwright::actions
