// The stages of a plan in the order in which they depend on each other: the one place where it is written.
#pragma once

#include "core/plan/internal/stage.h"

#include <vector>

namespace millwright::plan {

/// With the time of the machine's file.
[[nodiscard]] Source source_of(const project::Project& project, const Folders& folders);

/// Whether cutting_setup_of() gives the same for both.
[[nodiscard]] bool same_cutting_setup(const Source& then, const Source& now);

/// Each reads results of stages before it alone. `scope` says which are asked for beside the program.
[[nodiscard]] std::vector<Stage> stages_of(const project::Project& project, const Scope& scope);

} // namespace millwright::plan
