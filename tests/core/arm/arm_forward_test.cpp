#include "core/arm/arm_forward.h"

#include "core/base/error.h"
#include "tests/support/arms.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace millwright::arm {
namespace {

struct KnownPose {
    std::array<double, 5> degrees;
    Mat3 rotation;
    Vec3 wrist;
};

Mat3 rows(std::array<double, 9> r) {
    Mat3 result;
    result << r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8];
    return result;
}

/// Worked out apart from this program, from the closed forms of Saengsasri, Nittayachin 1996, section 1.
const std::vector<KnownPose> known_poses{
    {{0, -90, 90, 0, 0}, rows({1, 0, 0, 0, 1, 0, 0, 0, 1}), {800, 0, 650}},
    {{0, -90, 90, 90, 0}, rows({0, 0, 1, 0, 1, 0, -1, 0, 0}), {800, 0, 650}},
    {{0, 0, 0, 0, 0}, rows({1, 0, 0, 0, 1, 0, 0, 0, 1}), {1450, 0, 0}},
    {{30, -60, 80, 20, 45},
     rows({0.115551, -0.822658, 0.556670, 0.883210, 0.341535, 0.321394, -0.454519, 0.454519, 0.766044}),
     {932.496401, 538.377048, 289.300398}},
    {{-45, -100, 120, -30, 10},
     rows({0.808573, 0.575442, -0.122788, -0.562997, 0.817287, 0.122788, 0.171010, -0.030154, 0.984808}),
     {451.758347, -451.758347, 366.508925}},
    {{90, -30, 45, 60, -90},
     rows({1.0, 0.0, 0.0, 0.0, 0.258819, 0.965926, 0.0, -0.965926, 0.258819}),
     {0.0, 1335.657173, 117.944764}},
    {{120, -75, 100, 65, 170},
     rows({-0.150384, 0.852869, -0.5, -0.086824, 0.492404, 0.866025, 0.984808, 0.173648, 0.0}),
     {-446.639304, 773.601968, 289.757178}},
    {{-170, -20, 60, -10, -35},
     rows({-0.798230, -0.346941, -0.492404, 0.441675, -0.892964, -0.086824, -0.409576, -0.286788, 0.866025}),
     {-1205.045981, -212.482120, -291.916995}}};

TEST(ArmForwardK1, BringsTheL3ToKnownPoses) {
    const ArmModel arm = test::arm("motoman-l3");
    for (const KnownPose& pose : known_poses) {
        const auto& q = pose.degrees;
        const Frame tool = base_T_tool(arm, test::degrees({q[0], q[1], q[2], q[3], q[4]}));
        EXPECT_LT((tool.linear() - pose.rotation).cwiseAbs().maxCoeff(), 1e-6);
        EXPECT_LT((tool.translation() - pose.wrist).cwiseAbs().maxCoeff(), 1e-6);
    }
}

/// Craig's matrix of a link, written out.
Eigen::Matrix4d craig(const ArmJoint& joint, double q) {
    const bool turns = joint.kind == JointKind::revolute;
    const double t = joint.theta + (turns ? q : 0.0), d = joint.d + (turns ? 0.0 : q);
    const double ca = std::cos(joint.alpha), sa = std::sin(joint.alpha), ct = std::cos(t), st = std::sin(t);
    Eigen::Matrix4d m;
    m << ct, -st, 0, joint.a, st * ca, ct * ca, -sa, -d * sa, st * sa, ct * sa, ca, d * ca, 0, 0, 0, 1;
    return m;
}

class AnyArm : public ::testing::TestWithParam<const char*> {
protected:
    ArmModel arm_ = test::with_tool(test::arm(GetParam()), 75.0);
    std::mt19937 random_{1996};
};

TEST_P(AnyArm, K1MultipliesTheMatricesOfItsLinks) {
    for (int n = 0; n < 1000; ++n) {
        const JointPositions q = test::random_joints(random_, arm_);
        Eigen::Matrix4d product = Eigen::Matrix4d::Identity();
        const auto frames = base_T_joints(arm_, q);
        for (int joint = 0; joint < arm_.joint_count(); ++joint) {
            product = (product * craig(arm_.joint(joint), q[joint])).eval();
            EXPECT_LT((frames[static_cast<std::size_t>(joint)].matrix() - product).cwiseAbs().maxCoeff(),
                      1e-9);
        }
        product.col(3) += 75.0 * product.col(2);
        EXPECT_LT((base_T_tool(arm_, q).matrix() - product).cwiseAbs().maxCoeff(), 1e-9);
    }
}

TEST_P(AnyArm, K7HasAJacobianThatAgreesWithDifferences) {
    constexpr double h = 1e-5;
    for (int n = 0; n < 200; ++n) {
        const JointPositions q = test::random_joints(random_, arm_, 0.99);
        const ArmJacobian jacobian = arm_jacobian(arm_, q);
        for (int joint = 0; joint < arm_.joint_count(); ++joint) {
            JointPositions low = q, high = q;
            low[joint] -= h;
            high[joint] += h;
            const Frame a = base_T_tool(arm_, low), b = base_T_tool(arm_, high);
            const Vec3 velocity = (b.translation() - a.translation()) / (2.0 * h);
            const Mat3 spin =
                (b.linear() - a.linear()) / (2.0 * h) * base_T_tool(arm_, q).linear().transpose();
            const Vec3 turning(spin(2, 1), spin(0, 2), spin(1, 0));
            EXPECT_LT((jacobian.col(joint).head<3>() - velocity).norm(), 1e-6);
            EXPECT_LT((jacobian.col(joint).tail<3>() - turning).norm(), 1e-8);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, AnyArm, ::testing::Values("motoman-l3", "six-axis", "scara"));

TEST(ArmJacobianOfTheL3K7, HasTheDeterminantOfItsClosedForm) {
    const ArmModel arm = test::arm("motoman-l3");
    std::mt19937 random(7);
    for (int n = 0; n < 200; ++n) {
        const JointPositions q = test::random_joints(random, arm);
        const double r = 650.0 * std::cos(q[1]) + 800.0 * std::cos(q[1] + q[2]);
        const Mat3 place = arm_jacobian(arm, q).topLeftCorner<3, 3>();
        EXPECT_NEAR(place.determinant(), r * 650.0 * 800.0 * std::sin(q[2]), 1e-3);
    }
}

TEST(Manipulability, FallsToNothingWhereTheArmIsStretched) {
    const ArmModel arm = test::arm("motoman-l3");
    const double length = stretched_length(arm);
    EXPECT_DOUBLE_EQ(length, 1450.0);
    const double bent = manipulability(arm_jacobian(arm, test::degrees({0, -90, 90, 30, 0})), length);
    const double stretched = manipulability(arm_jacobian(arm, test::degrees({0, -40, 0, 30, 0})), length);
    EXPECT_GT(bent, 0.01);
    EXPECT_LT(stretched, 1e-12);
}

TEST(ArmForwardK1, RefusesPositionsThatAreNone) {
    const ArmModel arm = test::arm("motoman-l3");
    EXPECT_THROW((void)base_T_tool(arm, JointPositions::Zero(4)), Defect);
    JointPositions q = JointPositions::Zero(5);
    q[2] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)base_T_tool(arm, q), Defect);
}

} // namespace
} // namespace millwright::arm
