// Which grid is really shown: one that was not made for the project lends its name to nothing.
#pragma once

#include "core/project/project.h"
#include "ui/actions/workbench.h"

namespace millwright::actions {

/// The grid that was asked for where it was made, else the uniform one: Workbench::shown() is its path,
/// unless that of a strategy is shown.
[[nodiscard]] project::GridMethod shown_grid(const Workbench& now);

/// Whether this grid was made before the last change and measured on what is there now: it stands in until
/// the new one is there, and stays where the work was cancelled.
[[nodiscard]] bool is_old_grid(const project::Evaluation& evaluation);

} // namespace millwright::actions
