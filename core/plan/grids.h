// The grids of a project: uniform, or made better by a method, at two levels of effort.
#pragma once

#include "core/base/error.h"
#include "core/grid/weight.h"
#include "core/plan/evaluation.h"
#include "core/project/project.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::plan {

/// While a person drags, or for what is kept.
enum class Effort { live, full };

/// When a move is looked at: while dragging, and for figures that are reported.
inline constexpr toolpath::MoveSampling live_sampling{8};
inline constexpr toolpath::MoveSampling report_sampling = toolpath::until_known;
[[nodiscard]] constexpr toolpath::MoveSampling sampling_of(Effort effort) {
    return effort == Effort::live ? live_sampling : report_sampling;
}

/// The weight of the elliptic functional that was chosen on `patch`, where the error density of the uniform
/// grid (or of a later one) is `error`; null, if nothing is known of it, for a choice that needs it. Throws
/// Error if an expression has no sense.
[[nodiscard]] grid::WeightPtr chosen_weight(const project::GridInput& input,
                                            const geometry::ParametricSurface& patch,
                                            const grid::WeightPtr& error);

/// How much of the weight counts where, in solver coordinates; null where all of it counts everywhere.
[[nodiscard]] grid::WeightPtr region_weight(const project::GridInput& input,
                                            const geometry::ParametricSurface& patch);

/// Whether the weight, what is painted of it, and the region count for the grid of `method`.
[[nodiscard]] constexpr bool uses_weight(project::GridMethod method) {
    return method == project::GridMethod::elliptic || method == project::GridMethod::harmonic;
}

/// Whether the chosen weight comes from the measured error, if only in part.
[[nodiscard]] bool needs_error(const project::EllipticInput& input);

/// Paints on the weight from `from` to `to` on `patch` (a dab where both are one), on a fresh table if
/// nothing was painted so far. True if something has changed. What is painted counts where the weight is
/// mixed and its share is not 0.
bool paint_weight(project::EllipticInput& input,
                  const geometry::ParametricSurface& patch,
                  const Vec2& from,
                  const Vec2& to,
                  const grid::Brush& brush);

/// Makes what is painted count: mixes the weight, with what it was made of so far, where it is not mixed.
void let_paint_count(project::EllipticInput& input);

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

/// Runs an optimiser to its end.
[[nodiscard]] GridOutcome improved_outcome(grid::GridOptimiser& optimiser, const Progress& progress);

/// What is being done when a grid is made, for people.
[[nodiscard]] std::string_view title_of_making(project::GridMethod method);

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
