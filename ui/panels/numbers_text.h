// Numbers as the panels show them: short, with the digits that matter.
#pragma once

#include <cstdint>
#include <string>

namespace millwright::panels {

/// mm with three decimals, four below 0.1; "-" where there is no number.
[[nodiscard]] std::string length_text(double mm);
/// mm with four decimals, more where they are needed for two digits; "-" where there is no number.
[[nodiscard]] std::string deviation_text(double mm);
/// Degrees with two decimals, from radians.
[[nodiscard]] std::string angle_text(double rad);
/// "2026-11-21 05:12" in local time, from s since 1970-01-01 UTC; "-" where there is no such time.
[[nodiscard]] std::string date_time_text(std::int64_t time_s);
/// "-53 %" for a change from `before` to `now`; "-" where that means nothing.
[[nodiscard]] std::string change_text(double before, double now);

} // namespace millwright::panels
