#include "core/kinematics/forward.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>

namespace millwright::kinematics {

namespace {

/// A rotation about a unit direction (Rodrigues), cheap to apply.
class Turn {
public:
    Turn(const Vec3& direction, double angle) : k_(direction), sin_(std::sin(angle)), cos_(std::cos(angle)) {}

    [[nodiscard]] Vec3 operator()(const Vec3& r) const {
        return cos_ * r + sin_ * k_.cross(r) + (1.0 - cos_) * k_.dot(r) * k_;
    }

private:
    Vec3 k_;
    double sin_, cos_;
};

/// Visits the axes from the tool to the workpiece with the sense in which each moves the tool on the part.
template <class Visit> void from_tool_to_workpiece(const MachineModel& machine, Visit&& visit) {
    const auto& head = machine.head_chain();
    for (auto n = head.rbegin(); n != head.rend(); ++n) {
        visit(*n, 1.0);
    }
    for (const int n : machine.table_chain()) {
        visit(n, -1.0);
    }
}

double physical(const MachineAxis& axis, double position) {
    return position + axis.zero_offset;
}

} // namespace

geometry::ToolPose forward(const MachineModel& machine, const AxisPositions& positions) {
    Vec3 tip = machine.description().tool_tip;
    Vec3 tool = machine.description().tool_axis;
    from_tool_to_workpiece(machine, [&](int n, double sense) {
        const MachineAxis& axis = machine.axis(n);
        const double amount = sense * physical(axis, positions[n]);
        if (axis.kind == AxisKind::linear) {
            tip += amount * axis.direction;
            return;
        }
        const Turn turn(axis.direction, amount);
        tip = axis.point + turn(tip - axis.point);
        tool = turn(tool);
    });
    return {tip - machine.workpiece_origin(), tool};
}

LinearMap linear_map(const MachineModel& machine, const AxisPositions& positions) {
    LinearMap map{machine.description().tool_tip, Mat3::Zero()};
    const auto& linear = machine.linear_axes();
    from_tool_to_workpiece(machine, [&](int n, double sense) {
        const MachineAxis& axis = machine.axis(n);
        if (axis.kind == AxisKind::linear) {
            const auto column = std::find(linear.begin(), linear.end(), n) - linear.begin();
            map.columns.col(column) = sense * axis.direction;
            map.tip_at_zero += sense * axis.zero_offset * axis.direction;
            return;
        }
        const Turn turn(axis.direction, sense * physical(axis, positions[n]));
        map.tip_at_zero = axis.point + turn(map.tip_at_zero - axis.point);
        for (int k = 0; k < 3; ++k) {
            map.columns.col(k) = turn(map.columns.col(k));
        }
    });
    map.tip_at_zero -= machine.workpiece_origin();
    return map;
}

Jacobian jacobian(const MachineModel& machine, const AxisPositions& positions) {
    Vec3 tip = machine.description().tool_tip;
    Vec3 tool = machine.description().tool_axis;
    Jacobian J = Jacobian::Zero(6, machine.axis_count());
    from_tool_to_workpiece(machine, [&](int n, double sense) {
        const MachineAxis& axis = machine.axis(n);
        const double amount = sense * physical(axis, positions[n]);
        if (axis.kind == AxisKind::linear) {
            tip += amount * axis.direction;
            J.col(n).head<3>() = sense * axis.direction;
            return;
        }
        const Turn turn(axis.direction, amount);
        tip = axis.point + turn(tip - axis.point);
        tool = turn(tool);
        for (Eigen::Index k = 0; k < J.cols(); ++k) {
            J.col(k).head<3>() = turn(J.col(k).head<3>());
            J.col(k).tail<3>() = turn(J.col(k).tail<3>());
        }
        J.col(n).head<3>() = sense * axis.direction.cross(tip - axis.point);
        J.col(n).tail<3>() = sense * axis.direction.cross(tool);
    });
    return J;
}

Frame carrier_motion(const MachineModel& machine, const AxisPositions& positions, char letter) {
    Frame motion = Frame::Identity();
    if (letter == '\0') {
        return motion;
    }
    const int carrier = machine.axis_index(letter);
    expects(carrier >= 0, "a carrier is an axis of the machine");
    const bool on_table = machine.axis(carrier).side == AxisSide::table;
    for (const int n : on_table ? machine.table_chain() : machine.head_chain()) {
        const MachineAxis& axis = machine.axis(n);
        const double amount = physical(axis, positions[n]);
        if (axis.kind == AxisKind::linear) {
            motion.translate(amount * axis.direction);
        } else {
            motion.translate(axis.point);
            motion.rotate(Eigen::AngleAxisd(amount, axis.direction));
            motion.translate(-axis.point);
        }
        if (n == carrier) {
            break;
        }
    }
    return motion;
}

Frame m_T_w(const MachineModel& machine, const AxisPositions& positions) {
    const auto& chain = machine.table_chain();
    const char last = chain.empty() ? '\0' : machine.axis(chain.back()).letter;
    Frame result = carrier_motion(machine, positions, last);
    result.translate(machine.workpiece_origin());
    return result;
}

} // namespace millwright::kinematics
