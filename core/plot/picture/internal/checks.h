// Refusing settings that are out of their range. `name` begins the sentence: "a pitch of 0; ...".
#pragma once

namespace millwright::plot::internal {

/// Throws Error unless it is finite and above 0.
void check_above_zero(const char* name, double value);

/// The same of a length in mm that may be 0.
void check_not_below_zero(const char* name, double value);

} // namespace millwright::plot::internal
