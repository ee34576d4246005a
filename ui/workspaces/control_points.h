// Which control points a project has: a view may still show those of an earlier surface.
#pragma once

#include "core/project/project.h"
#include "ui/viewport/scene.h"

#include <cstddef>
#include <iterator>

namespace millwright::actions {

/// An exact face has none.
[[nodiscard]] inline bool has_point(const project::SurfaceInput& surface,
                                    const viewport::ControlPointId& id) {
    const auto patch = static_cast<int>(id.patch);
    if (patch < 0 || patch >= std::ssize(surface.patches)) {
        return false;
    }
    const geometry::ControlNet& net = surface.patches[static_cast<std::size_t>(patch)];
    return id.i >= 0 && id.i < net.rows && id.j >= 0 && id.j < net.columns;
}

} // namespace millwright::actions
