// What a person set up for moving a machine by hand. Losing it loses no work.
#pragma once

#include "ui/actions/controller.h"

#include <array>
#include <string>
#include <vector>

namespace millwright::actions {

struct HandSettings {
    machine::DriverChoice choice;
    /// Of the other kinds, by DriverKind: each keeps its own.
    std::array<std::string, 6> addresses{"", "", "tcp:127.0.0.1:5007", "", "", ""};
    double step = 0.0; ///< mm or deg of one press; 0: as long as it is held
    double speed_mm_per_min = 1000.0;
    double turn_deg_per_min = 720.0;
    bool keys_armed = false; ///< arrow and page keys move the machine
    bool pad_armed = false;  ///< so does a gamepad
    double spindle_rpm = 6000.0;
    double probe_way_mm = 20.0; ///< downwards at most
    double probe_mm_per_min = 100.0;
    bool single_block = false;
    bool show_reports = false;         ///< in the console
    std::vector<std::string> commands; ///< typed before, oldest first

    friend bool operator==(const HandSettings&, const HandSettings&) = default;
};

} // namespace millwright::actions
