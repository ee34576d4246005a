// What a person set up for moving a machine by hand. Losing it loses no work.
#pragma once

#include "ui/workspaces/machine_connection.h"
#include "ui/workspaces/tool_changes.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::actions {

/// Along what an arm is jogged.
enum class ArmFrame : std::uint8_t { joints, base, tool };

/// The program that is shown on the arm.
struct ArmPathChoice {
    bool shown = false;
    bool of_file = false; ///< the opened file's, where one is open, not the project's

    friend bool operator==(const ArmPathChoice&, const ArmPathChoice&) = default;
};

struct ConsoleSettings {
    bool show_reports = false;
    std::vector<std::string> commands; ///< typed before, oldest first

    friend bool operator==(const ConsoleSettings&, const ConsoleSettings&) = default;
};

struct ManualSettings {
    machine::DriverChoice choice;
    std::map<std::string, std::string> addresses; ///< of the other drivers, by name, where one was given
    double step = 0.0;                            ///< mm or deg of one press; 0: as long as it is held
    double speed_mm_per_min = 1000.0;
    double turn_deg_per_min = 720.0;
    bool keys_armed = false; ///< arrow and page keys move the machine
    bool pad_armed = false;  ///< so does a gamepad
    double spindle_rpm = 6000.0;
    std::vector<double> position; ///< what a person reads of a machine that does not tell it: axes, mm or deg
    double probe_way_mm = 20.0;   ///< downwards at most
    double probe_mm_per_min = 100.0;
    ArmFrame arm_frame = ArmFrame::joints;
    int arm_joint = 0;     ///< that the keys move
    int arm_percent = 20;  ///< of the fastest jog of an arm
    bool arm_keys = false; ///< the keys of the thesis move the arm
    ArmPathChoice arm_path;
    double arm_result_step = 5.0; ///< mm between two points of a motion file's result
    bool single_block = false;
    std::map<std::string, ToolChangeSettings> tool_changes; ///< by the address of the link
    ConsoleSettings console;

    friend bool operator==(const ManualSettings&, const ManualSettings&) = default;
};

/// Of the driver of that name: what a person gave, else the usual one.
[[nodiscard]] std::string address_for(const ManualSettings& manual, std::string_view driver);

/// Each driver keeps its own address.
void choose_driver(ManualSettings& manual, std::string_view driver);

} // namespace millwright::actions
