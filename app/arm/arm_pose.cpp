#include "app/arm/arm_command.h"
#include "app/command_line/arm_choice.h"
#include "app/command_line/option_values.h"
#include "core/arm/arm_forward.h"
#include "core/arm/arm_inverse.h"
#include "core/arm/arm_solver.h"
#include "core/arm/arm_zone.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/kinematics/tool_rotation.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

using arm::ArmModel;
using arm::JointPositions;

constexpr int starting_points = 200; ///< for arms without a closed form

/// A tool axis so little out of the plane of an arm with five joints was meant to be in it.
constexpr double rounding_deg = 0.01;

constexpr int no_solution = 1; ///< exit code where no joints bring the tool to its goal

struct ArmPoseOptions {
    std::string arm = "motoman-l3";
    std::vector<double> numbers;
    std::optional<double> roll_deg{}; ///< nothing: any
    std::vector<double> rotation;     ///< row by row; empty: none is asked for
    bool project = false;
    bool json = false;
};

nlohmann::ordered_json rows_of(const Mat3& rotation) {
    auto rows = nlohmann::ordered_json::array();
    for (int n = 0; n < 3; ++n) {
        rows.push_back({rounded(rotation(n, 0)), rounded(rotation(n, 1)), rounded(rotation(n, 2))});
    }
    return rows;
}

void print_rotation(const Mat3& rotation) {
    for (int n = 0; n < 3; ++n) {
        fmt::print("{} {:>12.9f} {:>12.9f} {:>12.9f}\n",
                   n == 0 ? "rotation" : "        ",
                   rounded(rotation(n, 0)),
                   rounded(rotation(n, 1)),
                   rounded(rotation(n, 2)));
    }
}

int forward(const ArmPoseOptions& options) {
    const arm::ArmFile file = arm_file_of(options.arm);
    const ArmModel& arm = file.arm;
    const JointPositions q = given_joints(arm, options.numbers);
    const Frame tool = arm::base_T_tool(arm, q);
    const Vec3 tip = tool.translation(), axis = tool.linear().col(2);
    const double roll = to_degrees(kinematics::roll_of(tool.linear()));
    const double measure = arm::manipulability(arm::arm_jacobian(arm, q), arm::stretched_length(arm));
    const std::vector<std::string> reasons = arm::broken_limits(arm, file.actuators, q);
    if (options.json) {
        nlohmann::ordered_json answer;
        answer["x"] = rounded(tip.x());
        answer["y"] = rounded(tip.y());
        answer["z"] = rounded(tip.z());
        answer["tool"] = {rounded(axis.x()), rounded(axis.y()), rounded(axis.z())};
        answer["roll"] = rounded(roll);
        answer["rotation"] = rows_of(tool.linear());
        answer["manipulability"] = measure;
        answer["inside_limits"] = reasons.empty();
        answer["reasons"] = reasons;
        fmt::print("{}\n", answer.dump(2));
    } else {
        fmt::print("x {} y {} z {} mm\ntool axis {} {} {}\nroll {} deg\n",
                   shortest(rounded(tip.x())),
                   shortest(rounded(tip.y())),
                   shortest(rounded(tip.z())),
                   shortest(rounded(axis.x())),
                   shortest(rounded(axis.y())),
                   shortest(rounded(axis.z())),
                   shortest(rounded(roll)));
        print_rotation(tool.linear());
        fmt::print("manipulability {:.6f}\n", measure);
    }
    for (const std::string& reason : reasons) {
        fmt::print(stderr, "millwright: {}\n", reason);
    }
    return 0;
}

/// Where the tool shall be. With neither roll nor rotation any roll will do.
struct ToolGoal {
    arm::PointedGoal pointed;
    std::optional<double> roll;   ///< about the axis, rad
    std::optional<Mat3> rotation; ///< all directions; the axis is its z
};

struct Solutions {
    std::vector<JointPositions> joints;
    std::string reason;
    double projected_deg = 0.0;   ///< by how much the goal was turned
    std::optional<Mat3> rotation; ///< of the tool, where it is asked for
};

/// Without those that leave the arm's zone; the reason of the last if none is left.
void keep_zone(const ArmModel& arm, Solutions& found) {
    std::string why;
    std::erase_if(found.joints, [&](const JointPositions& q) {
        const auto breaches = arm::zone_breaches(arm, q);
        why = breaches.empty() ? why : breaches.front().why;
        return !breaches.empty();
    });
    found.reason = found.joints.empty() && !why.empty() ? why : found.reason;
}

void search(const ArmModel& arm, const Frame& goal, bool any_roll, Solutions& found) {
    const auto demand = any_roll ? arm::ArmDemand::tip_and_axis : arm::ArmDemand::frame;
    found.joints = arm::solve_arm_from_many_starts(arm, goal, demand, resting(arm), starting_points);
    if (found.joints.empty()) {
        found.reason = fmt::format("none found from {} starting points", starting_points);
    }
}

/// An arm of five joints holds its tool in its own plane only.
void solve_in_plane(
    const ArmModel& arm, const ToolGoal& goal, Frame frame, bool any_roll, bool project, Solutions& found) {
    const auto projected = arm::projected_goal(frame);
    const double out =
        projected ? to_degrees(angle_between(projected->linear().col(2), goal.pointed.axis)) : 90.0;
    if (projected && (project || out < rounding_deg)) {
        frame.linear() =
            goal.rotation ? Mat3(projected->linear())
                          : kinematics::frame_with_roll(projected->linear().col(2), goal.roll.value_or(0.0));
        found.projected_deg = out;
    }
    const arm::PointedGoal pointed{frame.translation(), frame.linear().col(2)};
    auto answer =
        any_roll ? arm::arm_inverse(arm, pointed, resting(arm)) : arm::arm_inverse(arm, frame, resting(arm));
    found.joints = std::move(answer.branches);
    found.reason = std::move(answer.why);
    if (!any_roll) {
        found.rotation = frame.linear();
    }
}

Solutions solved(const ArmModel& arm, const ToolGoal& goal, bool project) {
    Frame frame = Frame::Identity();
    frame.translation() = goal.pointed.tip;
    frame.linear() = goal.rotation ? *goal.rotation
                                   : kinematics::frame_with_roll(goal.pointed.axis, goal.roll.value_or(0.0));
    const bool any_roll = !goal.roll && !goal.rotation;
    Solutions found;
    if (arm.planar_elbow()) {
        solve_in_plane(arm, goal, frame, any_roll, project, found);
    } else {
        search(arm, frame, any_roll, found);
        if (!any_roll) {
            found.rotation = frame.linear();
        }
    }
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
        const double measure = arm::manipulability(arm::arm_jacobian(arm, q), arm::stretched_length(arm));
        found.push_back(measure < singular);
    }
    return found;
}

/// Throws UsageError where tip, axis, rotation and roll do not go together, Error for bad numbers.
ToolGoal goal_of(const ArmPoseOptions& options) {
    const auto& v = options.numbers;
    const bool by_rotation = !options.rotation.empty();
    const std::size_t wanted = by_rotation ? 3 : 6;
    if (v.size() != wanted) {
        throw UsageError(fmt::format("the goal needs {} numbers, but {} were given", wanted, v.size()),
                         {},
                         by_rotation ? "with --frame: X Y Z"
                                     : "X Y Z AX AY AZ, or X Y Z with --frame R11,R12,...,R33");
    }
    if (by_rotation && options.roll_deg) {
        throw UsageError("--frame already sets the roll: leave out --roll");
    }
    ToolGoal goal;
    goal.pointed.tip = Vec3(v[0], v[1], v[2]);
    goal.pointed.axis = by_rotation ? Vec3(Vec3::UnitZ()) : Vec3(v[3], v[4], v[5]);
    if (!is_finite(goal.pointed.tip) || !is_finite(goal.pointed.axis)) {
        throw Error("the goal contains a number that is not finite");
    }
    constexpr double farthest_mm = 1e6;
    if (!(goal.pointed.tip.cwiseAbs().maxCoeff() <= farthest_mm)) {
        throw Error(fmt::format("the goal is farther away than {:g} mm", farthest_mm));
    }
    if (!(goal.pointed.axis.norm() > 1e-9)) {
        throw Error("the tool axis has no direction", {}, "give at least one number other than 0");
    }
    if (options.roll_deg && !std::isfinite(*options.roll_deg)) {
        throw Error("the roll is not a finite number");
    }
    if (by_rotation) {
        goal.rotation = kinematics::rotation_of_rows(options.rotation);
    }
    goal.pointed.axis =
        goal.rotation ? Vec3(goal.rotation->col(2)) : Vec3(goal.pointed.axis.stableNormalized());
    goal.roll = options.roll_deg ? std::optional(from_degrees(*options.roll_deg)) : std::nullopt;
    return goal;
}

/// A table, and by how much the goal was turned.
void print_solutions(const ToolGoal& goal, const Solutions& found, const nlohmann::ordered_json& list) {
    if (found.projected_deg >= rounding_deg) {
        fmt::print("The {} was turned by {:.4f} deg into the plane of the arm.\n",
                   goal.rotation ? "frame" : "tool axis",
                   found.projected_deg);
        if (goal.rotation) {
            print_rotation(*found.rotation);
        }
    }
    for (const auto& solution : list) {
        std::string line;
        for (const auto& value : solution) {
            line += fmt::format("{:>14.6f}", value.get<double>());
        }
        fmt::print("{}\n", line);
    }
}

int inverse(const ArmPoseOptions& options) {
    const ArmModel arm = arm_of(options.arm);
    const ToolGoal goal = goal_of(options);
    const Solutions found = solved(arm, goal, options.project);
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
        answer["projected_deg"] = rounded(found.projected_deg);
        if (found.rotation) {
            answer["rotation"] = rows_of(*found.rotation);
        }
        if (list.empty()) {
            answer["reason"] = found.reason;
        }
        fmt::print("{}\n", answer.dump(2));
    } else {
        print_solutions(goal, found, list);
    }
    if (list.empty()) {
        fmt::print(stderr, "millwright: no solution: {}\n", found.reason);
        return no_solution;
    }
    return 0;
}

CLI::App& add_pose_command(CLI::App& group,
                           const char* name,
                           const char* text,
                           const std::shared_ptr<ArmPoseOptions>& options) {
    CLI::App& command = *group.add_subcommand(name, text);
    add_arm_option(command, options->arm);
    command.add_flag("--json", options->json, "Print the result as JSON");
    return command;
}

} // namespace

void add_arm_pose_commands(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<ArmPoseOptions>();
    CLI::App& fk = add_pose_command(group, "fk", "Tool pose for given joints", options);
    fk.add_option("JOINTS", options->numbers, "Joint positions, degrees (sliding joints: mm)")
        ->required()
        ->expected(1, 9)
        ->type_name("J1 J2 ...");
    fk.callback([&chosen, options] { chosen = [options] { return forward(*options); }; });
    CLI::App& ik = add_pose_command(group, "ik", "All joint positions for a given tool pose", options);
    ik.add_option(
          "GOAL", options->numbers, "Tool tip, mm, and direction of the tool axis; with --frame only the tip")
        ->required()
        ->expected(3, 6)
        ->type_name("X Y Z AX AY AZ");
    ik.add_option("--frame",
                  options->rotation,
                  "Rotation matrix of the tool, row by row: its columns are the tool's x, y and z axes in "
                  "the base frame")
        ->delimiter(',')
        ->expected(9)
        ->allow_extra_args(false)
        ->type_name("R11,R12,...,R33");
    ik.add_flag("--project",
                options->project,
                "For an arm with five joints: turn the goal by the smallest angle into the plane of the arm");
    ik.add_option("--roll", options->roll_deg, "Roll of the tool about its axis, degrees (default: any)")
        ->type_name("DEG");
    ik.callback([&chosen, options] { chosen = [options] { return inverse(*options); }; });
}

} // namespace millwright::app
