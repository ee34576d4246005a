// The thesis's machine against reference values computed with an independent program.
#include "core/kinematics/rotary_tilt.h"

#include "core/base/units.h"
#include "core/geometry/presets.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/inverse.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <array>

namespace millwright::kinematics {
namespace {

struct ThesisSet {
    RotaryTilt constants;
    const char* file;
};

class RotaryTiltSets : public ::testing::TestWithParam<ThesisSet> {};

// T5.
TEST_P(RotaryTiltSets, ListedInverseUndoesForward) {
    std::mt19937 random(1997);
    for (int n = 0; n < 1000; ++n) {
        const Vec3 p = test::random_point(random, 100.0);
        const Vec3 angles = test::random_point(random, pi);
        const Vec3 M = machine_from_workpiece(GetParam().constants, p, angles.x(), angles.y());
        EXPECT_LT((workpiece_from_machine(GetParam().constants, M, angles.x(), angles.y()) - p).norm(),
                  round_trip_mm);
    }
}

TEST_P(RotaryTiltSets, TheChainOfTheMachineFileEqualsTheClosedForm) {
    const MachineModel machine = test::machine(GetParam().file);
    ASSERT_EQ(machine.axis_count(), 5);
    std::mt19937 random(2006);
    for (int n = 0; n < 500; ++n) {
        const Vec3 M = test::random_point(random, 300.0);
        const Vec3 angles = test::random_point(random, pi);
        AxisPositions q(5);
        q << M, angles.x(), angles.y();
        const Vec3 closed = workpiece_from_machine(GetParam().constants, M, angles.x(), angles.y());
        EXPECT_LT((forward(machine, q).tip - closed).norm(), round_trip_mm);
    }
}

INSTANTIATE_TEST_SUITE_P(Thesis,
                         RotaryTiltSets,
                         ::testing::Values(ThesisSet{listing_values, "rotary-tilt-listing"},
                                           ThesisSet{chapter_3_values, "rotary-tilt-chapter3"},
                                           ThesisSet{gui_values, "rotary-tilt-gui"}));

/// The linear part of eqs 4-5 applied to a direction.
Vec3 carried(const Vec3& n, const RotaryTiltAngles& angles) {
    const Vec3 origin = machine_from_workpiece(listing_values, Vec3::Zero(), angles.A, angles.B);
    return machine_from_workpiece(listing_values, n, angles.A, angles.B) - origin;
}

// T6.
TEST(ConsistentAngles, CarryEveryNormalToTheToolAxis) {
    std::mt19937 random(53);
    for (int n = 0; n < 1000; ++n) {
        const Vec3 normal = test::random_upward(random);
        const RotaryTiltAngles angles = rotary_tilt_angles(AngleMode::consistent, normal);
        EXPECT_LT((carried(normal, angles) - Vec3::UnitZ()).norm(), 1e-12) << normal.transpose();
    }
}

TEST(ConsistentAngles, ReproduceTheReferenceTableOfTheDome) {
    struct Row {
        double u, v, A, tilt, B;
        Vec3 M;
    };
    const std::array<Row, 4> table{{
        {0.25, 0.25, -45.000000, -55.449930, 145.449930, {-23.354771, -10.606602, -301.476999}},
        {0.25, 0.75, 39.685454, -53.152627, 143.152627, {-58.164131, -59.548929, -253.267546}},
        {0.75, 0.25, 50.314546, 53.152627, 36.847373, {45.593517, -57.584091, -270.042099}},
        {0.75, 0.75, -45.000000, 50.313665, 39.686335, {90.643652, -10.606602, -216.862570}},
    }};
    const auto dome = geometry::surface_preset("dome").make().patch(geometry::PatchId{0});
    for (const Row& row : table) {
        const Vec3 normal = dome.unit_normal(row.u, row.v).value();
        const RotaryTiltAngles angles = rotary_tilt_angles(AngleMode::consistent, normal);
        EXPECT_NEAR(to_degrees(angles.A), row.A, 1e-6);
        EXPECT_NEAR(to_degrees(angles.B), row.B, 1e-6);
        EXPECT_NEAR(90.0 - to_degrees(angles.B), row.tilt, 1e-6);
        const Vec3 M =
            machine_from_workpiece(listing_values, dome.position(row.u, row.v), angles.A, angles.B);
        EXPECT_LT((M - row.M).cwiseAbs().maxCoeff(), 1e-6);
    }
}

// T6.
TEST(FaultyAngles, DoNotCarryTheNormalToOneDirection) {
    const Vec3 left = Vec3(-0.5, 0.4, 0.7).normalized();
    const Vec3 right = Vec3(0.5, 0.4, 0.7).normalized();
    for (const AngleMode mode : {AngleMode::faulty_text, AngleMode::faulty_listing}) {
        const Vec3 a = carried(left, rotary_tilt_angles(mode, left));
        const Vec3 b = carried(right, rotary_tilt_angles(mode, right));
        EXPECT_GT((a - b).norm(), 0.1);
    }
    // Printed pair for i > 0: the carried axis is (-cos 2t, 0, sin 2t) with t = atan(r/k).
    const double t = std::atan2(std::hypot(right.x(), right.y()), right.z());
    const Vec3 printed = carried(right, rotary_tilt_angles(AngleMode::faulty_text, right));
    EXPECT_LT((printed - Vec3(-std::cos(2 * t), 0.0, std::sin(2 * t))).norm(), 1e-12);
}

TEST(FaultyAngles, ListingSignOfADiffersWhereINegative) {
    const Vec3 normal = Vec3(-0.5, 0.4, 0.7).normalized();
    const double right = rotary_tilt_angles(AngleMode::consistent, normal).A;
    const double faulty = rotary_tilt_angles(AngleMode::faulty_listing, normal).A;
    EXPECT_NEAR(faulty, -right, 1e-15);
    EXPECT_NEAR(carried(normal, rotary_tilt_angles(AngleMode::faulty_listing, normal)).y(),
                2.0 * normal.x() * normal.y() / std::hypot(normal.x(), normal.y()),
                1e-12);
}

TEST(Angles, AreFreeWhereTheNormalIsVertical) {
    for (const AngleMode mode : {AngleMode::consistent, AngleMode::faulty_text, AngleMode::faulty_listing}) {
        EXPECT_TRUE(rotary_tilt_angles(mode, Vec3::UnitZ()).A_is_free);
        EXPECT_FALSE(rotary_tilt_angles(mode, Vec3(0.0, 1.0, 0.0)).A_is_free);
    }
}

} // namespace
} // namespace millwright::kinematics
