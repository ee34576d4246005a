// Everything that is derived from a Project: surface and machine, the grids with their errors, the program of
// the chosen one, its trajectory. The command line calls make_plan; the window's Pipeline makes the same,
// stage by stage: core/plan/internal/stages.h has their order.
#pragma once

#include "core/base/error.h"
#include "core/motion/trajectory.h"
#include "core/plan/cutting_setup.h"
#include "core/plan/evaluation.h"
#include "core/plan/grids.h"
#include "core/plan/plan_program.h"
#include "core/plan/weight_map.h"
#include "core/program/listing.h"
#include "core/program/post.h"
#include "core/project/project.h"
#include "core/region/joined_region.h"
#include "core/toolpath/singular_points.h"

#include <array>
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
    std::shared_ptr<const std::vector<geometry::Trim>> trims; ///< of the surface, one per patch; null: whole
    /// The faces that are machined as one surface; null where there are none.
    std::shared_ptr<const region::JoinedRegion> joined;
    std::shared_ptr<const CuttingSetup> cutting_setup;
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
    std::optional<Diagnostic> unsequenced_failure; ///< why it is missing; the program is there all the same

    [[nodiscard]] const GridResult& grid(project::GridMethod method) const { return grids[index_of(method)]; }
    [[nodiscard]] GridResult& grid(project::GridMethod method) { return grids[index_of(method)]; }
    /// What the program of `project` follows; null if not there.
    [[nodiscard]] const std::shared_ptr<const Evaluation>&
    program_path(const project::Project& project) const;
    /// What that takes on the machine.
    [[nodiscard]] std::optional<double>& program_time(const project::Project& project);
    /// What the cutter does on the path of that evaluation of this plan; null if unknown.
    [[nodiscard]] std::shared_ptr<const CutStudy> cut_of(const project::Project& project,
                                                         const Evaluation* evaluation) const;
};

/// What of a plan is wanted beside the program and what it needs.
struct Scope {
    struct Compared {
        bool grids = false; ///< of the methods that are compared
        bool cuts = false;  ///< what the cutter does on the paths of the other grids that are there

        friend bool operator==(const Compared&, const Compared&) = default;
    };

    Compared compared{};
    bool times = false;  ///< of the grids that are there
    bool weight = false; ///< of the elliptic functional
    bool cut = false;    ///< what the cutter does on the program's path
    bool unsequenced = false;

    /// What either of them wants.
    [[nodiscard]] constexpr Scope with(const Scope& other) const {
        return {.compared = {.grids = compared.grids || other.compared.grids,
                             .cuts = compared.cuts || other.compared.cuts},
                .times = times || other.times,
                .weight = weight || other.weight,
                .cut = cut || other.cut,
                .unsequenced = unsequenced || other.unsequenced};
    }

    static const Scope program;    ///< no grid beside the one that it uses, and the uniform one
    static const Scope report;     ///< what is written about a plan
    static const Scope everything; ///< what can be looked at

    friend bool operator==(const Scope&, const Scope&) = default;
};

inline constexpr Scope Scope::program{.times = true, .unsequenced = true};
inline constexpr Scope Scope::report{
    .compared = {.grids = true}, .times = true, .weight = true, .cut = true, .unsequenced = true};
inline constexpr Scope Scope::everything{.compared = {.grids = true, .cuts = true},
                                         .times = true,
                                         .weight = true,
                                         .cut = true,
                                         .unsequenced = true};

/// What making the grids takes that have 10,000 nodes or more, a sentence each, to be shown before it begins.
[[nodiscard]] std::vector<std::string> memory_sentences(const project::Project& project, const Scope& scope);

/// Throws Error, first with faults_of(project) if there are any, then as expect_memory() for the program's
/// grid, or Cancelled.
[[nodiscard]] Plan make_plan(const project::Project& project,
                             const Folders& folders,
                             const Progress& progress,
                             const Scope& scope = Scope::report);

} // namespace millwright::plan
