// Forward kinematics: where the tool is on the part for given axis positions, and how it moves with them.
// Product of exponentials (Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, ch. 3):
// each axis acts by its direction and point at the physical zero, so no frames need to be carried along.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/kinematics/machine_model.h"

#include <array>
#include <cstddef>

namespace millwright::kinematics {

/// The tool pose in workpiece coordinates. `positions` has axis_count() entries.
[[nodiscard]] geometry::ToolPose forward(const MachineModel& machine, const AxisPositions& positions);

/// How far a motion is from straight: no second derivative by its fraction t, which runs from 0 to 1, is
/// longer.
struct Bend {
    double tip = 0.0;  ///< mm
    double axis = 0.0; ///< of the unit vector
};

/// forward() along a straight line in axis coordinates: what all its points share is computed once.
class StraightForward {
public:
    StraightForward(const MachineModel& machine, const AxisPositions& from, const AxisPositions& to);

    /// The pose at fraction `t` of the way, 0 to 1; forward(machine, from + t (to - from)) but for rounding.
    [[nodiscard]] geometry::ToolPose at(double t) const;

    /// From the triangle inequality, turn by turn: above the true ones, by little where one axis turns.
    [[nodiscard]] Bend bend() const;

private:
    /// After the linear axes before it, all relative to a point on the rotary axis.
    struct Turn {
        Vec3 begin = Vec3::Zero();
        Vec3 step = Vec3::Zero();
        Vec3 direction = Vec3::UnitZ();
        double angle = 0.0;
        double way = 0.0;
    };
    std::array<Turn, 3> turns_; // from the tool to the workpiece
    std::size_t count_ = 0;
    Vec3 tool_;
    Vec3 begin_, step_; // of the linear axes after the last turn
};

/// Columns: one per axis. Rows 0-2: d tip / d position; rows 3-5: d axis / d position (mm, rad).
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 9>;
[[nodiscard]] Jacobian jacobian(const MachineModel& machine, const AxisPositions& positions);

/// With the rotary axes fixed the tip is an affine function of the linear ones.
struct LinearMap {
    Vec3 tip_at_zero; ///< workpiece coordinates, linear axes programmed to 0
    Mat3 columns;     ///< d tip / d position of linear_axes(), unit vectors
};
/// The linear `positions` do not matter.
[[nodiscard]] LinearMap linear_map(const MachineModel& machine, const AxisPositions& positions);

/// The motion of what `letter` carries ('\0': the base): maps points of m at the physical zero to m now.
[[nodiscard]] Frame carrier_motion(const MachineModel& machine, const AxisPositions& positions, char letter);

/// Workpiece coordinates to machine coordinates now.
[[nodiscard]] Frame m_T_w(const MachineModel& machine, const AxisPositions& positions);

} // namespace millwright::kinematics
