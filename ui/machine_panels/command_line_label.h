// What the line is called in which a person types for the connected machine.
#pragma once

#include "ui/workspaces/frame_state.h"

#include <string_view>

namespace millwright::panels {

/// "MDI" is a word of machines that read G-code; a PMAC's line is a line.
[[nodiscard]] std::string_view command_line_label(const actions::FrameState& now);

} // namespace millwright::panels
