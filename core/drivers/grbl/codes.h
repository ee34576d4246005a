// The error and alarm numbers of Grbl 1.1, grblHAL and FluidNC in plain words. Numbers after their
// documentation; the words are ours.
#pragma once

#include "core/drivers/grbl/firmware.h"

#include <span>
#include <string>
#include <string_view>

namespace millwright::drivers {

struct GrblCode {
    int number = 0;
    std::string_view meaning; ///< what is wrong, a sentence without its full stop
    std::string_view remedy;  ///< what to do about it
};

/// Those that Grbl 1.1 has, and what `firmware` has beyond them or means otherwise.
[[nodiscard]] std::span<const GrblCode> grbl_errors(GrblFirmware firmware = GrblFirmware::grbl);
[[nodiscard]] std::span<const GrblCode> grbl_alarms(GrblFirmware firmware = GrblFirmware::grbl);

/// "error 22: there is no feed (put an F word in this line or before it)"; a number that the firmware does
/// not have is named as such.
[[nodiscard]] std::string explain_grbl_error(int number, GrblFirmware firmware = GrblFirmware::grbl);
[[nodiscard]] std::string explain_grbl_alarm(int number, GrblFirmware firmware = GrblFirmware::grbl);
/// Whether the motion may have been cut off, or zero was not found: where the machine stands, the controller
/// no longer knows.
[[nodiscard]] bool grbl_alarm_loses_position(int number, GrblFirmware firmware = GrblFirmware::grbl);
/// Whether a controller in this alarm answers nothing until it is reset; the others it repeats after each
/// reset until somebody has removed their reason.
[[nodiscard]] bool grbl_alarm_needs_reset(int number);

} // namespace millwright::drivers
