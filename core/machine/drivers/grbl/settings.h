// Grbl's numbered settings ($0 to $132) in plain words. Numbers, units and meanings after Grbl 1.1's
// documentation; the words are ours.
#pragma once

#include <span>
#include <string_view>

namespace millwright::machine {

struct GrblSetting {
    int number = 0;
    std::string_view title, unit, explanation;
};

[[nodiscard]] std::span<const GrblSetting> grbl_settings();
/// Null for a number that Grbl 1.1 does not have.
[[nodiscard]] const GrblSetting* find_grbl_setting(int number);

/// Of a controller whose status reports ($10) do not say how full its planner is: that what is executed is
/// known late, and what helps. Empty where they do. docs/reference/grbl.md, What counts as executed.
[[nodiscard]] std::string_view grbl_reports_advice(int reports);

} // namespace millwright::machine
