#include "core/project/joined_surface.h"

#include "core/base/error.h"
#include "core/project/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace millwright::project {

namespace {

std::vector<geometry::SeamFigures> figures_of(const std::vector<geometry::BezierPatch>& patches,
                                              const std::vector<geometry::Seam>& seams) {
    std::vector<geometry::SeamFigures> figures;
    for (const geometry::Seam& seam : seams) {
        figures.push_back(geometry::figures_of(patches, seam));
    }
    return figures;
}

} // namespace

double usual_gap_mm(const SurfaceInput& surface) {
    constexpr double share = 0.05;
    const geometry::Surface design = surface_of(surface);
    double smallest = std::numeric_limits<double>::infinity();
    for (const geometry::BezierPatch& patch : design.patches()) {
        smallest = std::min(smallest, patch.control_box().diagonal().norm());
    }
    return share * smallest;
}

JoinedSurface joined_surface(const SurfaceInput& surface, geometry::Continuity continuity, double gap_mm) {
    const geometry::Surface design = surface_of(surface);
    const std::vector<geometry::BezierPatch>& patches = design.patches();
    JoinedSurface result;
    result.seams = geometry::seams_of(patches, gap_mm);
    if (result.seams.empty()) {
        throw Error(fmt::format("no two patches have sides whose ends are within {:.4g} mm", gap_mm));
    }
    const geometry::Joined joined = geometry::joined(patches, result.seams, continuity);
    result.before = figures_of(patches, result.seams);
    result.after = figures_of(joined.patches, result.seams);
    result.largest_move = joined.largest_move;
    result.rms_move = joined.rms_move;
    result.surface = surface;
    result.surface.preset.clear();
    result.surface.patches.clear();
    for (const geometry::BezierPatch& patch : joined.patches) {
        result.surface.patches.push_back(patch.net());
    }
    return result;
}

void add_patches(SurfaceInput& surface, const SurfaceInput& more) {
    if (!more.trims.empty()) {
        surface.trims.resize(surface.patches.size());
        surface.trims.insert(surface.trims.end(), more.trims.begin(), more.trims.end());
    }
    surface.preset.clear();
    surface.patches.insert(surface.patches.end(), more.patches.begin(), more.patches.end());
}

} // namespace millwright::project
