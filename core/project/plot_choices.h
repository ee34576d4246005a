// What the choices of a plot say about themselves: in the project file, the window and the command line.
#pragma once

#include "core/project/plot_input.h"
#include "core/project/setting_tables.h"

namespace millwright::project {

[[nodiscard]] std::span<const Choice<PictureUse>> picture_uses();
[[nodiscard]] std::span<const Choice<DrawingUse>> drawing_uses();
[[nodiscard]] std::span<const Choice<plot::GrayRule>> gray_rules();
[[nodiscard]] std::span<const Choice<plot::TipKind>> tip_kinds();
[[nodiscard]] std::span<const Choice<plot::CutterSide>> cutter_sides();
[[nodiscard]] std::span<const Choice<plot::Corners>> corner_kinds();
[[nodiscard]] std::span<const Choice<hpgl::FillMode>> fill_modes();
[[nodiscard]] std::span<const Choice<hpgl::LineEnds>> line_ends();
[[nodiscard]] std::span<const Choice<plot::TurnPolicy>> turn_policies();

} // namespace millwright::project
