// One grid carried all the way to its error on a machine: what is compared side by side.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/trim.h"
#include "core/grid/grid_optimiser.h"
#include "core/project/project.h"
#include "core/region/region.h"
#include "core/toolpath/error_field.h"
#include "core/toolpath/kinematic_error.h"
#include "core/toolpath/sequenced_path.h"
#include "core/toolpath/strategy.h"

#include <optional>
#include <string>
#include <vector>

namespace millwright::plan {

/// What a grid was made by, for the report and the people.
struct GridOutcome {
    grid::Grid grid;
    grid::OptimiserStatus status = grid::OptimiserStatus::converged;
    int rounds = 0;
    int iterations = 0;
    double norm = 0.0;
    /// Of the moves inside tracks: distance to the surface curve between the nodes, as the optimiser measured
    /// it at its start and for `grid`. Nothing for the uniform grid.
    std::optional<grid::ErrorSummary> start_by_curve = {}, by_curve = {};
    std::string note = {};                       ///< one sentence; empty for the uniform grid
    std::string warning = {};                    ///< as grid::OptimiserState::warning
    std::vector<grid::ChainStage> stages = {};   ///< of the whole chain
    std::vector<grid::IterationNorm> norms = {}; ///< as grid::OptimiserState::norms
};

struct Evaluation {
    GridOutcome outcome;
    toolpath::Toolpath toolpath;
    toolpath::AxisPath axes;
    toolpath::ErrorField field;
    /// Over the moves inside tracks.
    grid::ErrorSummary closest, param;
    /// Over the moves from track to track.
    grid::ErrorSummary cross_closest;
    /// Largest distance of neighbouring tracks, mm; nothing where the strategy sets its tracks itself.
    std::optional<double> track_gap;
    double path_length = 0.0; ///< mm
    /// By which the branches and turns of its path were chosen.
    toolpath::SequencingGoal goal = toolpath::SequencingGoal::nearest;
};

/// Surface, machine and direction that an evaluation is made for. Shared by all stages of one plan.
struct CuttingSetup {
    region::Region patch;
    kinematics::MachineModel machine;
    grid::TrackDirection direction = grid::TrackDirection::along_v;
    bool flipped = false;
    kinematics::AngleMode angle_mode = kinematics::AngleMode::consistent;
    toolpath::Tool tool = {};
    toolpath::SequencingSettings sequencing = {}; ///< of consistent angles
    project::ProgramInput timing = {};            ///< what SequencingGoal::time is the time of
    geometry::Trim trim = {};                     ///< what of the patch is cut

    [[nodiscard]] toolpath::KinematicError error_model() const;
};

/// The zigzag over the grid, looked at inside each move as in toolpath::error_field. Throws
/// Error where a pose cannot be reached or a normal is degenerate.
[[nodiscard]] Evaluation evaluate(const CuttingSetup& cutting_setup,
                                  GridOutcome outcome,
                                  toolpath::MoveSampling sampling,
                                  const Progress& progress);

/// The same of another strategy's path over the grid. Throws Error too where the surface cannot be covered
/// like this.
[[nodiscard]] Evaluation evaluate(const CuttingSetup& cutting_setup,
                                  GridOutcome outcome,
                                  const toolpath::StrategySettings& strategy,
                                  toolpath::MoveSampling sampling,
                                  const Progress& progress);

} // namespace millwright::plan
