// What the numbers of one pen's level say about themselves (setting_tables.h).
#pragma once

#include "core/plot/cut_path.h"
#include "core/project/setting_tables.h"

namespace millwright::project {

/// All but the pen.
[[nodiscard]] std::span<const NumberSetting<plot::Level>> level_numbers();
/// The row called `id`. Throws Defect if there is none.
[[nodiscard]] const NumberSetting<plot::Level>& level_number(std::string_view id);

inline constexpr int most_levels = 1'000;

} // namespace millwright::project
