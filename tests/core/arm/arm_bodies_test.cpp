#include "core/arm/arm_bodies.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "tests/support/arms.h"

#include <gtest/gtest.h>

namespace millwright::arm {
namespace {

constexpr double near_mm = 1e-9;

const ArmPart& part_of(const ArmFile& file, ArmCarrier carrier, int number) {
    const auto& parts = file.bodies->parts;
    const auto found = std::ranges::find_if(
        parts, [&](const ArmPart& part) { return part.carrier == carrier && part.number == number; });
    EXPECT_NE(found, parts.end());
    return *found;
}

class ArmBodiesTest : public ::testing::Test {
protected:
    ArmFile file_ = read_arm("assets/arms/motoman-l3.json");
    std::mt19937 random_{3};

    JointPositions any_joints() {
        JointPositions q(5);
        for (int n = 0; n < 5; ++n) {
            q[n] = std::uniform_real_distribution<double>(file_.arm.joint(n).min,
                                                          file_.arm.joint(n).max)(random_);
        }
        return q;
    }
    Frame place(ArmCarrier carrier, int number, const JointPositions& q) {
        return base_T_parts(file_.arm, file_.actuators, {part_of(file_, carrier, number)}, q).front();
    }
};

TEST_F(ArmBodiesTest, OfJointsAreWhereForwardKinematicsHasTheJoints) {
    for (int n = 0; n < 200; ++n) {
        const JointPositions q = any_joints();
        const std::vector<Frame> joints = base_T_joints(file_.arm, q);
        for (int joint = 0; joint < 5; ++joint) {
            const Frame body = place(ArmCarrier::joint, joint, q);
            EXPECT_TRUE(body.isApprox(joints[static_cast<std::size_t>(joint)], 1e-12));
        }
        const Frame tool = base_T_tool(file_.arm, q);
        EXPECT_LT(
            (place(ArmCarrier::joint, 4, q) * file_.arm.description().tool_tip - tool.translation()).norm(),
            near_mm);
    }
}

// The drives' lengths come from the law of cosines in arm_actuators, their bodies from points in space.
TEST_F(ArmBodiesTest, OfDrivesAreAsLongAsTheDrivesAre) {
    for (int n = 0; n < 500; ++n) {
        const JointPositions q = any_joints();
        const DrivePositions counts = drives_of(*file_.actuators, q);
        for (const int drive : {2, 3}) {
            const DriveScale& scale = file_.actuators->scales[static_cast<std::size_t>(drive) - 1];
            const double length = scale.scale * counts[drive - 1] + scale.offset;
            const Frame cylinder = place(ArmCarrier::cylinder, drive, q);
            const Frame rod = place(ArmCarrier::rod, drive, q);
            EXPECT_NEAR((rod.translation() - cylinder.translation()).norm(), length, 1e-7) << drive;
            EXPECT_LT((cylinder * Vec3(0.0, 0.0, length) - rod.translation()).norm(), 1e-7);
            EXPECT_TRUE(rod.linear().isApprox(cylinder.linear(), 1e-12));
        }
    }
}

// Where they are pinned together, two bodies have one place.
TEST_F(ArmBodiesTest, StayPinnedTogether) {
    const Linkage &second = file_.actuators->second, &third = file_.actuators->third;
    const Vec3 lever_2 = second.beta * Vec3(std::cos(second.omega), -std::sin(second.omega), 0.0);
    const Vec3 behind(-third.beta, 0.0, 0.0), elbow(file_.arm.planar_elbow()->upper_arm, 0.0, 0.0);
    for (int n = 0; n < 200; ++n) {
        const JointPositions q = any_joints();
        const Frame upper = place(ArmCarrier::joint, 1, q), fore = place(ArmCarrier::joint, 2, q);
        const Frame lever = place(ArmCarrier::lever, 3, q), coupler = place(ArmCarrier::coupler, 3, q);
        EXPECT_LT((place(ArmCarrier::rod, 2, q).translation() - upper * lever_2).norm(), near_mm);
        EXPECT_LT((place(ArmCarrier::rod, 3, q).translation() - lever * behind).norm(), near_mm);
        EXPECT_LT((coupler.translation() - lever * behind).norm(), near_mm);
        EXPECT_LT((coupler * elbow - fore * behind).norm(), near_mm); // a parallelogram
    }
}

TEST_F(ArmBodiesTest, OfDrivesAreFixedToTheColumn) {
    const JointPositions q = test::degrees({30, -100, 80, 10, 0}),
                         other = test::degrees({30, -60, 40, 0, 90});
    for (const int drive : {2, 3}) {
        EXPECT_LT((place(ArmCarrier::cylinder, drive, q).translation() -
                   place(ArmCarrier::cylinder, drive, other).translation())
                      .norm(),
                  near_mm);
    }
}

TEST_F(ArmBodiesTest, AreReadFromTheirFile) {
    const auto bodies = read_bodies(*file_.bodies);
    ASSERT_EQ(bodies.size(), file_.bodies->parts.size());
    for (std::size_t n = 0; n < bodies.size(); ++n) {
        EXPECT_EQ(bodies[n].name, file_.bodies->parts[n].node);
        EXPECT_FALSE(bodies[n].meshes.empty());
    }
}

TEST_F(ArmBodiesTest, SayWhichIsMissing) {
    ArmBodies bodies = *file_.bodies;
    bodies.parts[0].node = "tail";
    try {
        (void)read_bodies(bodies);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().message, "there is no node 'tail' with triangles");
    }
    bodies.file = "no.glb";
    EXPECT_THROW((void)read_bodies(bodies), Error);
}

TEST_F(ArmBodiesTest, OfDrivesNeedDrives) {
    EXPECT_THROW(
        (void)base_T_parts(file_.arm, std::nullopt, {{"rod", ArmCarrier::rod, 2}}, JointPositions::Zero(5)),
        Defect);
}

} // namespace
} // namespace millwright::arm
