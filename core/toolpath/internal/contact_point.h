// One point that the tool touches, before a tool leans there or a machine has its say.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/toolpath/toolpath.h"

namespace millwright::toolpath {

/// At the parameters `uv`, along the normal on the side of the tool. Throws Error where there is none.
[[nodiscard]] PathPoint contact_point(const geometry::BezierPatch& patch, const Vec2& uv, bool flipped);

} // namespace millwright::toolpath
