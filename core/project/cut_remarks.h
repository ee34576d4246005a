// What a person should know of a cut beside its figures.
#pragma once

#include "core/project/cut_study.h"
#include "core/project/plan.h"
#include "core/project/project.h"

#include <string>

namespace millwright::project {

/// Why tracks of constant scallop leave more than they should, as a sentence with what to do; empty if they
/// do not, or if the program has others. `plan` has its study.
[[nodiscard]] std::string why_higher(const Project& project, const Plan& plan);

/// That the cutter does not keep the tolerance for which the fewest points were chosen, by `path`, the
/// program's; empty if it does, or if the program has others.
[[nodiscard]] std::string why_not_kept(const Project& project, const Evaluation& path);

/// What a strategy that crosses the grid's tracks makes of a grid that was made for them; else empty.
[[nodiscard]] std::string crossing_remark(const Project& project);

} // namespace millwright::project
