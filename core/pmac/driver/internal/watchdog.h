// The program that watches over the computer from inside the card: nothing else can end motion when the link
// is lost. It uses P1000 to P1006, M1000 to M1008 and PLC 31.
#pragma once

#include "core/pmac/driver/pmac_settings.h"

#include <string>
#include <vector>

namespace millwright::pmac::internal {

/// The lines that make it and start it, disarmed. Every other PLC program is disabled before I5 lets it run.
/// `servo_time`: I10 of the card, by which it counts time. P1003 tells that it runs (GuardWatch). Throws
/// Error for a servo time that no card has.
[[nodiscard]] std::vector<std::string> watchdog_lines(const PmacSettings& settings, double servo_time);

inline constexpr const char* arm_watchdog = "P1002=M1000 P1000=0 P1006=0 P1001=1";
inline constexpr const char* disarm_watchdog = "P1001=0";
inline constexpr const char* disable_plcs = "DISABLE PLC 0..30"; ///< all but the guard
inline constexpr const char* sign_of_life = "P1002=M1000";
inline constexpr double heard_nothing = -1.0; ///< P1000 where it has stopped the motion

} // namespace millwright::pmac::internal
