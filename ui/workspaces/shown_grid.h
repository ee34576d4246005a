// Which grid is really shown: one that was not made for the project lends its name to nothing.
#pragma once

#include "core/project/project.h"
#include "ui/workspaces/frame_state.h"

namespace millwright::actions {

/// The grid that was asked for where it was made, else the uniform one: FrameState::shown() is its path,
/// unless that of a strategy is shown.
[[nodiscard]] project::GridMethod shown_grid(const FrameState& now);

/// From now on the path is drawn that the program of `project` follows, with its error.
void show_program_path(ViewState& view_state, const project::Project& project);

/// Whether this stands in until the exact one is there, and stays where the work was cancelled: the grid from
/// before the last change on what is there now, or one that was measured coarsely.
[[nodiscard]] bool is_so_far(const plan::Evaluation& evaluation);

} // namespace millwright::actions
