// What LinuxCNC makes of a feed in inverse time (G93).
#pragma once

namespace millwright::gcode {

/// mm (inch) or degrees per minute: a move with less, its length times its F, goes at that, and so in less
/// time than its F asks for; a move of no length would else get a feed of 0 (LinuxCNC's interpreter).
inline constexpr double least_inverse_time_feed = 0.1;

} // namespace millwright::gcode
