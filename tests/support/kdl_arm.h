// An arm as Orocos KDL sees it.
#pragma once

#include "core/arm/arm_forward.h"

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include <optional>

namespace millwright::test {

class KdlArm {
public:
    explicit KdlArm(const arm::ArmModel& arm)
        : chain_(chain_of(arm)), forward_(chain_), jacobian_(chain_),
          inverse_(chain_, weights(), 1e-12, 2000) {}

    [[nodiscard]] Frame forward(const arm::JointPositions& q) {
        KDL::Frame frame;
        forward_.JntToCart(array_of(q), frame);
        return frame_of(frame);
    }
    [[nodiscard]] arm::ArmJacobian jacobian(const arm::JointPositions& q) {
        KDL::Jacobian found(static_cast<unsigned>(q.size()));
        jacobian_.JntToJac(array_of(q), found);
        return found.data;
    }
    /// By KDL's Levenberg-Marquardt; nothing if it does not converge.
    [[nodiscard]] std::optional<arm::JointPositions> inverse(const Frame& goal,
                                                             const arm::JointPositions& start) {
        KDL::JntArray found(static_cast<unsigned>(start.size()));
        if (inverse_.CartToJnt(array_of(start), kdl_of(goal), found) < 0) {
            return std::nullopt;
        }
        return arm::JointPositions(found.data);
    }

private:
    /// A metre counts as much as a radian.
    static Eigen::Matrix<double, 6, 1> weights() {
        Eigen::Matrix<double, 6, 1> found;
        found << 1e-3, 1e-3, 1e-3, 1.0, 1.0, 1.0;
        return found;
    }
    static KDL::JntArray array_of(const arm::JointPositions& q) {
        KDL::JntArray array(static_cast<unsigned>(q.size()));
        array.data = q;
        return array;
    }
    static Frame frame_of(const KDL::Frame& frame) {
        Frame result = Frame::Identity();
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                result.linear()(row, column) = frame.M(row, column);
            }
            result.translation()[row] = frame.p(row);
        }
        return result;
    }
    static KDL::Frame kdl_of(const Frame& frame) {
        const Mat3 r = frame.linear();
        const Vec3 p = frame.translation();
        return {
            KDL::Rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
            KDL::Vector(p.x(), p.y(), p.z())};
    }
    /// What stands before a joint is the end of the segment before it.
    static KDL::Chain chain_of(const arm::ArmModel& arm) {
        using arm::JointKind;
        const auto before = [&](int n) {
            return KDL::Frame(KDL::Rotation::RotX(arm.joint(n).alpha)) *
                   KDL::Frame(KDL::Vector(arm.joint(n).a, 0.0, 0.0));
        };
        KDL::Chain chain;
        chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), before(0)));
        for (int n = 0; n < arm.joint_count(); ++n) {
            const auto& joint = arm.joint(n);
            const KDL::Joint moved(joint.kind == JointKind::revolute ? KDL::Joint::RotZ : KDL::Joint::TransZ);
            KDL::Frame rest = KDL::Frame(KDL::Rotation::RotZ(joint.theta), KDL::Vector(0.0, 0.0, joint.d));
            if (n + 1 < arm.joint_count()) {
                rest = rest * before(n + 1);
            } else {
                const arm::ArmDescription& of = arm.description();
                const Vec3& tip = of.tool_tip;
                rest = rest * KDL::Frame(KDL::Rotation::RotX(of.end_alpha), KDL::Vector(of.end_a, 0.0, 0.0)) *
                       KDL::Frame(KDL::Vector(tip.x(), tip.y(), tip.z()));
            }
            chain.addSegment(KDL::Segment(moved, rest));
        }
        return chain;
    }

    KDL::Chain chain_;
    KDL::ChainFkSolverPos_recursive forward_;
    KDL::ChainJntToJacSolver jacobian_;
    KDL::ChainIkSolverPos_LMA inverse_;
};

} // namespace millwright::test
