// The program of a project cut with a tool that has a body: path, error and program of that tool, whether it
// fits into the surface, what it leaves, and which blocks bring cutter or holder into the part.
#pragma once

#include "core/project/plan.h"
#include "core/project/tool_input.h"
#include "core/toolpath/swept_cut.h"

#include <string>
#include <vector>

namespace millwright::project {

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

/// Of all points of the raster that are cut. mm.
struct ScallopFigures {
    double max = 0.0;
    double mean = 0.0;
    double p95 = 0.0;        ///< 95 % of the points are not higher
    double not_cut = 0.0;    ///< share of the points that the cutter never came near
    double by_formula = 0.0; ///< largest of gap^2 (1/R + k) / 8 over neighbouring tracks
};

struct CutStudy {
    Plan plan; ///< with the evaluation of the chosen grid, its program and its time as of the tool
    std::vector<LocalGouge> local_gouges;
    std::vector<BlockBite> bites;
    toolpath::SweptCut swept;
    ScallopFigures scallops;
    double deepest = 0.0;   ///< cut below the surface, mm
    double step_over = 0.0; ///< between tracks, mm, that leaves `wanted_scallop` everywhere
};

/// `plan` has the chosen grid. Throws Error if `input` has a fault or no cutter, if a pose cannot be reached,
/// for faulty angle formulas, and Cancelled.
[[nodiscard]] CutStudy study_cut(Plan plan,
                                 const Project& project,
                                 const ToolInput& input,
                                 double wanted_scallop_mm,
                                 const Progress& progress);

/// cut.json: docs/reference/cutter.md.
[[nodiscard]] std::string
cut_report_text(const Project& project, const ToolInput& input, const CutStudy& study);

/// surface.csv: u, v, x, y, z and the height that is left, a point a line; nothing where it was not cut.
[[nodiscard]] std::string surface_csv(const CutStudy& study);

} // namespace millwright::project
