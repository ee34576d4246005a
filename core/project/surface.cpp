#include "core/project/surface.h"

#include <utility>
#include <vector>

namespace millwright::project {

geometry::Surface surface_of(const SurfaceInput& input) {
    std::vector<geometry::BezierPatch> patches;
    for (const geometry::ControlNet& net : input.patches) {
        patches.emplace_back(net);
    }
    return geometry::Surface(std::move(patches));
}

} // namespace millwright::project
