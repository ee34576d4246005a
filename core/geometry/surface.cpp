#include "core/geometry/surface.h"

#include "core/base/error.h"

#include <utility>

namespace millwright::geometry {

Surface::Surface(std::vector<BezierPatch> patches) : patches_(std::move(patches)) {
    if (patches_.empty()) {
        throw Error("a surface needs at least one patch");
    }
}

const BezierPatch& Surface::patch(PatchId id) const {
    const int n = static_cast<int>(id);
    expects(n >= 0 && n < patch_count(), "a patch id belongs to its surface");
    return patches_[static_cast<std::size_t>(n)];
}

Box3 Surface::control_box() const {
    Box3 box;
    for (const BezierPatch& patch : patches_) {
        box.extend(patch.control_box());
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
