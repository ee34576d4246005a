// The rows of the outline: the stages of the project with how each stands.
#pragma once

#include "ui/workspaces/frame_state.h"

#include <string>
#include <vector>

namespace millwright::panels {

struct OutlineRow {
    std::string id, name, detail;
    actions::Workspace workspace; ///< where a click goes
    bool so_far = false;          ///< its figure is not the one at the end; `detail` begins with "~" then
};

/// The grids with their mean error; toolpath, program and machine with what the program has, whatever is
/// shown or watched.
[[nodiscard]] std::vector<OutlineRow> outline_rows(const actions::FrameState& now);

} // namespace millwright::panels
