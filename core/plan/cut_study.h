// What a tool with a body does on the way of a project's program: whether it fits into the surface, what it
// leaves, and which blocks bring cutter or holder into the part.
#pragma once

#include "core/plan/plan.h"
#include "core/toolpath/swept_cut.h"

#include <string>
#include <vector>

namespace millwright::plan {

/// A block on which a body comes deeper below the surface than the tool's limit.
struct BlockBite {
    int block = 0; ///< of the program
    int line = 0;  ///< of the listing
    bool by_holder = false;
    toolpath::Bite bite;
};

/// A path point at which the cutter bites in next to its own contact.
struct LocalGouge {
    toolpath::GridOrigin origin;
    Vec3 contact = Vec3::Zero();
    double relative_curvature = 0.0; ///< below 0, 1/mm
};

/// Of all points of the raster that are cut, and not too deep. mm.
struct ScallopFigures {
    double max = 0.0;
    double mean = 0.0;
    double p95 = 0.0;        ///< 95 % of the points are not higher
    double gouged = 0.0;     ///< share of the points that are cut too deep, by more than a micrometre
    double not_cut = 0.0;    ///< share of the points that the cutter never came near
    double by_formula = 0.0; ///< largest of gap^2 (1/R + k) / 8 over neighbouring tracks or rounds
};

struct CutStudy {
    std::vector<LocalGouge> local_gouges;
    std::vector<BlockBite> bites;
    toolpath::SweptCut swept;
    ScallopFigures scallops;
    double deepest = 0.0;   ///< cut below the surface, mm
    double step_over = 0.0; ///< between tracks, mm, that leaves the tool's scallop height at most
};

/// `plan` has the program. Throws Error if the project's tool is a point, and Cancelled.
[[nodiscard]] CutStudy study_cut(const Plan& plan, const project::Project& project, const Progress& progress);

/// The same of another grid of `plan`, on the program it would have; its bites are in no line (0). Throws
/// Error too where the machine can run none.
[[nodiscard]] CutStudy study_cut_of(project::GridMethod method,
                                    const Plan& plan,
                                    const project::Project& project,
                                    const Progress& progress);

/// The study into `plan`, where the tool has a body. Throws Cancelled, then `plan` is as it was.
void add_cut_study(Plan& plan, const project::Project& project, const Progress& progress);

/// That of the grid by `method` into `plan`, where the grid is there, the tool has a body and the machine can
/// run it. Throws Cancelled.
void add_compared_cut(project::GridMethod method,
                      Plan& plan,
                      const project::Project& project,
                      const Progress& progress);

/// cut.json: docs/reference/cutter.md. `plan` has its study.
[[nodiscard]] std::string cut_report_text(const project::Project& project, const Plan& plan);

/// surface.csv: u, v, x, y, z and the height that is left, a point of the raster a line; nothing where it was
/// not cut. Points outside of the outline are not in it.
[[nodiscard]] std::string surface_csv(const CuttingSetup& cutting_setup, const toolpath::SweptCut& swept);

} // namespace millwright::plan
