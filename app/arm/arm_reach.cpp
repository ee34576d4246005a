#include "app/arm/arm_command.h"
#include "app/command_line/arm_choice.h"
#include "app/command_line/command.h"
#include "app/command_line/watched_work.h"
#include "core/arm/arm_path.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/gcode/interpreter.h"
#include "core/gcode_programs/machine_program.h"
#include "core/kinematics/machine_file.h"
#include "core/motion/arm_motion.h"
#include "core/motion/planner.h"
#include "core/program/arm_ways.h"
#include "core/project/arm_input.h"
#include "core/project/assets.h"
#include "core/project/plot_input.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

using arm::ArmHole;
using arm::ArmModel;
using arm::ArmReach;
using arm::ArmReachPoint;
using arm::ArmWay;
using kinematics::MachineModel;

constexpr std::size_t most_holes_shown = 20;

struct ArmReachOptions {
    std::string file;
    std::string arm = "motoman-l3";
    std::string machine;
    std::vector<double> frame{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    double tolerance_mm = 0.01;
    double tilt_deg = 0.01;
    bool json = false;
};

/// X Y Z of the program are those of the part, without end.
MachineModel cartesian() {
    kinematics::MachineDescription description;
    description.name = "X Y Z";
    description.source = "the coordinates of a program";
    for (int n = 0; n < 3; ++n) {
        kinematics::MachineAxis axis;
        axis.letter = static_cast<char>('X' + n);
        axis.direction = Vec3::Unit(n);
        axis.max_velocity = axis.max_acceleration = 1000.0;
        description.head.push_back(axis);
    }
    return MachineModel(std::move(description));
}

MachineModel machine_of(const ArmReachOptions& options) {
    return options.machine.empty()
               ? cartesian()
               : kinematics::read_machine(project::machine_path(
                     options.machine, std::filesystem::current_path(), project::assets_folder()));
}

Frame frame_of(const std::vector<double>& v) {
    for (const double value : v) {
        if (!std::isfinite(value)) {
            throw Error("the frame contains a number that is not finite");
        }
    }
    return project::base_T_path({Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5])});
}

/// A plot's lines are no G-code, and its first one would be reported as wrong.
void refuse_plots(const std::string& file) {
    if (project::is_plot_file(file)) {
        (void)read_file(file); // that it is missing is reported first
        throw Error(
            "a plot is not a program",
            file,
            fmt::format("make a program from it with 'millwright plot toolpath {} --out program.ngc'", file));
    }
}

std::vector<ArmWay> ways_of(const ArmReachOptions& options) {
    const Frame frame = frame_of(options.frame);
    refuse_plots(options.file);
    const auto machine = std::make_shared<const MachineModel>(machine_of(options));
    gcode::MachineProgramBuilder builder(*machine, options.file);
    gcode::ReaderSettings reading;
    reading.any_tool = true;
    gcode::Interpreter reader(std::filesystem::path(options.file), std::move(reading), builder);
    reader.run();
    if (!reader.errors().empty()) {
        throw Error(reader.errors().front());
    }
    gcode::MachineProgram found = builder.take();
    if (!found.faults.empty()) {
        Diagnostic fault = found.faults.front();
        fault.hint = options.machine.empty() ? "name the machine of the program with --machine" : "";
        throw Error(fault);
    }
    print_warnings(found.unknown_positions());
    auto ways =
        program::arm_ways(std::make_shared<const program::Program>(std::move(found.program)), machine, frame);
    if (ways.empty()) {
        throw Error(Diagnostic{
            .place = {.file = options.file}, .message = "the program contains no motion", .hint = {}});
    }
    return ways;
}

/// What the arm takes for it, s; nothing if it cannot go all of it.
std::optional<double> planned_path_time(const ArmModel& arm,
                                        const std::vector<ArmWay>& ways,
                                        const arm::ArmPath& path,
                                        const ArmReachOptions& options,
                                        const Progress& progress) {
    if (!path.whole()) {
        return std::nullopt;
    }
    motion::ArmMotion motion(arm, path.points.front().joints);
    motion.follow(ways, path, options.file);
    motion::PlannerSettings settings;
    settings.rounding_tolerance = options.tolerance_mm;
    return motion::plan(motion.program(), arm, settings, progress).duration();
}

/// Before the first move no line has moved anything.
std::string line_text(int line) {
    return line == 0 ? "start of the program" : fmt::format("line {}", line);
}

std::string from_to(const char* one, const char* many, std::size_t first, std::size_t last) {
    return first == last ? fmt::format("{} {}", one, first) : fmt::format("{} {} to {}", many, first, last);
}

std::string lines_of(const ArmHole& hole) {
    const int first = hole.first().line, last = hole.last().line;
    return first == last
               ? line_text(first)
               : from_to("line", "lines", static_cast<std::size_t>(first), static_cast<std::size_t>(last));
}

double share_of(const ArmReach& reach) {
    return reach.length > 0.0 ? reach.reached / reach.length : reach.holes.empty() ? 1.0 : 0.0;
}

void print_point(
    const char* which, const ArmHole& hole, const ArmReachPoint& at, const ArmModel& arm, const Frame& part) {
    const Vec3 place = part.inverse() * at.tip;
    const std::string off = to_text(arm, hole.trouble, at.off);
    fmt::print("    {} point {}, {}, X{:.3f} Y{:.3f} Z{:.3f}, {:.1f} mm along the path{}{}\n",
               which,
               at.point,
               line_text(at.line),
               rounded(place.x()),
               rounded(place.y()),
               rounded(place.z()),
               at.along,
               off.empty() ? "" : ": ",
               off);
}

/// Where the stretch begins, where it is worst and where it ends, in the coordinates of the program.
void print_hole(const ArmHole& hole, const ArmModel& arm, const Frame& part) {
    fmt::print("  {}, {}, {:.1f} mm, {}: {}\n",
               lines_of(hole),
               from_to("point", "points", hole.first().point, hole.last().point),
               hole.length,
               name_of(hole.trouble),
               hole.why);
    print_point("first", hole, hole.first(), arm, part);
    if (hole.points.size() > 1) {
        print_point("worst", hole, hole.worst(), arm, part);
        print_point("last ", hole, hole.last(), arm, part);
    }
}

void print_text(const ArmReachOptions& options,
                const ArmModel& arm,
                const ArmReach& reach,
                const std::optional<double>& planned) {
    fmt::print("{}: the arm reaches {:.1f} of {:.1f} mm ({:.1f} %)\n",
               options.file,
               reach.reached,
               reach.length,
               100.0 * share_of(reach));
    for (std::size_t n = 0; n < reach.holes.size() && n < most_holes_shown; ++n) {
        print_hole(reach.holes[n], arm, frame_of(options.frame));
    }
    if (reach.holes.size() > most_holes_shown) {
        fmt::print("  and {} more\n", reach.holes.size() - most_holes_shown);
    }
    for (Eigen::Index n = 0; n < reach.lowest.size(); ++n) {
        const auto joint = static_cast<int>(n);
        fmt::print("joint {:<6} {:>10.3f} to {:>10.3f}, limits {} and {} {}\n",
                   arm.joint(joint).name,
                   from_joint(arm, joint, reach.lowest[n]),
                   from_joint(arm, joint, reach.highest[n]),
                   shortest(rounded(from_joint(arm, joint, arm.joint(joint).min))),
                   shortest(rounded(from_joint(arm, joint, arm.joint(joint).max))),
                   arm.joint(joint).kind == arm::JointKind::revolute ? "deg" : "mm");
    }
    if (reach.lowest.size() > 0) {
        fmt::print(
            "lowest manipulability {:.6f}, {}\n", reach.least_manipulability, line_text(reach.least_line));
        fmt::print("tool axis turned by at most {:.3f} deg\n", to_degrees(reach.most_tilt));
    }
    if (planned) {
        fmt::print("time at the programmed feed rates {:.2f} s, planned for the arm {:.2f} s\n",
                   reach.programmed_time,
                   *planned);
    }
}

nlohmann::ordered_json vector_json(const Vec3& v) {
    return {rounded(v.x()), rounded(v.y()), rounded(v.z())};
}

nlohmann::ordered_json point_json(const ArmReachPoint& at, const ArmModel& arm, const Frame& part) {
    nlohmann::ordered_json json{{"point", at.point},
                                {"line", at.line},
                                {"along_mm", at.along},
                                {"part_mm", vector_json(part.inverse() * at.tip)},
                                {"base_mm", vector_json(at.tip)}};
    if (at.off.tip > 0.0) {
        json["off_mm"] = at.off.tip;
    }
    if (at.off.axis > 0.0) {
        json["off_deg"] = to_degrees(at.off.axis);
    }
    if (at.off.joint.joint >= 0) {
        const int joint = at.off.joint.joint;
        const bool turns = arm.joint(joint).kind == arm::JointKind::revolute;
        json["joint"] = arm.joint(joint).name;
        json[turns ? "joint_deg" : "joint_mm"] = from_joint(arm, joint, at.off.joint.beyond);
    }
    return json;
}

nlohmann::ordered_json hole_json(const ArmHole& hole, const ArmModel& arm, const Frame& part) {
    nlohmann::ordered_json json{{"first_line", hole.first().line},
                                {"last_line", hole.last().line},
                                {"first_point", hole.first().point},
                                {"last_point", hole.last().point},
                                {"worst_point", hole.worst().point},
                                {"length_mm", hole.length},
                                {"trouble", name_of(hole.trouble)},
                                {"why", hole.why},
                                {"points", nlohmann::ordered_json::array()}};
    for (const ArmReachPoint& at : hole.points) {
        json["points"].push_back(point_json(at, arm, part));
    }
    return json;
}

void print_reach_json(const ArmReachOptions& options,
                      const ArmModel& arm,
                      const ArmReach& reach,
                      const std::optional<double>& planned) {
    nlohmann::ordered_json answer;
    answer["whole"] = reach.holes.empty();
    answer["length_mm"] = reach.length;
    answer["reached_mm"] = reach.reached;
    answer["findings"] = nlohmann::ordered_json::array();
    for (const ArmHole& hole : reach.holes) {
        answer["findings"].push_back(hole_json(hole, arm, frame_of(options.frame)));
    }
    answer["joints"] = nlohmann::ordered_json::array();
    for (Eigen::Index n = 0; n < reach.lowest.size(); ++n) {
        const auto joint = static_cast<int>(n);
        answer["joints"].push_back({{"name", arm.joint(joint).name},
                                    {"lowest", from_joint(arm, joint, reach.lowest[n])},
                                    {"highest", from_joint(arm, joint, reach.highest[n])}});
    }
    answer["least_manipulability"] = reach.least_manipulability;
    answer["least_manipulability_line"] = reach.least_line;
    answer["most_tilt_deg"] = to_degrees(reach.most_tilt);
    answer["programmed_time_s"] = reach.programmed_time;
    answer["planned_time_s"] = planned ? nlohmann::ordered_json(*planned) : nlohmann::ordered_json(nullptr);
    fmt::print("{}\n", answer.dump(2));
}

int reach(const ArmReachOptions& options) {
    const ArmModel arm = arm_of(options.arm);
    const std::vector<ArmWay> ways = ways_of(options);
    arm::ArmPathSettings settings;
    settings.tip_tolerance = options.tolerance_mm;
    settings.aim.most_tilt = from_degrees(options.tilt_deg);
    constexpr double followed = 0.8; // of the work
    WatchedWork work;
    const arm::ArmPath path =
        follow_path_well(arm, ways, resting(arm), settings, work.progress().part(0.0, followed));
    const std::optional<double> planned =
        planned_path_time(arm, ways, path, options, work.progress().part(followed, 1.0));
    work.finish();
    const ArmReach found = reach_of(path, ways);
    if (options.json) {
        print_reach_json(options, arm, found, planned);
    } else {
        print_text(options, arm, found, planned);
    }
    return path.whole() ? 0 : 1;
}

} // namespace

void add_arm_reach_command(CLI::App& group, Command& chosen) {
    CLI::App& command =
        *group.add_subcommand("reach", "How much of a program an arm can reach, and what prevents the rest");
    const auto options = std::make_shared<ArmReachOptions>();
    add_arm_option(command, options->arm);
    command.add_option("FILE", options->file, "G-code program")->required();
    command
        .add_option("--frame",
                    options->frame,
                    "Position of the part in the arm's base: mm and degrees, rotated about x, then y, then z "
                    "of the base")
        ->delimiter(',')
        ->expected(6)
        ->allow_extra_args(false)
        ->type_name("X,Y,Z,A,B,C")
        ->capture_default_str();
    command.add_option("--machine", options->machine, "Machine of a program with rotary axes")
        ->type_name("NAME|FILE");
    command
        .add_option("--tolerance", options->tolerance_mm, "Tolerance of the tip from the programmed path, mm")
        ->check(CLI::Range(1e-6, 100.0))
        ->capture_default_str();
    command
        .add_option("--tilt",
                    options->tilt_deg,
                    "Largest rotation of the tool where the arm cannot hold the programmed axis, degrees")
        ->check(CLI::Range(0.0, 90.0))
        ->capture_default_str();
    command.add_flag("--json", options->json, "Print the result as JSON");
    command.callback([&chosen, options] { chosen = [options] { return reach(*options); }; });
}

} // namespace millwright::app
