// Which axes a gamepad wants to move. A bumper has to be held: a pad that is laid on a table moves nothing.
#pragma once

#include "core/program/program.h"
#include "ui/render/gamepad.h"

#include <span>
#include <vector>

namespace millwright::panels {

/// One value an axis, -1 to 1 in quarters. Left stick X and Y, right stick up and down Z; the cross left and
/// right the first rotary axis, up and down the second.
[[nodiscard]] std::vector<double> pad_axes(const render::Gamepad& pad,
                                           std::span<const program::ProgramAxis> axes);

} // namespace millwright::panels
