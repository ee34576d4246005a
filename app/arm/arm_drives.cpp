#include "app/arm/arm_command.h"
#include "app/command_line/arm_choice.h"
#include "core/arm/arm_drive_readings.h"
#include "core/arm/arm_zone.h"
#include "core/base/error.h"
#include "core/base/text.h"

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

using arm::ArmDriveReadings;
using arm::DriveReading;

struct ArmDrivesOptions {
    std::string arm = "motoman-l3";
    std::vector<double> numbers;
    bool counts = false; ///< the numbers are those of the drives
    bool json = false;
};

arm::DrivePositions given_counts(const std::vector<double>& numbers) {
    constexpr double most = 1e9;
    arm::DrivePositions counts;
    if (static_cast<Eigen::Index>(numbers.size()) != counts.size()) {
        throw Error(
            fmt::format("the arm has {} drives, but {} counts were given", counts.size(), numbers.size()));
    }
    for (std::size_t n = 0; n < numbers.size(); ++n) {
        if (!(std::abs(numbers[n]) <= most)) {
            throw Error(fmt::format("drive {}: counts must be from {:g} to {:g}", n + 1, -most, most));
        }
        counts[static_cast<Eigen::Index>(n)] = numbers[n];
    }
    return counts;
}

nlohmann::ordered_json finite_or_null(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(rounded(value)) : nlohmann::ordered_json(nullptr);
}

void print_json(const arm::ArmModel& arm, const ArmDriveReadings& found) {
    nlohmann::ordered_json answer;
    auto joints = nlohmann::ordered_json::array();
    for (int n = 0; n < arm.joint_count(); ++n) {
        joints.push_back(rounded(from_joint(arm, n, found.joints[n])));
    }
    answer["joints"] = std::move(joints);
    auto drives = nlohmann::ordered_json::array();
    for (std::size_t n = 0; n < found.drives.size(); ++n) {
        const DriveReading& drive = found.drives[n];
        drives.push_back(
            {{"drive", n + 1},
             {"counts", rounded(drive.counts)},
             {"length_mm", drive.length ? finite_or_null(*drive.length) : nlohmann::ordered_json(nullptr)},
             {"low", finite_or_null(drive.low)},
             {"high", finite_or_null(drive.high)},
             {"inside", drive.inside}});
    }
    answer["drives"] = std::move(drives);
    auto choices = nlohmann::ordered_json::array();
    for (const double roll : found.roll_choices) {
        choices.push_back(rounded(roll));
    }
    answer["roll_choices"] = std::move(choices);
    answer["inside_limits"] = found.reasons.empty();
    answer["reasons"] = found.reasons;
    fmt::print("{}\n", answer.dump(2));
}

std::string counts_text(double value) {
    return std::isfinite(value) ? fixed(value, 1) : "-";
}

void print_table(const arm::ArmModel& arm, const ArmDriveReadings& found) {
    std::string joints;
    for (int n = 0; n < arm.joint_count(); ++n) {
        joints += fmt::format("{:>14.6f}", from_joint(arm, n, found.joints[n]));
    }
    fmt::print("joints{}\n{:<6}{:>14}{:>14}{:>14}{:>14}\n",
               joints,
               "drive",
               "counts",
               "length mm",
               "above",
               "below");
    for (std::size_t n = 0; n < found.drives.size(); ++n) {
        const DriveReading& drive = found.drives[n];
        fmt::print("{:<6}{:>14.3f}{:>14}{:>14}{:>14}{}\n",
                   fmt::format("A{}", n + 1),
                   drive.counts,
                   drive.length ? fixed(*drive.length, 3) : "-",
                   counts_text(drive.low),
                   counts_text(drive.high),
                   drive.inside ? "" : "  outside");
    }
    if (found.roll_choices.size() > 1) {
        std::string choices;
        for (const double roll : found.roll_choices) {
            choices += " " + fixed(roll, 1);
        }
        fmt::print("turns of A5 inside its window:{}\n", choices);
    }
    for (const std::string& reason : found.reasons) {
        fmt::print("outside: {}\n", reason);
    }
}

int actuators(const ArmDrivesOptions& options) {
    const arm::ArmFile file = arm_file_of(options.arm);
    if (!file.actuators) {
        throw Error(file.arm.name() + " has no actuators: its file describes none, so each joint is a drive");
    }
    ArmDriveReadings found =
        options.counts ? arm::drive_readings(*file.actuators, given_counts(options.numbers))
                       : arm::drive_readings(*file.actuators, given_joints(file.arm, options.numbers));
    arm::add_joint_limits(found, *file.actuators, file.arm);
    const std::vector<std::string> others = arm::broken_limits(file.arm, std::nullopt, found.joints);
    found.reasons.insert(found.reasons.begin(), others.begin(), others.end());
    options.json ? print_json(file.arm, found) : print_table(file.arm, found);
    return 0;
}

} // namespace

void add_arm_drives_command(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<ArmDrivesOptions>();
    CLI::App& command =
        *group.add_subcommand("actuators", "Drive counts and lengths for given joints, with their limits");
    add_arm_option(command, options->arm);
    command.add_flag("--json", options->json, "Print the result as JSON");
    command.add_flag("--counts", options->counts, "The numbers are drive counts: print the joints");
    command
        .add_option("NUMBERS", options->numbers, "Joint positions, degrees; with --counts: A1 A2 A3 A4 A5")
        ->required()
        ->expected(1, 9)
        ->type_name("J1 J2 ...");
    command.callback([&chosen, options] { chosen = [options] { return actuators(*options); }; });
}

} // namespace millwright::app
