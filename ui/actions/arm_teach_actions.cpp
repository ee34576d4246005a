// Points that a person teaches the arm, motion programs of its card, and the project's path on it.
#include "core/base/units.h"
#include "core/pmac/driver/arm_axes.h"
#include "core/project/taught_points.h"
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/arm_workspace.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using drivers::DriverState;
using widgets::Permission;

Permission in_workspace(const FrameState& now) {
    return now.view_state.workspace == Workspace::arm && now.arm.loaded()
               ? Permission{}
               : Permission::refused("Available only in the Arm workspace (Shift+F6).");
}

Permission known_position(const drivers::DriverStatus& status) {
    return status.position_known ? Permission{}
                                 : Permission::refused("The position is unknown: home the arm first.");
}

/// A point is where the arm stands: of a connected one that has to be known.
Permission can_teach(const FrameState& now) {
    const Permission there = in_workspace(now);
    return there.allowed && now.arm_connected() ? known_position(now.connection.status) : there;
}

/// The drawn arm may always play; a connected one at rest, with power, where its position is known.
Permission can_play_arm(const FrameState& now) {
    if (const Permission there = in_workspace(now); !there.allowed || !now.arm_connected()) {
        return there;
    }
    const drivers::DriverStatus& status = now.connection.status;
    if (status.state != DriverState::idle && status.state != DriverState::stopped) {
        return Permission::refused(status.state == DriverState::alarm ? "An alarm is active."
                                                                      : "The arm is moving.");
    }
    if (!status.powered) {
        return Permission::refused("The motors have no power.");
    }
    return known_position(status);
}

Permission can_play_points(const FrameState& now) {
    const Permission able = can_play_arm(now);
    return able.allowed && now.project.arm.points.empty()
               ? Permission::refused("No point has been taught yet.")
               : able;
}

Permission sound_program(const FrameState& now) {
    if (now.project.arm.program.find_first_not_of(" \t\r\n") == std::string::npos) {
        return Permission::refused("There is no program yet: write one under Program.");
    }
    return now.arm.program().can_be_read() ? Permission{}
                                           : Permission::refused("The program has errors: see its lines.");
}

Permission can_simulate(const FrameState& now) {
    if (const Permission there = in_workspace(now); !there.allowed) {
        return there;
    }
    return now.arm.program().busy() ? Permission::refused("The simulation is running.") : sound_program(now);
}

Permission can_run_arm_program(const FrameState& now) {
    if (!now.arm_connected()) {
        return Permission::refused("No PMAC is connected: simulate the program instead.");
    }
    const Permission able = can_play_arm(now);
    return able.allowed ? sound_program(now) : able;
}

Permission takes_lines(const FrameState& now) {
    if (!now.arm_connected()) {
        return Permission::refused("No PMAC is connected.");
    }
    const DriverState state = now.connection.status.state;
    return state == DriverState::idle || state == DriverState::stopped
               ? Permission{}
               : Permission::refused(state == DriverState::alarm ? "An alarm is active."
                                                                 : "The arm is moving.");
}

Permission can_load_settings(const FrameState& now) {
    const Permission able = takes_lines(now);
    return able.allowed && now.connection.status.powered
               ? Permission::refused(
                     "The motors have power, and a wrong setting would move them at once: use Kill first.")
               : able;
}

Permission can_send_arm_program(const FrameState& now) {
    const Permission able = takes_lines(now);
    return able.allowed ? sound_program(now) : able;
}

Permission can_send_path(const FrameState& now) {
    const Permission able = can_play_arm(now);
    if (!able.allowed) {
        return able;
    }
    if (now.arm.works_out_path_motion()) {
        return Permission::refused("The motion is being computed.");
    }
    const auto path = now.arm.path();
    if (!path || !path->track) {
        return Permission::refused("No path is shown on the arm: show one first.");
    }
    return path->reach.holes.empty()
               ? Permission{}
               : Permission::refused("The arm cannot reach the whole path: " + path->reach.holes.front().why +
                                     ".");
}

Permission sound_motion_file(const FrameState& now) {
    if (const Permission there = in_workspace(now); !there.allowed) {
        return there;
    }
    if (!now.arm.motion_file().faults().empty()) {
        return Permission::refused("The motion file has an error: see its line.");
    }
    return now.arm.motion_file().has_blocks()
               ? Permission{}
               : Permission::refused("There is no motion file yet: write one under Motion file.");
}

Permission can_simulate_motion(const FrameState& now) {
    return now.arm_connected()
               ? Permission::refused("The view follows the connected controller: play the file instead.")
               : sound_motion_file(now);
}

Permission can_play_motion(const FrameState& now) {
    const Permission able = can_play_arm(now);
    return able.allowed ? sound_motion_file(now) : able;
}

void record(ActionContext& context) {
    ArmWorkspace& arm = context.app.arm();
    const int place = static_cast<int>(context.now.project.arm.points.size());
    context.app.edit("Teach a point",
                     [&](project::Project& draft) {
                         draft.arm.points.push_back(arm.taught(project::free_point_name(draft.arm.points)));
                     },
                     {});
    arm.set_new_point(place);
}

std::vector<double> degrees_of(const arm::JointPositions& joints) {
    std::vector<double> degrees;
    for (const double joint : joints) {
        degrees.push_back(to_degrees(joint));
    }
    return degrees;
}

void simulate(ActionContext& context) {
    ArmWorkspace& arm = context.app.arm();
    const pmac::PmacSettings card = context.now.arm_connected()
                                        ? pmac::arm_settings_of(context.now.connection.choice.axes)
                                        : pmac::five_axis_arm_settings();
    arm.program().follow(context.now.project.arm.program);
    arm.program().simulate(pmac::within_limits(card, arm.arm()), degrees_of(arm.joints()));
}

/// It is refused where a joint would leave its limits, as far as an emulated card tells in a short time.
void run(ActionContext& context) {
    constexpr double longest = 300.0; // s of the card's time; beyond it the driver watches alone
    const ArmWorkspace& arm = context.app.arm();
    pmac::MotionSimulationSettings settings;
    settings.card = pmac::within_limits(pmac::arm_settings_of(context.now.connection.choice.axes), arm.arm());
    settings.start_deg = degrees_of(arm.joints());
    settings.longest = longest;
    const auto found =
        pmac::simulate_motion_program(context.now.project.arm.program, "program", settings, {});
    if (found.beyond_limits) {
        throw Error(*found.beyond_limits);
    }
    const bool known = found.faults.empty();
    context.app.run_on_card(arm.program().lines(), known ? found.duration : 0.0, {});
    if (known) {
        context.app.arm().card_run().know_way(
            play_of(std::make_shared<const pmac::MotionSimulation>(found)).at);
    }
}

/// Into the card's buffer without running it.
void send(ActionContext& context) {
    std::string text = "CLOSE\nOPEN PROG 1\nCLEAR\n";
    for (const std::string& line : context.app.arm().program().lines()) {
        text += line + "\n";
    }
    text += "CLOSE";
    context.app.connection().tell([&](drivers::Driver& driver) { (void)driver.command(text); });
}

template <FilePrompt prompt> void ask_for_arm_file(ActionContext& context) {
    context.view_state.file_prompt = prompt;
}

void add_arm_points(Actions& actions) {
    constexpr std::string_view menu = "Arm";
    add(actions,
        {"arm.teach", menu, "Teach this point", "Stores the present pose of the arm.", "Ctrl+T", icons::add},
        can_teach,
        record);
    add(actions,
        {"arm.play_points",
         menu,
         "Play the points",
         "Moves the simulated arm, or the connected one, through all taught points.",
         "",
         icons::play},
        can_play_points,
        [](ActionContext& context) {
            context.app.play_on_arm(context.app.arm().taught_motion(context.now.project.arm.points));
        });
    add(actions,
        {"arm.open_points", menu, "Open points", "Replaces the present points.", "", icons::folder},
        in_workspace,
        ask_for_arm_file<FilePrompt::open_points>);
    add(actions,
        {"arm.save_points", menu, "Save points", "Saves it to a separate file.", "", icons::save},
        in_workspace,
        ask_for_arm_file<FilePrompt::save_points>);
}

void add_arm_programs(Actions& actions) {
    constexpr std::string_view menu = "Arm";
    add(actions,
        {"arm.simulate",
         menu,
         "Simulate the program",
         "Runs the present text on an emulated card and moves the simulated arm, unless a real one is "
         "connected.",
         "",
         icons::play},
        can_simulate,
        simulate);
    add(actions,
        {"arm.send_program",
         menu,
         "Send the program",
         "Loads the program into PROG 1 of the card; nothing moves.",
         "",
         icons::plug},
        can_send_arm_program,
        send);
    add(actions,
        {"arm.run_program",
         menu,
         "Run the program",
         "Sends the program to the card and runs it.",
         "",
         icons::play},
        can_run_arm_program,
        run);
    add(actions,
        {"arm.open_program", menu, "Open a program", "Replaces the present text.", "", icons::folder},
        in_workspace,
        ask_for_arm_file<FilePrompt::open_motion_program>);
    add(actions,
        {"arm.save_program", menu, "Save the program", "As a file of its own.", "", icons::save},
        in_workspace,
        ask_for_arm_file<FilePrompt::save_motion_program>);
}

void add_motion_files(Actions& actions) {
    constexpr std::string_view menu = "Arm";
    add(actions,
        {"arm.play_file",
         menu,
         "Play a motion file",
         "Runs lines and arcs of the tool from its present position, with the simulated arm or the connected "
         "one.",
         "",
         icons::file},
        can_play_arm,
        ask_for_arm_file<FilePrompt::play_motion_file>);
    add(actions,
        {"arm.simulate_motion",
         menu,
         "Simulate the motion file",
         "Runs the present text with the simulated arm, starting at the home of the thesis.",
         "",
         icons::play},
        can_simulate_motion,
        [](ActionContext& context) { context.app.simulate_motion_file(); });
    add(actions,
        {"arm.stream_motion",
         menu,
         "Stream the motion file to an emulated card",
         "Streams it point by point through the dual-ported RAM, with the flags and the interrupt of the "
         "thesis.",
         "",
         icons::play},
        can_simulate_motion,
        [](ActionContext& context) { context.app.stream_motion_file(); });
    add(actions,
        {"arm.play_motion",
         menu,
         "Play the edited motion file",
         "Starts at the present position of the simulated arm or the connected one.",
         "",
         icons::play},
        can_play_motion,
        [](ActionContext& context) { context.app.play_motion_text(); });
    add(actions,
        {"arm.save_result",
         menu,
         "Save the result of the motion file",
         "Writes points and joints from the home of the thesis, in the layout of the thesis.",
         "",
         icons::save},
        sound_motion_file,
        ask_for_arm_file<FilePrompt::save_motion_result>);
    add(actions,
        {"arm.open_motion", menu, "Open a motion file", "Replaces the present text.", "", icons::folder},
        in_workspace,
        ask_for_arm_file<FilePrompt::open_motion_file>);
    add(actions,
        {"arm.save_motion", menu, "Save the motion file", "As a file of its own.", "", icons::save},
        in_workspace,
        ask_for_arm_file<FilePrompt::save_motion_file>);
}

void add_arm_sending(Actions& actions) {
    constexpr std::string_view menu = "Arm";
    add(actions,
        {"arm.card_settings",
         menu,
         "Load card settings",
         "Sends a file such as assets/samples/pmac-arm.ini; reports protections that it disables.",
         "",
         icons::settings},
        can_load_settings,
        ask_for_arm_file<FilePrompt::load_card_settings>);
    add(actions,
        {"arm.send_path",
         menu,
         "Run the path",
         "Runs the project's program at the position of its part, with the simulated arm or the connected "
         "one. The arm moves to the start by a joint move, at a quarter of its speed.",
         "",
         icons::toolpath},
        can_send_path,
        [](ActionContext& context) { context.app.arm().want_path_motion(context.now.arm_connected()); });
}

} // namespace

void add_arm_teach_actions(Actions& actions) {
    add_arm_points(actions);
    add_arm_programs(actions);
    add_motion_files(actions);
    add_arm_sending(actions);
}

} // namespace millwright::actions
