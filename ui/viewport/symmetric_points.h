// Control points of a design that are edited together: those that are chosen and their images.
#pragma once

#include "ui/viewport/scene.h"

#include <functional>
#include <vector>

namespace millwright::viewport {

/// A control point, and what it takes of the way of the one that leads.
struct SharedPoint {
    ControlPointId id;
    Vec3 share = Vec3::Ones(); ///< in each coordinate: 1, -1 or, in the middle, 0
};

using NetOf = std::function<const geometry::ControlNet&(geometry::PatchId)>;

/// `points` and their images in their nets, ascending, each once. `leads` is one of a net, too.
[[nodiscard]] std::vector<SharedPoint> with_images(const NetOf& net_of,
                                                   const geometry::NetSymmetry& symmetry,
                                                   const std::vector<ControlPointId>& points,
                                                   const ControlPointId& leads);

} // namespace millwright::viewport
