// Where the tool is on the part.
#pragma once

#include "core/geometry/vectors.h"

namespace millwright::geometry {

/// The tool tip and the tool axis (unit vector from the tip towards the spindle), in workpiece coordinates.
struct ToolPose {
    Vec3 tip = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ();
};

} // namespace millwright::geometry
