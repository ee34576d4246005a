// Connecting a machine and what it can do as a whole. Its axes are moved by the panel (hold_to_run_jog.h).
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/at_rest.h"
#include "ui/workspaces/machine_connection.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using drivers::DriverState;
using widgets::Permission;

Permission can_connect(const FrameState& now) {
    if (now.job.running) {
        return Permission::refused("A job is running.");
    }
    switch (now.connection.link) {
    case LinkState::connecting:
        return Permission::refused("The machine is being connected.");
    case LinkState::connected:
        return Permission::refused("A machine is connected.");
    case LinkState::closing:
        return Permission::refused("The machine is being disconnected.");
    case LinkState::none:
        break;
    }
    return {};
}

Permission is_connected(const FrameState& now) {
    return now.connection.connected() ? Permission{} : Permission::refused("No machine is connected.");
}

Permission can_disconnect(const FrameState& now) {
    return now.job.running ? Permission::refused("A job is running.") : is_connected(now);
}

Permission in_alarm(const FrameState& now) {
    if (const Permission connected = is_connected(now); !connected.allowed) {
        return connected;
    }
    if (now.connection.status.link_lost) {
        return Permission::refused("The link is lost: reconnect first.");
    }
    return now.connection.status.state == DriverState::alarm ? Permission{}
                                                             : Permission::refused("No alarm is active.");
}

Permission can_reconnect(const FrameState& now) {
    if (const Permission connected = can_disconnect(now); !connected.allowed) {
        return connected;
    }
    return now.connection.status.link_lost ? Permission{} : Permission::refused("The link is not lost.");
}

Permission can_home(const FrameState& now) {
    if (const Permission connected = is_connected(now); !connected.allowed) {
        return connected;
    }
    if (const Permission in_sight = seen(now); !in_sight.allowed) {
        return in_sight;
    }
    if (!now.connection.can.manual.home) {
        const std::string_view why = now.connection.can.manual.why_no_home;
        return Permission::refused(why.empty() ? "This machine cannot home." : std::string(why));
    }
    if (now.connection.status.link_lost) {
        return Permission::refused("The link is lost: reconnect first.");
    }
    const DriverState state = now.connection.status.state;
    const std::string_view unlock_first = now.connection.row().why_no_home_in_alarm;
    if (state == DriverState::alarm && !unlock_first.empty()) {
        return Permission::refused(std::string(unlock_first));
    }
    if (!now.connection.status.powered) {
        return Permission::refused("The motors have no power.");
    }
    if (waits_for_tool(now.connection.status) && state == DriverState::holding) {
        return {};
    }
    const bool at_rest =
        state == DriverState::idle || state == DriverState::stopped || state == DriverState::alarm;
    return at_rest && !now.job.running ? Permission{} : Permission::refused("The machine is moving.");
}

Permission can_trust(const FrameState& now) {
    if (const Permission connected = can_disconnect(now); !connected.allowed) {
        return connected;
    }
    if (!now.connection.can.reports.position) {
        return Permission::refused("This machine does not report its position: enter it.");
    }
    return now.connection.status.position_doubt.empty() ? Permission::refused("The position is not in doubt.")
                                                        : Permission{};
}

Permission can_single(const FrameState& now) {
    if (const Permission connected = is_connected(now); !connected.allowed) {
        return connected;
    }
    return now.connection.can.program.single_block
               ? Permission{}
               : Permission::refused("This machine cannot stop after each block.");
}

Permission can_arm(const FrameState& now) {
    if (const Permission connected = is_connected(now); !connected.allowed) {
        return connected;
    }
    return now.connection.can.manual.jog ? Permission{} : Permission::refused("This machine cannot jog.");
}

void add_links(Actions& actions) {
    add(actions,
        {"machine.connect",
         "Machine",
         "Connect",
         "Opens the link to the chosen machine. Nothing moves.",
         "",
         icons::plug},
        can_connect,
        [](ActionContext& context) { context.app.connect(); });
    add(actions,
        {"machine.disconnect",
         "Machine",
         "Disconnect",
         "Stops all motion, disables the motors of an arm, and closes the link.",
         "",
         icons::cancel},
        can_disconnect,
        [](ActionContext& context) { context.app.connection().disconnect(); });
    add(actions,
        {"machine.reconnect",
         "Machine",
         "Reconnect",
         "Restores a lost link. Nothing moves, and nothing that was interrupted continues.",
         "",
         icons::plug},
        can_reconnect,
        [](ActionContext& context) { context.app.connection().reconnect(); });
}

void add_readiness(Actions& actions) {
    add(actions,
        {"machine.reset",
         "Machine",
         "Unlock",
         "Clears an alarm after you have inspected the machine: it can move again. Nothing moves now.",
         "",
         icons::unlock},
        in_alarm,
        [](ActionContext& context) { context.app.connection().reset(); });
    add(actions,
        {"machine.trust_position",
         "Machine",
         "Confirm position",
         "Confirms the reported position after you have inspected the machine. Nothing moves.",
         "",
         icons::check},
        can_trust,
        [](ActionContext& context) {
            context.app.connection().tell([](drivers::Driver& driver) { driver.trust_position(); });
        });
    add(actions,
        {"machine.home",
         "Machine",
         "Home",
         "Finds the machine's zero with its switches. The machine moves.",
         "",
         icons::home},
        can_home,
        [](ActionContext& context) {
            context.app.connection().tell([](drivers::Driver& driver) { driver.home(); });
        });
}

void add_hand_control(Actions& actions) {
    add(
        actions,
        {"machine.single_block",
         "Machine",
         "Single block",
         "Pauses the machine after each block until it is resumed.",
         "",
         icons::step_forward},
        can_single,
        [](ActionContext& context) {
            const bool on = !context.view_state.manual.single_block;
            if (context.now.job.running) {
                context.jobs.set_single_block(on);
            } else {
                context.app.connection().tell([on](drivers::Driver& driver) { driver.set_single_block(on); });
            }
            context.view_state.manual.single_block = on;
        },
        [](const FrameState& now) { return now.view_state.manual.single_block; });
    add(
        actions,
        {"machine.arm_keys",
         "Machine",
         "Keyboard jog",
         "While held, arrow keys jog X and Y, and page keys jog Z.",
         "Ctrl+J",
         icons::keyboard},
        can_arm,
        [](ActionContext& context) {
            context.view_state.manual.keys_armed = !context.view_state.manual.keys_armed;
        },
        [](const FrameState& now) { return now.view_state.manual.keys_armed; });
    add(
        actions,
        {"machine.arm_gamepad",
         "Machine",
         "Gamepad jog",
         "While a bumper is held, the left stick jogs X and Y, the right stick Z, and the D-pad the rotary "
         "axes.",
         "",
         icons::machine},
        can_arm,
        [](ActionContext& context) {
            context.view_state.manual.pad_armed = !context.view_state.manual.pad_armed;
        },
        [](const FrameState& now) { return now.view_state.manual.pad_armed; });
}

} // namespace

void add_controller_actions(Actions& actions) {
    add_links(actions);
    add_readiness(actions);
    add_hand_control(actions);
}

} // namespace millwright::actions
