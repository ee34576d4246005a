// What the program of a project follows: a zigzag over one of its grids, or the path of another strategy.
#pragma once

#include "core/plan/evaluation.h"
#include "core/project/project.h"

#include <string>
#include <string_view>

namespace millwright::plan {

/// The grid whose nodes the program's path takes; uniform where the strategy makes its own points and takes
/// the numbers of nodes alone.
[[nodiscard]] project::GridMethod program_grid(const project::Project& project);

/// Whether the program's path is another one than the zigzag over program_grid().
[[nodiscard]] bool has_own_path(const project::Project& project);

/// Whether that other path takes the nodes of a grid.
[[nodiscard]] bool follows_nodes(project::StrategyInput strategy);

/// Of a project that has_own_path(), and of the zigzag else.
[[nodiscard]] toolpath::StrategySettings strategy_settings(const project::Project& project);

/// "Constant scallop, 0.01 mm" for people; with the tolerance or height where there is one.
[[nodiscard]] std::string strategy_text(const project::Project& project);

/// What is being done when it is made, for people.
inline constexpr std::string_view title_of_path = "Generating the path";

/// The path of the project's strategy over the grid of `base`, with its error; over that of `uniform`, with a
/// note that says so, where it would be worse than there: a grid is made for the zigzag, and a spiral runs
/// across its tracks. Worse is what is_worse() says, or rounds farther apart by more than a tenth. Throws
/// Error where the surface cannot be covered like this or a pose cannot be reached; Cancelled.
[[nodiscard]] Evaluation path_evaluation(const project::Project& project,
                                         const CuttingSetup& cutting_setup,
                                         const Evaluation& base,
                                         const Evaluation& uniform,
                                         toolpath::MoveSampling sampling,
                                         const Progress& progress);

} // namespace millwright::plan
