// What this program does at a tool change (M6) of a controller that has none of its own: where the job stops,
// and how it goes on. docs/reference/tool-change.md. Lengths mm, times s, machine coordinates.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace millwright::drivers {

enum class ToolChangeWay {
    stop,  ///< wait for a person, who sets the zero of the new tool
    probe, ///< then measure the new tool at a fixed sensor
    macro  ///< then send lines of the user
};

/// A sensor at a fixed place of a homed machine.
struct ToolSensor {
    double x = 0.0, y = 0.0;
    double travel_z = 0.0;  ///< height in which the longest tool goes anywhere
    double deepest_z = 0.0; ///< of the search
    double feed = 200.0;    ///< mm/min, of the first touch; the second is slower

    friend bool operator==(const ToolSensor&, const ToolSensor&) = default;
};

struct ToolChangePlan {
    ToolChangeWay way = ToolChangeWay::stop;
    double spin_up = 3.0;     ///< s for the spindle to come to its speed
    ToolSensor sensor{};      ///< of ToolChangeWay::probe
    std::string macro{};      ///< lines of G-code, of ToolChangeWay::macro
    std::string macro_file{}; ///< where they come from, for messages

    friend bool operator==(const ToolChangePlan&, const ToolChangePlan&) = default;
};

/// A line of a program at which the job stops for another tool.
struct ToolStop {
    int line = 0;
    int tool = 0;    ///< 0: the program does not say which
    std::string why; ///< "change to tool 3 at line 12: M6 (6 mm end mill)"
    /// Highest Z that the program has reached before, as it was checked; nothing: it has moved nothing, so
    /// that no safe height is known.
    std::optional<double> highest_z{};
    /// The same of its own moves, without where the machine was before it.
    std::optional<double> program_z{};
};

/// What a driver needs of it.
struct ToolChanges {
    ToolChangePlan plan;
    std::vector<ToolStop> stops; ///< in the order of the lines
    /// With the sensor: the tool in the spindle is measured before the first line, as the one that the zero
    /// of Z was set with; else the tool of the first stop is.
    bool reference_first = false;
    /// With the sensor: the zero of Z has to be that of the tool in the spindle before the first line.
    bool needs_zero = false;
    std::vector<int> same_tool{}; ///< lines with an M6 to the tool that is in the spindle, which stop nothing
};

} // namespace millwright::drivers
