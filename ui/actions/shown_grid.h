// Which grid is really shown: one that was not made for the project lends its name to nothing.
#pragma once

#include "core/project/project.h"
#include "ui/actions/workbench.h"

namespace millwright::actions {

/// The grid that was asked for where it was made, else the uniform one: Workbench::shown() is its path,
/// unless that of a strategy is shown.
[[nodiscard]] project::GridMethod shown_grid(const Workbench& now);

} // namespace millwright::actions
