#include "core/project/surface.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace millwright::project {

geometry::Surface surface_of(const SurfaceInput& input) {
    if (input.face) {
        return geometry::Surface(geometry::BsplineSurface(input.face->net));
    }
    std::vector<geometry::BezierPatch> patches;
    for (const geometry::ControlNet& net : input.patches) {
        patches.emplace_back(net);
    }
    return geometry::Surface(std::move(patches));
}

region::Region machined_region(const SurfaceInput& input) {
    if (input.face) {
        return {geometry::BsplineSurface(input.face->net), input.face->trim};
    }
    if (input.machined_patch < 0 || input.machined_patch >= std::ssize(input.patches)) {
        throw Error(fmt::format(
            "no patch {}; the design has {}, numbered from 0", input.machined_patch, input.patches.size()));
    }
    return {geometry::BezierPatch(input.patches[static_cast<std::size_t>(input.machined_patch)]),
            input.machined_trim()};
}

} // namespace millwright::project
