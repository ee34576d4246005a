// What the numbers and choices of a plot say about themselves, in the units that people see (settings.h).
#pragma once

#include "core/project/plot_input.h"
#include "core/project/settings.h"

namespace millwright::project {

[[nodiscard]] std::span<const NumberSetting<PlotSettings>> plot_numbers();
/// Of one pen's level, without the pen.
[[nodiscard]] std::span<const NumberSetting<plot::Level>> level_numbers();

/// The row called `id`. Throws Defect if there is none.
[[nodiscard]] const NumberSetting<PlotSettings>& plot_number(std::string_view id);
[[nodiscard]] const NumberSetting<plot::Level>& level_number(std::string_view id);

[[nodiscard]] std::span<const Choice<PictureUse>> picture_uses();
[[nodiscard]] std::span<const Choice<plot::GrayRule>> gray_rules();
[[nodiscard]] std::span<const Choice<plot::TipKind>> tip_kinds();
[[nodiscard]] std::span<const Choice<plot::CutterSide>> cutter_sides();
[[nodiscard]] std::span<const Choice<plot::Corners>> corner_kinds();

inline constexpr int most_levels = 1'000;

} // namespace millwright::project
