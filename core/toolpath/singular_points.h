// Where on the surface the machine loses an axis: the surface normal lies along the turning axis of the table
// (or head), so that one rotary angle is free and turns fast nearby. They explain the error map.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/kinematics/machine_model.h"

#include <vector>

namespace millwright::toolpath {

struct SingularPoint {
    Vec2 uv = Vec2::Zero();
    Vec3 position = Vec3::Zero();
};

/// All points of the patch whose normal is parallel to the machine's pole direction, by Newton from a raster
/// of 24 x 24 starts, each found once, ordered by u, then v. Curves of such points (a flat or cylindrical
/// part) give the points that Newton meets on them. Empty for a machine without rotary axes.
[[nodiscard]] std::vector<SingularPoint> singular_points(const geometry::ParametricSurface& patch,
                                                         const kinematics::MachineModel& machine);

} // namespace millwright::toolpath
