// The road as pure functions of a Project: surface and machine, the grids with their errors, the
// program of the chosen one, its trajectory. The command line calls make_plan; the workbench's Pipeline calls
// the parts.
#pragma once

#include "core/base/error.h"
#include "core/motion/trajectory.h"
#include "core/plan/evaluation.h"
#include "core/plan/grids.h"
#include "core/plan/weight_map.h"
#include "core/program/listing.h"
#include "core/program/post.h"
#include "core/project/project.h"
#include "core/toolpath/singular_points.h"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::plan {

struct CutStudy; // cut_study.h

/// What is known of the grid of one method.
struct GridResult {
    std::shared_ptr<const Evaluation> evaluation; ///< the grid with its error; null if not made
    std::shared_ptr<const CutStudy> cut;  ///< of the program it would have; null for the program's own
    std::optional<double> estimated_time; ///< of that program on the machine, s; nothing if unknown
    std::optional<Diagnostic> failure;    ///< why a grid that is only compared with the program's is missing
};

/// Everything derived from one project. Parts that a caller did not ask for are null.
struct Plan {
    std::shared_ptr<const geometry::Surface> surface;
    std::shared_ptr<const std::vector<geometry::Trim>> trims; ///< of the surface, one a patch; null: whole
    std::shared_ptr<const Workpiece> workpiece;
    std::vector<toolpath::SingularPoint> singular_points;
    std::array<GridResult, project::every_grid_method.size()> grids; ///< by GridMethod
    std::shared_ptr<const Evaluation> path;  ///< of a project that has_own_path(); null else
    std::optional<double> path_time;         ///< of its program on the machine, s
    std::shared_ptr<const WeightMap> weight; ///< of the elliptic functional
    std::shared_ptr<const program::Program> program;
    program::PostNotes program_notes;
    std::shared_ptr<const program::Listing> listing; ///< G-code text
    std::shared_ptr<const motion::Trajectory> trajectory;
    std::shared_ptr<const CutStudy> cut; ///< what the cutter does on the program's path; null for a point
    /// The program's path with the nearest angles and no point added, and its time; nothing where it is that.
    std::shared_ptr<const Evaluation> unsequenced;
    std::optional<double> unsequenced_time;

    [[nodiscard]] const GridResult& grid(project::GridMethod method) const {
        return grids[static_cast<std::size_t>(method)];
    }
    [[nodiscard]] GridResult& grid(project::GridMethod method) {
        return grids[static_cast<std::size_t>(method)];
    }
    /// What the program of `project` follows; null if not there.
    [[nodiscard]] const std::shared_ptr<const Evaluation>&
    program_path(const project::Project& project) const;
    /// What that takes on the machine.
    [[nodiscard]] std::optional<double>& program_time(const project::Project& project);
    /// What the cutter does on the path of that evaluation of this plan; null if unknown.
    [[nodiscard]] std::shared_ptr<const CutStudy> cut_of(const project::Project& project,
                                                         const Evaluation* evaluation) const;
};

/// Where the project's machine is looked for.
struct Folders {
    std::filesystem::path project; ///< of the project file; empty for an unsaved project
    std::filesystem::path assets;

    friend bool operator==(const Folders&, const Folders&) = default;
};

/// Throws Error if the machine is unknown or its file wrong.
[[nodiscard]] Workpiece workpiece_of(const project::Project& project, const Folders& folders);

/// How the axis positions of its paths are chosen; what does not matter for the goal is left out, so that
/// equal settings give equal paths.
[[nodiscard]] toolpath::SequencingSettings sequencing_settings(const project::Project& project);
/// The program that SequencingGoal::time is about; with another goal always the same.
[[nodiscard]] project::ProgramInput timing(const project::Project& project);

[[nodiscard]] program::ProgramSettings program_settings(const project::ProgramInput& input);

/// Program, listing, trajectory and time of the path that the program follows, into `plan`. Throws Error or
/// Cancelled, then `plan` is as it was.
void add_program(Plan& plan, const project::Project& project, const Progress& progress);

/// What a program of `evaluation` would take on `machine`, s; nothing where it can run none. Throws
/// Cancelled.
[[nodiscard]] std::optional<double> estimated_time(const Evaluation& evaluation,
                                                   const kinematics::MachineModel& machine,
                                                   const project::ProgramInput& input,
                                                   const Progress& progress);

/// Of the grids that were not chosen the estimated times, for comparison, into `plan`: those that are missing
/// and can be made into a program. Throws Cancelled.
void add_estimated_times(Plan& plan, const project::Project& project, const Progress& progress);

/// Plan::unsequenced, where the project asks for another sequence than the nearest angles.
void add_unsequenced(Plan& plan, const project::Project& project, const Progress& progress);

/// How much of a plan is wanted.
enum class Scope {
    everything, ///< with the grids of compared_methods
    program     ///< the program and what it needs: of the improved grids only the one it uses, if any
};

/// What making the grids takes that have 10,000 nodes or more, a sentence each, to be told before it begins.
[[nodiscard]] std::vector<std::string> memory_sentences(const project::Project& project, Scope scope);

/// Throws Error, first with faults_of(project) if there are any, then as expect_memory() for the program's
/// grid, or Cancelled.
[[nodiscard]] Plan make_plan(const project::Project& project,
                             const Folders& folders,
                             const Progress& progress,
                             Scope scope = Scope::everything);

} // namespace millwright::plan
