// What the numbers of a plot say about themselves, in the units that people see (setting_tables.h).
#pragma once

#include "core/project/plot_input.h"
#include "core/project/setting_tables.h"

namespace millwright::project {

[[nodiscard]] std::span<const NumberSetting<PlotSettings>> plot_numbers();
/// The row called `id`. Throws Defect if there is none.
[[nodiscard]] const NumberSetting<PlotSettings>& plot_number(std::string_view id);

} // namespace millwright::project
