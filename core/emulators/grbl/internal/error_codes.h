// The error numbers that Grbl 1.1 answers, as in `error:22`, and some of its kin.
#pragma once

namespace millwright::emulators::internal::error_code {

constexpr int none = 0;
constexpr int no_letter = 1;
constexpr int bad_number = 2;
constexpr int unknown_command = 3; ///< that begins with $
constexpr int negative_value = 4;
constexpr int homing_off = 5;
constexpr int short_step_pulse = 6;
constexpr int not_idle = 8;
constexpr int soft_limits_without_homing = 10;
constexpr int door_open = 13;
constexpr int outside_travel = 15;
constexpr int bad_jog = 16;
constexpr int unsupported_command = 20;
constexpr int two_of_a_group = 21;
constexpr int no_feed = 22;
constexpr int not_an_integer = 23;
constexpr int axis_conflict = 24;
constexpr int repeated_word = 25;
constexpr int no_axes = 26;
constexpr int bad_line_number = 27;
constexpr int value_missing = 28;
constexpr int no_such_offset = 29;
constexpr int g53_without_line = 30;
constexpr int axes_without_motion = 31;
constexpr int no_axis_in_plane = 32;
constexpr int bad_target = 33;
constexpr int bad_radius = 34;
constexpr int no_offset_in_plane = 35;
constexpr int unused_words = 36;
constexpr int wrong_length_axis = 37;
constexpr int no_such_tool = 38;
constexpr int homing_required = 46; ///< of a grblHAL
constexpr int jog_cancelled = 130;  ///< of a FluidNC, as the next two
constexpr int no_such_setting = 151;
constexpr int read_only_setting = 162;

} // namespace millwright::emulators::internal::error_code
