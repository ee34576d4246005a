// The numbered settings of Grbl 1.1 ($0 to $132), and what grblHAL and FluidNC add, in plain words. Numbers,
// units and meanings after their documentation; the words are ours.
#pragma once

#include "core/drivers/grbl/firmware.h"

#include <span>
#include <string_view>

namespace millwright::drivers {

struct GrblSetting {
    int number = 0;
    std::string_view title, unit, explanation;
};

/// Those of Grbl 1.1.
[[nodiscard]] std::span<const GrblSetting> grbl_settings();
/// Null for a number that the firmware does not have, or that has no words here.
[[nodiscard]] const GrblSetting* find_grbl_setting(int number, GrblFirmware firmware = GrblFirmware::grbl);

/// Of a controller whose status reports ($10) do not say how full its planner is: that what is executed is
/// known late, and what helps. Empty where they do. docs/reference/grbl.md, What counts as executed.
[[nodiscard]] std::string_view grbl_reports_advice(int reports, GrblFirmware firmware = GrblFirmware::grbl);

} // namespace millwright::drivers
