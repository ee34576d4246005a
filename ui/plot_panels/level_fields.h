// What is set for one level of a plot: whether, how deep, how fast, with which cutter, on which side.
#pragma once

#include "ui/panels/panel.h"

#include <cstddef>

namespace millwright::panels {

/// Of level `n` of those that are in force, PlotWorkspace::levels().
void level_fields(Ui& ui, const FrameState& now, ActionQueue& ask, std::size_t n);

} // namespace millwright::panels
