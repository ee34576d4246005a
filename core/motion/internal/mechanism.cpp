#include "core/motion/internal/mechanism.h"

#include "core/arm/arm_forward.h"
#include "core/base/numbers.h"

#include <cmath>
#include <utility>

namespace millwright::motion::internal {

using kinematics::AxisKind;
using kinematics::AxisPositions;
using kinematics::MachineAxis;

namespace {

std::vector<MachineAxis> axes_of(const arm::ArmModel& arm) {
    std::vector<MachineAxis> axes;
    for (const arm::ArmJoint& joint : arm.description().joints) {
        MachineAxis axis;
        axis.letter = static_cast<char>('1' + axes.size());
        axis.kind = joint.kind == arm::JointKind::revolute ? AxisKind::rotary : AxisKind::linear;
        axis.min = joint.min;
        axis.max = joint.max;
        axis.max_velocity = joint.max_velocity;
        axis.max_acceleration = joint.max_acceleration;
        axes.push_back(axis);
    }
    return axes;
}

} // namespace

Mechanism::Mechanism(std::string name, std::vector<MachineAxis> axes)
    : name_(std::move(name)), axes_(std::move(axes)) {
    for (int n = 0; n < axis_count(); ++n) {
        if (axis(n).kind == AxisKind::rotary) {
            rotary_axes_.push_back(n);
        }
    }
}

double Mechanism::linear_length(const AxisPositions& change) const {
    double squares = 0.0;
    for (int n = 0; n < axis_count(); ++n) {
        squares += axis(n).kind == AxisKind::linear ? square(change[n]) : 0.0;
    }
    return std::sqrt(squares);
}

MachineMechanism::MachineMechanism(const kinematics::MachineModel& machine)
    : Mechanism(machine.name(), machine.axes()), machine_(machine) {}

Vec3 MachineMechanism::tip(const AxisPositions& positions) const {
    return kinematics::forward(machine_, positions).tip;
}

kinematics::Jacobian MachineMechanism::jacobian(const AxisPositions& positions) const {
    return kinematics::jacobian(machine_, positions);
}

double MachineMechanism::sliding(const AxisPositions&, const AxisPositions& change) const {
    Vec3 sum = Vec3::Zero();
    for (const int n : machine_.linear_axes()) {
        const MachineAxis& slide = machine_.axis(n);
        sum += (slide.side == kinematics::AxisSide::head ? change[n] : -change[n]) * slide.direction;
    }
    return sum.norm();
}

ArmMechanism::ArmMechanism(const arm::ArmModel& arm) : Mechanism(arm.name(), axes_of(arm)), arm_(arm) {}

Vec3 ArmMechanism::tip(const AxisPositions& positions) const {
    return arm::base_T_tool(arm_, positions).translation();
}

kinematics::Jacobian ArmMechanism::jacobian(const AxisPositions& positions) const {
    return arm::arm_jacobian(arm_, positions);
}

double ArmMechanism::sliding(const AxisPositions& positions, const AxisPositions& change) const {
    return (jacobian(positions).topRows<3>() * change).norm();
}

} // namespace millwright::motion::internal
