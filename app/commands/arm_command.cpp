#include "app/commands/arm_command.h"

#include "app/arm_choice.h"
#include "app/commands/arm_bodies.h"
#include "app/commands/arm_motor.h"
#include "app/commands/arm_reach.h"
#include "app/commands/arm_service.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/kinematics/arm_forward.h"
#include "core/kinematics/arm_inverse.h"
#include "core/kinematics/arm_motion_file.h"
#include "core/kinematics/arm_motion_ways.h"
#include "core/kinematics/arm_path.h"
#include "core/kinematics/arm_simulation.h"
#include "core/kinematics/arm_solver.h"
#include "core/kinematics/arm_zone.h"
#include "core/kinematics/tool_roll.h"
#include "core/motion/arm_motion.h"
#include "core/motion/planner.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

using kinematics::ArmModel;
using kinematics::JointPositions;

constexpr int starting_points = 200; ///< for arms without a closed form

/// A tool axis so little out of the plane of an arm with five joints was meant to be in it.
constexpr double rounding_deg = 0.01;

struct ArmOptions {
    std::string arm = "motoman-l3";
    std::vector<double> numbers;
    std::string file;
    std::string out;
    double step_mm = 5.0;
    std::optional<double> roll_deg{}; ///< nothing: any
    bool project = false;
    bool json = false;
};

int forward(const ArmOptions& options) {
    const ArmModel arm = arm_of(options.arm);
    if (static_cast<int>(options.numbers.size()) != arm.joint_count()) {
        throw Error(fmt::format("{} has {} joints, {} positions were given",
                                arm.name(),
                                arm.joint_count(),
                                options.numbers.size()));
    }
    JointPositions q(arm.joint_count());
    for (int n = 0; n < arm.joint_count(); ++n) {
        q[n] = to_joint(arm, n, options.numbers[static_cast<std::size_t>(n)]);
        if (!std::isfinite(q[n])) {
            throw Error(fmt::format("joint {}: the position is not a finite number", arm.joint(n).name));
        }
    }
    const Frame tool = kinematics::base_T_tool(arm, q);
    const Vec3 tip = tool.translation(), axis = tool.linear().col(2);
    const double roll = to_degrees(kinematics::roll_of(tool.linear()));
    const double measure =
        kinematics::manipulability(kinematics::arm_jacobian(arm, q), kinematics::stretched_length(arm));
    const int outside = arm.joint_outside(q);
    const auto breaches = kinematics::zone_breaches(arm, q);
    if (options.json) {
        nlohmann::ordered_json answer;
        answer["x"] = rounded(tip.x());
        answer["y"] = rounded(tip.y());
        answer["z"] = rounded(tip.z());
        answer["tool"] = {rounded(axis.x()), rounded(axis.y()), rounded(axis.z())};
        answer["roll"] = rounded(roll);
        answer["manipulability"] = measure;
        answer["inside_limits"] = outside < 0 && breaches.empty();
        fmt::print("{}\n", answer.dump(2));
    } else {
        fmt::print("x {} y {} z {} mm\ntool axis {} {} {}\nroll {} deg\nmanipulability {:.6f}\n",
                   shortest(rounded(tip.x())),
                   shortest(rounded(tip.y())),
                   shortest(rounded(tip.z())),
                   shortest(rounded(axis.x())),
                   shortest(rounded(axis.y())),
                   shortest(rounded(axis.z())),
                   shortest(rounded(roll)),
                   measure);
    }
    if (outside >= 0) {
        fmt::print(stderr, "millwright: joint {} is outside of its limits\n", arm.joint(outside).name);
    }
    for (const kinematics::ZoneBreach& breach : breaches) {
        fmt::print(stderr, "millwright: {}\n", breach.why);
    }
    return 0;
}

struct Solutions {
    std::vector<JointPositions> joints;
    std::string reason;
    double projected_deg = 0.0; ///< by how much the tool axis was turned
};

/// Without those that leave the arm's zone; the reason of the last if none is left.
void keep_zone(const ArmModel& arm, Solutions& found) {
    std::string why;
    std::erase_if(found.joints, [&](const JointPositions& q) {
        const auto breaches = kinematics::zone_breaches(arm, q);
        why = breaches.empty() ? why : breaches.front().why;
        return !breaches.empty();
    });
    found.reason = found.joints.empty() && !why.empty() ? why : found.reason;
}

Solutions sought(const ArmModel& arm, const Frame& goal, kinematics::ArmDemand demand) {
    Solutions found;
    found.joints = kinematics::solve_arm_from_many_starts(arm, goal, demand, resting(arm), starting_points);
    if (found.joints.empty()) {
        found.reason = fmt::format("none was found from {} starting points", starting_points);
    }
    keep_zone(arm, found);
    return found;
}

/// Any roll will do unless one is asked for.
Solutions
solved(const ArmModel& arm, kinematics::PointedGoal goal, const std::optional<double>& roll, bool project) {
    Frame frame = Frame::Identity();
    frame.translation() = goal.tip;
    frame.linear() = kinematics::frame_with_roll(goal.axis, roll.value_or(0.0));
    if (!arm.planar_elbow()) {
        using kinematics::ArmDemand;
        return sought(arm, frame, roll ? ArmDemand::frame : ArmDemand::tip_and_axis);
    }
    Solutions found;
    const auto projected = kinematics::projected_goal(frame);
    const double out = projected ? to_degrees(angle_between(projected->linear().col(2), goal.axis)) : 90.0;
    if (projected && (project || out < rounding_deg)) {
        goal.axis = projected->linear().col(2);
        found.projected_deg = out;
    }
    frame.linear() = kinematics::frame_with_roll(goal.axis, roll.value_or(0.0));
    auto answer = roll ? kinematics::arm_inverse(arm, frame, resting(arm))
                       : kinematics::arm_inverse(arm, goal, resting(arm));
    found.joints = std::move(answer.branches);
    found.reason = std::move(answer.why);
    keep_zone(arm, found);
    return found;
}

nlohmann::ordered_json shown(const ArmModel& arm, const std::vector<JointPositions>& solutions) {
    auto list = nlohmann::ordered_json::array();
    for (const JointPositions& q : solutions) {
        auto joints = nlohmann::ordered_json::array();
        for (int n = 0; n < arm.joint_count(); ++n) {
            joints.push_back(rounded(from_joint(arm, n, q[n])));
        }
        list.push_back(std::move(joints));
    }
    return list;
}

/// For each of the solutions whether the arm cannot move its tip in every direction there.
std::vector<bool> singular_ones(const ArmModel& arm, const std::vector<JointPositions>& solutions) {
    constexpr double singular = 1e-6;
    std::vector<bool> found;
    for (const JointPositions& q : solutions) {
        const double measure =
            kinematics::manipulability(kinematics::arm_jacobian(arm, q), kinematics::stretched_length(arm));
        found.push_back(measure < singular);
    }
    return found;
}

int inverse(const ArmOptions& options) {
    const ArmModel arm = arm_of(options.arm);
    const auto& v = options.numbers;
    const Vec3 tip(v[0], v[1], v[2]), axis(v[3], v[4], v[5]);
    if (!is_finite(tip) || !is_finite(axis)) {
        throw Error("the goal is not finite");
    }
    constexpr double farthest_mm = 1e6;
    if (!(tip.cwiseAbs().maxCoeff() <= farthest_mm)) {
        throw Error(fmt::format("the goal is farther than {:g} mm", farthest_mm));
    }
    if (!(axis.norm() > 1e-9)) {
        throw Error("the tool axis has no direction", {}, "its three numbers are 0");
    }
    if (options.roll_deg && !std::isfinite(*options.roll_deg)) {
        throw Error("the roll is not a finite number");
    }
    const auto roll = options.roll_deg ? std::optional(from_degrees(*options.roll_deg)) : std::nullopt;
    const Solutions found = solved(arm, {tip, axis.stableNormalized()}, roll, options.project);
    const auto list = shown(arm, found.joints);
    const auto singular = singular_ones(arm, found.joints);
    for (std::size_t n = 0; n < singular.size(); ++n) {
        if (singular[n]) {
            fmt::print(stderr, "millwright: the arm is singular at solution {}\n", n + 1);
        }
    }
    if (options.json) {
        nlohmann::ordered_json answer;
        answer["solutions"] = list;
        answer["singular"] = singular;
        answer["projected_degrees"] = rounded(found.projected_deg);
        if (list.empty()) {
            answer["reason"] = found.reason;
        }
        fmt::print("{}\n", answer.dump(2));
        return 0;
    }
    if (found.projected_deg >= rounding_deg) {
        fmt::print("The tool axis was turned by {:.4f} deg into the plane of the arm.\n",
                   found.projected_deg);
    }
    for (const auto& solution : list) {
        std::string line;
        for (const auto& value : solution) {
            line += fmt::format("{:>14.6f}", value.get<double>());
        }
        fmt::print("{}\n", line);
    }
    if (list.empty()) {
        fmt::print("No solution: {}.\n", found.reason);
    }
    return 0;
}

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

int simulate(const ArmOptions& options) {
    const ArmModel arm = arm_of(options.arm);
    const auto blocks = kinematics::parse_arm_motion(read_file(options.file), options.file);
    const auto records =
        kinematics::simulate_arm(arm, blocks, kinematics::arm_home(), options.step_mm, options.file);
    const double seconds = planned_motion_time(
        arm, kinematics::ways_of(arm, blocks, kinematics::arm_home(), options.file), options.file);
    write_file(options.out, kinematics::arm_result_text(records));
    fmt::print("{} blocks, {} points in {}\nplanned for the arm: {:.2f} s\n",
               blocks.size(),
               records.size(),
               options.out,
               seconds);
    return 0;
}

CLI::App& add_arm_subcommand(CLI::App& group,
                             const char* name,
                             const char* text,
                             const std::shared_ptr<ArmOptions>& options) {
    CLI::App& command = *group.add_subcommand(name, text);
    add_arm_option(command, options->arm);
    return command;
}

} // namespace

void add_arm_command(CLI::App& app, Command& chosen) {
    CLI::App& group = *app.add_subcommand("arm", "Robot arms: where joints bring the tool, and which do");
    group.require_subcommand(1);
    const auto options = std::make_shared<ArmOptions>();
    const auto answers_in_json = [&](CLI::App& command) {
        command.add_flag("--json", options->json, "Print the answer as JSON");
    };
    CLI::App& fk = add_arm_subcommand(group, "fk", "The tool for given joints", options);
    answers_in_json(fk);
    fk.add_option("JOINTS", options->numbers, "Position of every joint: degrees, mm of a sliding one")
        ->required()
        ->expected(1, 9)
        ->type_name("J1 J2 ...");
    fk.callback([&chosen, options] { chosen = [options] { return forward(*options); }; });
    CLI::App& ik = add_arm_subcommand(group, "ik", "Every position of the joints for a given tool", options);
    answers_in_json(ik);
    ik.add_option("GOAL", options->numbers, "Tip in mm and direction of the tool axis")
        ->required()
        ->expected(6)
        ->type_name("X Y Z AX AY AZ");
    ik.add_flag("--project",
                options->project,
                "Turn the axis by the smallest angle into the plane of an arm with five joints");
    ik.add_option(
          "--roll", options->roll_deg, "Roll of the tool about its axis, degrees; without it any will do")
        ->type_name("DEG");
    ik.callback([&chosen, options] { chosen = [options] { return inverse(*options); }; });
    CLI::App& path =
        add_arm_subcommand(group, "simulate", "Work off a motion file, from the home of the thesis", options);
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
}

} // namespace millwright::app
