// The lines that are sent at a tool change, and that are of no program. Every way between two places of the
// table goes up first, in machine coordinates (G53), whatever offsets are in force.
#pragma once

#include "core/drivers/grbl/internal/messages.h"
#include "core/drivers/tool_change.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::drivers::grbl {

using ChangeLines = std::vector<std::string>;

/// Codes in force at a line, as $G tells them; a feed in mm/min.
struct ModeWords {
    std::string motion, work_system, plane, unit, distance, feed_mode, spindle; ///< as "G0", "M5"
    bool mist = false, flood = false;
    double feed = 0.0, speed = 0.0;
};
[[nodiscard]] ModeWords mode_words(std::string_view modes);

/// Where the tool shall come back to. Machine coordinates, mm and degrees.
struct WayBack {
    Axes from, to;
    double top = 0.0;  ///< Z in which it goes across; not below either end
    bool moves = true; ///< false: it stays where a person has put it
    bool down = true;  ///< false: it stays up
};

/// Spindle and coolant off.
[[nodiscard]] ChangeLines switched_off();
/// Up to `top`, over the sensor, and down to it, fast.
[[nodiscard]] ChangeLines first_touch(const ToolSensor& sensor, double top);
/// Off the place `touched_z` of the first touch, and down again, slowly.
[[nodiscard]] ChangeLines second_touch(const ToolSensor& sensor, double touched_z, double top);
[[nodiscard]] ChangeLines up_to(double top);
/// Makes Z of every work system count for a tool that is longer by `longer`, mm.
[[nodiscard]] ChangeLines tool_length(double longer);
/// Up, across, spindle and coolant as `modes` say, `spin_up` s, down with a feed, and every mode as it was.
[[nodiscard]] ChangeLines
way_back(const WayBack& way, const ModeWords& modes, double spin_up, std::string_view letters);

} // namespace millwright::drivers::grbl
