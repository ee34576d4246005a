#include "app/arm/arm_command.h"

#include "app/command_line/arm_choice.h"
#include "core/arm/arm_motion_file.h"
#include "core/arm/arm_simulation.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "ui/workspaces/motion_file_draft.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

using arm::ArmModel;

struct ArmSimulationOptions {
    std::string arm = "motoman-l3";
    std::string file;
    std::string out;
    double step_mm = 5.0;
    std::vector<double> start; ///< degrees or mm; empty: the arm's home
};

arm::JointPositions start_of(const ArmModel& arm, const ArmSimulationOptions& options) {
    if (options.start.empty()) {
        return arm.home();
    }
    arm::JointPositions start = given_joints(arm, options.start);
    if (const int outside = arm.joint_outside(start); outside >= 0) {
        throw Error(fmt::format("--start is outside the limits of joint {}", arm.joint(outside).name));
    }
    return start;
}

/// A ; at the end of a line. In G-code it begins a comment.
bool has_block_end(const std::string& text) {
    for (std::size_t at = text.find(';'); at != std::string::npos; at = text.find(';', at + 1)) {
        const std::size_t next = text.find_first_not_of(" \t\r", at + 1);
        if (next == std::string::npos || text[next] == '\n') {
            return true;
        }
    }
    return false;
}

int simulate(const ArmSimulationOptions& options) {
    const ArmModel arm = arm_of(options.arm);
    const arm::JointPositions start = start_of(arm, options);
    const std::string text = read_file(options.file);
    if (!has_block_end(text)) {
        throw Error("this is not a motion file: none of its blocks ends with ;",
                    options.file,
                    "'millwright arm reach' takes G-code");
    }
    const auto blocks = arm::parse_arm_motion(text, options.file);
    const auto records = arm::simulate_arm(arm, blocks, start, options.step_mm, options.file);
    const double seconds = actions::motion_of_file(arm, text, start, options.file).trajectory.duration();
    write_file(options.out, arm::arm_result_text(arm, records));
    double most_tilt = 0.0;
    for (const arm::ArmRecord& record : records) {
        most_tilt = std::max(most_tilt, record.tilt);
    }
    fmt::print("{}, {} in {}\nplanned for the arm: {:.2f} s\ntool axis turned by at most {:.3f} deg\n",
               counted(blocks.size(), "block"),
               counted(records.size(), "point"),
               options.out,
               seconds,
               to_degrees(most_tilt));
    return 0;
}

} // namespace

void add_arm_command(CLI::App& app, Command& chosen) {
    CLI::App& group = *app.add_subcommand("arm", "Robot arms: kinematics, reach, motors and service data");
    group.require_subcommand(1);
    add_arm_pose_commands(group, chosen);
    add_arm_drives_command(group, chosen);
    const auto options = std::make_shared<ArmSimulationOptions>();
    CLI::App& path = *group.add_subcommand(
        "simulate", "Joint positions along a motion file, for any arm, starting at its home");
    add_arm_option(path, options->arm);
    path.add_option("FILE", options->file, "Motion file: blocks of words, each ending with ;")->required();
    path.add_option("--step", options->step_mm, "Point spacing, mm")
        ->check(CLI::Range(0.001, 1000.0))
        ->capture_default_str();
    path.add_option("--start",
                    options->start,
                    "Start position of the joints, degrees or mm (default: the arm's home)")
        ->delimiter(',')
        ->expected(1, static_cast<int>(arm::most_arm_joints))
        ->allow_extra_args(false)
        ->type_name("J1,J2,...");
    path.add_option("--out", options->out, "Output file for positions and joints")->required();
    path.callback([&chosen, options] { chosen = [options] { return simulate(*options); }; });
    add_arm_bodies_command(group, chosen);
    add_arm_reach_command(group, chosen);
    add_arm_service_commands(group, chosen);
    add_arm_motor_commands(group, chosen);
    add_arm_stream_command(group, chosen);
}

} // namespace millwright::app
