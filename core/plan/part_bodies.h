// The faces of a project as bodies that tool and machine may collide with.
#pragma once

#include "core/geometry/surface.h"
#include "core/kinematics/machine_model.h"
#include "core/project/project.h"
#include "core/simulation/collision_bodies.h"

#include <vector>

namespace millwright::plan {

/// The machined face, whose gouges a comparison has, and the others, if there are any, in one body. Triangles
/// of 100 x 100 steps per face.
[[nodiscard]] std::vector<simulation::CollisionBody> face_bodies(const kinematics::MachineModel& machine,
                                                                 const project::SurfaceInput& input,
                                                                 const geometry::Surface& surface);

} // namespace millwright::plan
