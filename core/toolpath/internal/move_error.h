// The error of one move whose axis positions are known.
#pragma once

#include "core/grid/error_model.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/internal/chord_curve.h"

namespace millwright::toolpath {

/// The axes go linearly from `from` to `to`; the tip should follow `curve` and the tool axis its normals.
/// `tip_samples` times inside the move.
[[nodiscard]] grid::MoveError move_error(const kinematics::MachineModel& machine,
                                         const kinematics::AxisPositions& from,
                                         const kinematics::AxisPositions& to,
                                         const ChordCurve& curve,
                                         int tip_samples);

} // namespace millwright::toolpath
