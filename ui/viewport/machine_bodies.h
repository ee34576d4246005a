// Where the bodies of a machine are. Frame m as in core/kinematics/machine_model.h; a body's own frame b has
// its origin at the body's centre and z along a cylinder's direction.
#pragma once

#include "core/kinematics/machine_model.h"

#include <vector>

namespace millwright::viewport {

/// m_T_b of each of the machine's bodies, in their order.
[[nodiscard]] std::vector<Frame> body_poses(const kinematics::MachineModel& machine,
                                            const kinematics::AxisPositions& positions);

/// The box around a body in its own frame.
[[nodiscard]] Box3 body_box(const kinematics::MachineBody& body);

} // namespace millwright::viewport
