// What a person should know of a cut beside its figures.
#pragma once

#include "core/project/cut_study.h"
#include "core/project/plan.h"
#include "core/project/project.h"

#include <string>
#include <vector>

namespace millwright::project {

/// Why tracks of constant scallop leave more than they should, as a sentence with what to do; empty if they
/// do not, or if the program has others. `plan` has its study.
[[nodiscard]] std::string why_higher(const Project& project, const Plan& plan);

/// That the cutter does not keep the tolerance for which the fewest points were chosen, by `path`, the
/// program's; empty if it does, or if the program has others.
[[nodiscard]] std::string why_not_kept(const Project& project, const Evaluation& path);

/// That a spiral, which crosses the tracks for which the grid was made, runs over the uniform one, since that
/// is better for it; empty if it runs over the grid that was asked for, or the program has others.
[[nodiscard]] std::string crossing_remark(const Project& project, const Plan& plan);

/// In which figures the zigzag has more error than over the uniform grid, where the sequencing chooses its
/// way or adds points, of which the grid does not know; empty if in none.
[[nodiscard]] std::string sequencing_remark(const Project& project, const Plan& plan);

/// All of these that there are of the program of `plan` but why_higher(), as sentences.
[[nodiscard]] std::vector<std::string> path_remarks(const Project& project, const Plan& plan);

} // namespace millwright::project
