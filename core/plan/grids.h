// The grids of a project: uniform, or made better by a method, at two levels of effort.
#pragma once

#include "core/base/error.h"
#include "core/plan/evaluation.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/project.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace millwright::plan {

using project::Effort;

/// When a move is looked at: while dragging, and for figures that are reported.
inline constexpr toolpath::MoveSampling live_sampling{8};
inline constexpr toolpath::MoveSampling report_sampling = toolpath::until_known;
[[nodiscard]] constexpr toolpath::MoveSampling sampling_of(Effort effort) {
    return effort == Effort::live ? live_sampling : report_sampling;
}

/// Whether the weight, what is painted of it, and the region count for the grid of `method`.
[[nodiscard]] inline bool uses_weight(project::GridMethod method) {
    return row_of(method).uses_weight;
}

/// What making the grid by `method` takes at most, as a sentence with a figure in MB; empty if unknown.
[[nodiscard]] std::string memory_sentence(project::GridMethod method, const project::GridInput& input);

/// Why that is not begun where `free` bytes are left: it may take more than half of them. nullopt where it
/// does not, or where that is unknown.
[[nodiscard]] std::optional<Diagnostic> memory_fault(project::GridMethod method,
                                                     const project::GridInput& input,
                                                     const std::optional<std::size_t>& free);

/// Throws Error for a memory_fault() that the settings do not allow.
void expect_memory(project::GridMethod method, const project::GridInput& input);

/// A new optimiser for `method` (not uniform) from `start` of nu x nv nodes, or from the uniform grid without
/// one. `error` must outlive it. Throws Error if an expression of the settings has no sense, the solver needs
/// more nodes, `start` does not suit the method (a boundary that slides and is not the square's; bent tracks
/// where tracks are optimised), and as expect_memory().
[[nodiscard]] std::unique_ptr<grid::GridOptimiser>
make_optimiser(project::GridMethod method,
               const project::GridInput& input,
               const toolpath::KinematicError& error,
               Effort effort = Effort::full,
               const std::optional<grid::Grid>& start = std::nullopt);

[[nodiscard]] GridOutcome uniform_outcome(const project::GridInput& input);

/// Runs an optimiser until it has finished.
[[nodiscard]] GridOutcome improved_outcome(grid::GridOptimiser& optimiser, const Progress& progress);

/// What a grid is made for, and by what.
struct GridMaking {
    project::GridMethod method; ///< not uniform
    const project::GridInput& input;
    const CuttingSetup& cutting_setup;
    Effort effort = Effort::full;
};

/// The grid with its error. Where that is worse than `uniform`, the evaluation of the uniform grid, measured
/// like `uniform`, with a note that says so. Throws Error or Cancelled.
[[nodiscard]] Evaluation
evaluation_by(const GridMaking& by, const Evaluation& uniform, const Progress& progress);

/// The same for the program of a project. The whole chain ends with the best grid of all methods: where one
/// of them is better on the finished part (largest * mean error) and keeps the chain's promise there, its
/// grid, with a note that says so; the others have their standard settings.
///
/// Grids are made, and judged, for the nearest branches and without the points that the sequencing adds. The
/// one that is found is then run as the sequencing wants it. Where that is worse than `uniform`, which is run
/// like this, too, the path follows the nearest branches or those of least error, the first that is not, or
/// the way of least error (largest * mean); the note says which. Throws Error or Cancelled.
[[nodiscard]] Evaluation
improved_evaluation(const GridMaking& by, const Evaluation& uniform, const Progress& progress);

/// Whether nothing better than the grid of `start` was found, which was kept.
[[nodiscard]] bool keeps_grid(const Evaluation& found, const Evaluation& start);

/// Whether `found` is worse than `start` in the mean or largest distance to the surface, or in the largest
/// angle between tool axis and normal; that one counts on machines that can turn the tool only.
[[nodiscard]] bool
is_worse(const Evaluation& found, const Evaluation& start, const kinematics::MachineModel& machine);

} // namespace millwright::plan
