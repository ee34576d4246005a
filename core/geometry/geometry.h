// Shapes: Bezier patches of any degree, rational or not, surfaces made of them, meshes, closest points.
// Lengths in mm. It knows nothing of tools beyond their pose, and nothing of machines.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/closest_point.h"
#include "core/geometry/mesh.h"
#include "core/geometry/presets.h"
#include "core/geometry/surface.h"
#include "core/geometry/tool_pose.h"
#include "core/geometry/trim.h"
#include "core/geometry/vectors.h"
