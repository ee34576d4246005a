#include "core/kinematics/forward.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>

namespace millwright::kinematics {

namespace {

/// The rotation about a unit direction (Rodrigues).
Mat3 turn_about(const Vec3& k, double angle) {
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    const Vec3 ks = s * k;
    const Vec3 kc = (1.0 - c) * k;
    const double xy = kc.x() * k.y();
    const double xz = kc.x() * k.z();
    const double yz = kc.y() * k.z();
    Mat3 turn;
    turn << c + kc.x() * k.x(), xy - ks.z(), xz + ks.y(), //
        xy + ks.z(), c + kc.y() * k.y(), yz - ks.x(),     //
        xz - ks.y(), yz + ks.x(), c + kc.z() * k.z();
    return turn;
}

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
        const Mat3 turn = turn_about(axis.direction, amount);
        tip = axis.point + turn * (tip - axis.point);
        tool = turn * tool;
    });
    return {tip - machine.workpiece_origin(), tool};
}

StraightForward::StraightForward(const MachineModel& machine,
                                 const AxisPositions& from,
                                 const AxisPositions& to)
    : tool_(machine.description().tool_axis) {
    Vec3 begin = machine.description().tool_tip;
    Vec3 step = Vec3::Zero();
    from_tool_to_workpiece(machine, [&](int n, double sense) {
        const MachineAxis& axis = machine.axis(n);
        const double amount = sense * physical(axis, from[n]);
        const double way = sense * (to[n] - from[n]);
        if (axis.kind == AxisKind::linear) {
            begin += amount * axis.direction;
            step += way * axis.direction;
            return;
        }
        turns_.at(count_++) = {begin - axis.point, step, axis.direction, amount, way};
        begin = axis.point;
        step.setZero();
    });
    begin_ = begin - machine.workpiece_origin();
    step_ = step;
}

geometry::ToolPose StraightForward::at(double t) const {
    Vec3 tip = Vec3::Zero();
    Vec3 tool = tool_;
    for (std::size_t n = 0; n < count_; ++n) {
        const Turn& turn = turns_[n];
        const Mat3 turned = turn_about(turn.direction, turn.angle + t * turn.way);
        tip = turned * (tip + turn.begin + t * turn.step);
        tool = turned * tool;
    }
    return {tip + begin_ + t * step_, tool};
}

Bend StraightForward::bend() const {
    double far = 0.0, fast = 0.0; // the largest length of the vector that is turned, and of its derivative
    double angle = 0.0;
    Bend bend;
    for (std::size_t n = 0; n < count_; ++n) {
        const Turn& turn = turns_[n];
        far += std::max(turn.begin.norm(), (turn.begin + turn.step).norm());
        fast += turn.step.norm();
        const double way = std::abs(turn.way);
        bend.tip += way * (way * far + 2.0 * fast);
        fast += way * far;
        angle += way;
    }
    bend.axis = angle * angle;
    return bend;
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
        const Mat3 turn = turn_about(axis.direction, sense * physical(axis, positions[n]));
        map.tip_at_zero = axis.point + turn * (map.tip_at_zero - axis.point);
        map.columns = turn * map.columns;
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
        const Mat3 turn = turn_about(axis.direction, amount);
        tip = axis.point + turn * (tip - axis.point);
        tool = turn * tool;
        J.topRows<3>() = turn * J.topRows<3>();
        J.bottomRows<3>() = turn * J.bottomRows<3>();
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
