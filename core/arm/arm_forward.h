// Forward kinematics of an arm: where its links and its tool are, and how they move with the joints.
#pragma once

#include "core/arm/arm_model.h"

#include <vector>

namespace millwright::arm {

/// The tool in the base's frame: its tip, and the last joint's axes; z is the tool axis.
[[nodiscard]] Frame base_T_tool(const ArmModel& arm, const JointPositions& positions);

/// The frame of every joint in the base's frame, from the base outwards.
[[nodiscard]] std::vector<Frame> base_T_joints(const ArmModel& arm, const JointPositions& positions);

/// Columns: one per joint. Rows 0-2: velocity of the tip; rows 3-5: angular velocity of the tool; both in the
/// base's frame, a unit of joint velocity (Craig, ch. 5).
using ArmJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 9>;
[[nodiscard]] ArmJacobian arm_jacobian(const ArmModel& arm, const JointPositions& positions);

/// How far the tool can move in every direction that the arm has (Yoshikawa 1985): the product of the
/// Jacobian's singular values, with lengths in units of `length_mm`; 0 where the arm is singular.
[[nodiscard]] double manipulability(const ArmJacobian& jacobian, double length_mm);

/// The largest distance that the tip could have from the base, mm: links and offsets stretched into a line.
[[nodiscard]] double stretched_length(const ArmModel& arm);

} // namespace millwright::arm
