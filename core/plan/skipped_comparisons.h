// Grids that are made only to stand beside the program's are left out where there are very many nodes.
#pragma once

#include "core/project/project.h"

#include <string>

namespace millwright::plan {

/// Of more nodes only the program's grid is made: an elliptic one of a million takes minutes.
inline constexpr int most_compared_nodes = 250'000;

/// Whether the grid by `method`, which is made to be compared and is not the program's, has too many nodes
/// for that.
[[nodiscard]] bool is_comparison_skipped(const project::Project& project, project::GridMethod method);

/// Which grids are left out, and why, as a sentence; empty if none are.
[[nodiscard]] std::string skipped_comparisons_sentence(const project::Project& project);

} // namespace millwright::plan
