// Going to a line of the program, wherever it was asked for.
#pragma once

#include "ui/panels/panel.h"

#include <cstddef>

namespace millwright::panels {

/// The line (from 0) at which the motion stands; -1 where there is none.
[[nodiscard]] std::ptrdiff_t current_line(const FrameState& now);

/// Makes `line` (from 0) the current one: the motion goes to where it begins.
void go_to_line(const FrameState& now, ActionQueue& ask, std::ptrdiff_t line);

/// The motion goes to `time`, s.
void go_to_time(ActionQueue& ask, double time);

} // namespace millwright::panels
