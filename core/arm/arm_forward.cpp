#include "core/arm/arm_forward.h"

#include "core/base/error.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace millwright::arm {

namespace {

/// Carries a frame from joint to joint. The link transform is Rx(alpha) Dx(a) Rz(theta) Dz(d).
class Carried {
public:
    void step(const ArmJoint& joint, double position) {
        const bool turns = joint.kind == JointKind::revolute;
        const double theta = joint.theta + (turns ? position : 0.0);
        const double d = joint.d + (turns ? 0.0 : position);
        const double ca = std::cos(joint.alpha), sa = std::sin(joint.alpha);
        const double ct = std::cos(theta), st = std::sin(theta);
        origin += joint.a * x;
        const Vec3 middle = ca * y + sa * z; // y after the twist
        z = ca * z - sa * y;
        y = ct * middle - st * x;
        x = ct * x + st * middle;
        origin += d * z;
    }

    /// Behind the last joint.
    void end(const ArmDescription& arm) {
        const double ca = std::cos(arm.end_alpha), sa = std::sin(arm.end_alpha);
        origin += arm.end_a * x;
        const Vec3 twisted = ca * y + sa * z;
        z = ca * z - sa * y;
        y = twisted;
    }

    [[nodiscard]] Vec3 point(const Vec3& local) const {
        return origin + local.x() * x + local.y() * y + local.z() * z;
    }
    [[nodiscard]] Frame frame_at(const Vec3& place) const {
        Frame frame = Frame::Identity();
        frame.linear() << x, y, z;
        frame.translation() = place;
        return frame;
    }

    Vec3 origin = Vec3::Zero();
    Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
};

void expect_positions(const ArmModel& arm, const JointPositions& positions) {
    expects(positions.size() == arm.joint_count() && positions.allFinite(), "a position for every joint");
}

} // namespace

Frame base_T_tool(const ArmModel& arm, const JointPositions& positions) {
    expect_positions(arm, positions);
    Carried carried;
    for (int n = 0; n < arm.joint_count(); ++n) {
        carried.step(arm.joint(n), positions[n]);
    }
    carried.end(arm.description());
    return carried.frame_at(carried.point(arm.description().tool_tip));
}

std::vector<Frame> base_T_joints(const ArmModel& arm, const JointPositions& positions) {
    expect_positions(arm, positions);
    std::vector<Frame> frames;
    Carried carried;
    for (int n = 0; n < arm.joint_count(); ++n) {
        carried.step(arm.joint(n), positions[n]);
        frames.push_back(carried.frame_at(carried.origin));
    }
    return frames;
}

ArmJacobian arm_jacobian(const ArmModel& arm, const JointPositions& positions) {
    expect_positions(arm, positions);
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 9> places(3, arm.joint_count());
    ArmJacobian jacobian(6, arm.joint_count());
    Carried carried;
    for (int n = 0; n < arm.joint_count(); ++n) {
        carried.step(arm.joint(n), positions[n]);
        places.col(n) = carried.origin;
        jacobian.col(n).tail<3>() = carried.z;
    }
    carried.end(arm.description());
    const Vec3 tip = carried.point(arm.description().tool_tip);
    for (int n = 0; n < arm.joint_count(); ++n) {
        const Vec3 z = jacobian.col(n).tail<3>();
        if (arm.joint(n).kind == JointKind::revolute) {
            jacobian.col(n).head<3>() = z.cross(tip - places.col(n));
        } else {
            jacobian.col(n).head<3>() = z;
            jacobian.col(n).tail<3>().setZero();
        }
    }
    return jacobian;
}

double manipulability(const ArmJacobian& jacobian, double length_mm) {
    expects(length_mm > 0.0, "a length to compare with");
    ArmJacobian scaled = jacobian;
    scaled.topRows<3>() /= length_mm;
    return Eigen::JacobiSVD<Eigen::MatrixXd>(scaled).singularValues().prod();
}

double stretched_length(const ArmModel& arm) {
    double length = arm.description().tool_tip.norm() + std::abs(arm.description().end_a);
    for (const ArmJoint& joint : arm.description().joints) {
        const bool slides =
            joint.kind == JointKind::prismatic && std::isfinite(joint.min) && std::isfinite(joint.max);
        const double offset = slides ? std::max(std::abs(joint.d + joint.min), std::abs(joint.d + joint.max))
                                     : std::abs(joint.d);
        length += std::abs(joint.a) + offset;
    }
    return length;
}

} // namespace millwright::arm
