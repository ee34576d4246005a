#include "app/commands/arm_command.h"

#include "app/arm_choice.h"
#include "app/commands/arm_bodies.h"
#include "app/commands/arm_drives.h"
#include "app/commands/arm_motor.h"
#include "app/commands/arm_pose.h"
#include "app/commands/arm_reach.h"
#include "app/commands/arm_service.h"
#include "app/commands/arm_stream.h"
#include "core/base/counted.h"
#include "core/base/files.h"
#include "core/kinematics/arm_motion_file.h"
#include "core/kinematics/arm_motion_ways.h"
#include "core/kinematics/arm_path.h"
#include "core/kinematics/arm_simulation.h"
#include "core/motion/arm_motion.h"
#include "core/motion/planner.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

using kinematics::ArmModel;

struct ArmSimulationOptions {
    std::string arm = "motoman-l3";
    std::string file;
    std::string out;
    double step_mm = 5.0;
};

/// What the arm takes, s. Throws Error where it cannot go on without another branch.
double planned_motion_time(const ArmModel& arm,
                           const std::vector<kinematics::ArmWay>& ways,
                           const std::string& file) {
    kinematics::ArmPathSettings settings;
    settings.aim.demand = kinematics::ArmDemand::tip; // the tool axis comes into the plane of the arm
    const auto path = kinematics::follow_path(arm, ways, kinematics::arm_home(), settings, {});
    motion::ArmMotion motion(arm, kinematics::arm_home());
    motion.follow(ways, path, file);
    return motion::plan(motion.program(), arm, {}, {}).duration();
}

int simulate(const ArmSimulationOptions& options) {
    const ArmModel arm = arm_of(options.arm);
    const auto blocks = kinematics::parse_arm_motion(read_file(options.file), options.file);
    const auto records =
        kinematics::simulate_arm(arm, blocks, kinematics::arm_home(), options.step_mm, options.file);
    const double seconds = planned_motion_time(
        arm, kinematics::ways_of(arm, blocks, kinematics::arm_home(), options.file), options.file);
    write_file(options.out, kinematics::arm_result_text(records));
    fmt::print("{}, {} in {}\nplanned for the arm: {:.2f} s\n",
               counted(blocks.size(), "block"),
               counted(records.size(), "point"),
               options.out,
               seconds);
    return 0;
}

} // namespace

void add_arm_command(CLI::App& app, Command& chosen) {
    CLI::App& group = *app.add_subcommand("arm", "Robot arms: where joints bring the tool, and which do");
    group.require_subcommand(1);
    add_arm_pose_commands(group, chosen);
    add_arm_drives_command(group, chosen);
    const auto options = std::make_shared<ArmSimulationOptions>();
    CLI::App& path = *group.add_subcommand("simulate", "Work off a motion file, from the home of the thesis");
    add_arm_option(path, options->arm);
    path.add_option("FILE", options->file, "Motion file: blocks of words that end with ;")->required();
    path.add_option("--step", options->step_mm, "Distance of the points, mm")
        ->check(CLI::Range(0.001, 1000.0))
        ->capture_default_str();
    path.add_option("--out", options->out, "File for the positions and joints")->required();
    path.callback([&chosen, options] { chosen = [options] { return simulate(*options); }; });
    add_arm_bodies_command(group, chosen);
    add_arm_reach_command(group, chosen);
    add_arm_service_commands(group, chosen);
    add_arm_motor_commands(group, chosen);
    add_arm_stream_command(group, chosen);
}

} // namespace millwright::app
