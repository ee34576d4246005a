#include "core/geometry/surface.h"

#include "core/base/error.h"

#include <iterator>
#include <utility>

namespace millwright::geometry {

Surface::Surface(std::vector<BezierPatch> patches) : patches_(std::move(patches)) {
    if (patches_.empty()) {
        throw Error("a surface needs at least one patch");
    }
}

Surface::Surface(BsplineSurface face) {
    faces_.push_back(std::move(face));
}

Surface::Surface(std::vector<BsplineSurface> faces) : faces_(std::move(faces)) {
    if (faces_.empty()) {
        throw Error("a surface needs at least one face");
    }
}

std::vector<const ParametricSurface*> Surface::parts() const {
    std::vector<const ParametricSurface*> parts;
    for (const BezierPatch& patch : patches_) {
        parts.push_back(&patch);
    }
    for (const BsplineSurface& face : faces_) {
        parts.push_back(&face);
    }
    return parts;
}

const ParametricSurface& Surface::part(PatchId id) const {
    if (!faces_.empty()) {
        const int n = static_cast<int>(id);
        expects(n >= 0 && n < std::ssize(faces_), "a face is a part of its surface");
        return faces_[static_cast<std::size_t>(n)];
    }
    return patch(id);
}

Surface Surface::in_patches() const {
    if (faces_.empty()) {
        return *this;
    }
    std::vector<BezierPatch> patches;
    for (const BsplineSurface& face : faces_) {
        for (SurfacePiece& piece : face.pieces()) {
            patches.push_back(std::move(piece.patch));
        }
    }
    return Surface(std::move(patches));
}

const BezierPatch& Surface::patch(PatchId id) const {
    const int n = static_cast<int>(id);
    expects(n >= 0 && n < patch_count(), "a patch id belongs to its surface");
    return patches_[static_cast<std::size_t>(n)];
}

Box3 Surface::control_box() const {
    Box3 box;
    for (const ParametricSurface* part : parts()) {
        box.extend(part->control_box());
    }
    return box;
}

Surface Surface::with_patch(PatchId id, BezierPatch patch) const {
    const int n = static_cast<int>(id);
    expects(n >= 0 && n < patch_count(), "a patch id belongs to its surface");
    Surface changed = *this;
    changed.patches_[static_cast<std::size_t>(n)] = std::move(patch);
    return changed;
}

} // namespace millwright::geometry
