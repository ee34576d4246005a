#include "core/project/surface.h"

#include "core/base/error.h"
#include "core/project/internal/joined_faults.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace millwright::project {

geometry::Surface surface_of(const SurfaceInput& input) {
    if (!input.has_patches()) {
        std::vector<geometry::BsplineSurface> faces;
        for (const FaceInput* face : input.exact_faces()) {
            faces.emplace_back(face->net);
        }
        return geometry::Surface(std::move(faces));
    }
    std::vector<geometry::BezierPatch> patches;
    for (const geometry::ControlNet& net : input.patches) {
        patches.emplace_back(net);
    }
    return geometry::Surface(std::move(patches));
}

region::JoinedRegion joined_region(const JoinedInput& input, const Progress& progress) {
    std::vector<region::ExactFace> faces;
    for (const JoinedFace& joined : input.faces) {
        if (!joined.face.trim.everything()) {
            throw Error(fmt::format("face {}: {}", joined.number, no_joined_trim));
        }
        faces.push_back({geometry::BsplineSurface(joined.face.net), joined.number});
    }
    return region::joined_region(faces, {.mesh = {}, .corners = input.corners}, progress);
}

region::Region machined_region(const SurfaceInput& input, const Progress& progress) {
    if (input.joined) {
        return joined_region(*input.joined, progress).region;
    }
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
