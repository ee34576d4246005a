// More points where the rotary axes turn fast, which is next to the machine's singular points: there a short
// move over the surface turns an axis by half a turn, and the tool swings away from the surface meanwhile.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/parametric_surface.h"
#include "core/toolpath/sequencing.h"

namespace millwright::toolpath {

/// `toolpath` with points put into those moves inside tracks along which a rotary axis turns by more than
/// `largest_step` (rad, 1e-4 to pi), at equal shares of the rotation: the axes are followed from the move's
/// first position in `axes` along the parameters between its ends. Then no axis turns by more from point to
/// point, unless it has to on the singular point itself or is then taken on another branch. A new point has
/// the node that the move leads to, and its own parameters; its tool stands as the path's tool is to stand.
/// Throws Error where a pose between cannot be reached or has no normal; Cancelled.
[[nodiscard]] Toolpath with_small_rotations(const geometry::ParametricSurface& patch,
                                            const kinematics::MachineModel& machine,
                                            const Toolpath& toolpath,
                                            const AxisPath& axes,
                                            double largest_step,
                                            const Progress& progress);

} // namespace millwright::toolpath
