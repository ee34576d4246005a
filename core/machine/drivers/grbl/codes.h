// Grbl's error and alarm numbers in plain words. Numbers after Grbl 1.1's documentation; the words are ours.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace millwright::machine {

struct GrblCode {
    int number = 0;
    std::string_view meaning; ///< what is wrong, a sentence without its full stop
    std::string_view remedy;  ///< what to do about it
};

[[nodiscard]] std::span<const GrblCode> grbl_errors();
[[nodiscard]] std::span<const GrblCode> grbl_alarms();

/// "error 22: there is no feed (put an F word in this line or before it)"; a number that Grbl 1.1 does not
/// have is named as such.
[[nodiscard]] std::string explain_grbl_error(int number);
[[nodiscard]] std::string explain_grbl_alarm(int number);
/// Whether the motion may have been cut off, or zero was not found: where the machine stands, Grbl no longer
/// knows.
[[nodiscard]] bool grbl_alarm_loses_position(int number);

} // namespace millwright::machine
