// The road as pure functions of a Project: surface and machine, the three grids with their errors, the
// program of the chosen one, its trajectory. The command line calls make_plan; the workbench's Pipeline calls
// the parts.
#pragma once

#include "core/gcode/program.h"
#include "core/motion/trajectory.h"
#include "core/project/evaluation.h"
#include "core/project/project.h"
#include "core/toolpath/singular_points.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace millwright::project {

/// Everything derived from one project. Parts that a caller did not ask for are null.
struct Plan {
    std::shared_ptr<const geometry::Surface> surface;
    std::shared_ptr<const Workpiece> workpiece;
    std::vector<toolpath::SingularPoint> singular_points;
    std::shared_ptr<const Evaluation> uniform;
    std::shared_ptr<const Evaluation> elliptic;  ///< the adapted grid
    std::shared_ptr<const Evaluation> optimised; ///< the track optimiser's grid
    std::shared_ptr<const gcode::Program> program;
    std::shared_ptr<const std::string> listing; ///< G-code text
    std::shared_ptr<const motion::Trajectory> trajectory;

    /// The evaluation that `method` stands for; null if not there.
    [[nodiscard]] std::shared_ptr<const Evaluation> evaluation(GridMethod method) const;
};

/// Where the project's machine is looked for.
struct Folders {
    std::filesystem::path project; ///< of the project file; empty for an unsaved project
    std::filesystem::path assets;
};

/// Samples inside a move: while dragging, and for figures that are reported.
inline constexpr int live_samples = 8;
inline constexpr int report_samples = 40;

[[nodiscard]] geometry::Surface surface_of(const Project& project);
[[nodiscard]] Workpiece workpiece_of(const Project& project, const Folders& folders);

/// A new improver for `method` (not uniform) from the uniform grid. `workpiece` must outlive it.
[[nodiscard]] std::unique_ptr<grid::GridImprover>
make_improver(GridMethod method, const Project& project, const toolpath::KinematicError& error);

/// The uniform grid of the project.
[[nodiscard]] GridOutcome uniform_outcome(const GridInput& input);
/// Runs an improver to its end.
[[nodiscard]] GridOutcome improved_outcome(grid::GridImprover& improver, const Progress& progress);

/// Program, listing and trajectory of one evaluation, into `plan`.
void add_program(Plan& plan, const Project& project, const Evaluation& chosen, const Progress& progress);

/// All of it. Throws Error or Cancelled.
[[nodiscard]] Plan make_plan(const Project& project, const Folders& folders, const Progress& progress);

} // namespace millwright::project
