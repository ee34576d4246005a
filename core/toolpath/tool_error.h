// The error of a whole path that a tool makes which is more than a point along the normal.
#pragma once

#include "core/toolpath/error_field.h"
#include "core/toolpath/tool.h"

namespace millwright::toolpath {

/// As error_field, of a path of with_tool. `closest` of a cutter is by how much its body misses or enters the
/// surface near the contact, `param` the distance of the tip from the one intended, `axis` the angle to the
/// axis intended. Throws Cancelled.
[[nodiscard]] ErrorField tool_error(const geometry::BezierPatch& patch,
                                    const kinematics::MachineModel& machine,
                                    const Tool& tool,
                                    const Toolpath& toolpath,
                                    const AxisPath& axes,
                                    int samples,
                                    const Progress& progress);

} // namespace millwright::toolpath
