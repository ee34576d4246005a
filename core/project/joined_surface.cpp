#include "core/project/joined_surface.h"

#include "core/base/error.h"
#include "core/project/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace millwright::project {

namespace {

std::vector<geometry::SeamFigures> seam_figures(const std::vector<geometry::BezierPatch>& patches,
                                                const std::vector<geometry::Seam>& seams) {
    std::vector<geometry::SeamFigures> figures;
    for (const geometry::Seam& seam : seams) {
        figures.push_back(geometry::figures_of(patches, seam));
    }
    return figures;
}

std::vector<OpenSeam> open_seams(const std::vector<geometry::BezierPatch>& patches,
                                 const std::vector<geometry::Seam>& joined) {
    std::vector<OpenSeam> open;
    for (const geometry::Seam& seam : geometry::open_seams_of(patches, joined)) {
        open.push_back({.seam = seam, .gap = geometry::figures_of(patches, seam).gap});
    }
    return open;
}

[[noreturn]] void refuse(const std::vector<geometry::BezierPatch>& patches, double gap_mm) {
    std::string message =
        fmt::format("no two patches have edges whose ends are within {:.4g} mm of each other", gap_mm);
    if (const std::vector<OpenSeam> open = open_seams(patches, {}); !open.empty()) {
        message += "; open seams: " + open_text(open);
    }
    throw Error(message);
}

void refuse_face(const SurfaceInput& surface) {
    if (!surface.has_patches()) {
        throw Error("an exact face has no patches to join", {}, "import it without --exact");
    }
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

std::string seam_text(const geometry::Seam& seam) {
    return fmt::format("{} {} - {} {}",
                       seam.a.patch,
                       geometry::to_text(seam.a.side),
                       seam.b.patch,
                       geometry::to_text(seam.b.side));
}

std::string open_text(const std::vector<OpenSeam>& open) {
    constexpr std::size_t most = 8; // a sentence is read, a list of hundreds is not
    std::string text;
    for (std::size_t n = 0; n < std::min(open.size(), most); ++n) {
        text += fmt::format(
            "{}{} with a gap of {:.4f} mm", n == 0 ? "" : ", ", seam_text(open[n].seam), open[n].gap);
    }
    return open.size() > most ? text + fmt::format(", and {} more", open.size() - most) : text;
}

JoinedSurface joined_surface(const SurfaceInput& surface, geometry::Continuity continuity, double gap_mm) {
    refuse_face(surface);
    const geometry::Surface design = surface_of(surface);
    const std::vector<geometry::BezierPatch>& patches = design.patches();
    JoinedSurface result;
    result.seams = geometry::seams_of(patches, gap_mm);
    if (result.seams.empty()) {
        refuse(patches, gap_mm);
    }
    const geometry::Joined joined = geometry::joined(patches, result.seams, continuity);
    result.before = seam_figures(patches, result.seams);
    result.after = seam_figures(joined.patches, result.seams);
    result.open =
        open_seams(patches, result.seams); // joining moves corners: what is open was too wide before
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
    refuse_face(surface);
    refuse_face(more);
    if (!more.trims.empty()) {
        surface.trims.resize(surface.patches.size());
        surface.trims.insert(surface.trims.end(), more.trims.begin(), more.trims.end());
    }
    surface.preset.clear();
    surface.patches.insert(surface.patches.end(), more.patches.begin(), more.patches.end());
}

} // namespace millwright::project
