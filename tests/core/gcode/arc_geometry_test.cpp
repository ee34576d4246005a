#include "core/base/units.h"
#include "core/gcode/canon.h"
#include "core/gcode/internal/plane_geometry.h"
#include "core/gcode/internal/refusal.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::gcode::internal {
namespace {

TEST(ArcGeometry, CentreFromRadiusLiesAtItsDistanceOnTheRightSide) {
    std::mt19937 random(68);
    std::uniform_real_distribution<double> place(-50.0, 50.0);
    std::uniform_real_distribution<double> factor(1.001, 4.0);
    for (int n = 0; n < 2000; ++n) {
        const Vec2 start(place(random), place(random));
        const Vec2 end(place(random), place(random));
        const double radius = 0.5 * (end - start).norm() * factor(random);
        for (const double r : {radius, -radius}) {
            for (const int turns : {1, -1}) {
                const Vec2 centre = centre_from_radius(start, end, r, turns, 0.001, 1);
                ASSERT_NEAR((centre - start).norm(), radius, 1e-9);
                ASSERT_NEAR((centre - end).norm(), radius, 1e-9);
                const double sweep = sweep_of(start, end, centre, turns);
                ASSERT_EQ(sweep > 0.0, turns > 0);
                ASSERT_EQ(std::abs(sweep) < pi, r > 0.0);
            }
        }
    }
}

TEST(ArcGeometry, SweepCountsWholeTurns) {
    const Vec2 start(1.0, 0.0);
    const Vec2 end(0.0, 1.0);
    const Vec2 centre(0.0, 0.0);
    EXPECT_NEAR(sweep_of(start, end, centre, 1), 0.5 * pi, 1e-12);
    EXPECT_NEAR(sweep_of(start, end, centre, 3), 4.5 * pi, 1e-12);
    EXPECT_NEAR(sweep_of(start, end, centre, -1), -1.5 * pi, 1e-12);
    EXPECT_NEAR(sweep_of(start, start, centre, 1), 2.0 * pi, 1e-12);
    EXPECT_NEAR(sweep_of(start, start, centre, -2), -4.0 * pi, 1e-12);
}

TEST(ArcGeometry, AHairIsAFullTurn) {
    const Vec2 centre(0.0, 0.0);
    const Vec2 start(10.0, 0.0);
    for (const double angle : {1e-12, 1e-9, 0.9 * hair_sweep}) {
        const Vec2 end(10.0 * std::cos(angle), 10.0 * std::sin(angle));
        EXPECT_GT(sweep_of(start, end, centre, 1), 6.0) << angle;
        EXPECT_LT(sweep_of(end, start, centre, -1), -6.0) << angle;
    }
    const Vec2 further(10.0 * std::cos(1e-4), 10.0 * std::sin(1e-4));
    EXPECT_NEAR(sweep_of(start, further, centre, 1), 1e-4, 1e-9);
}

TEST(ArcGeometry, RefusesWhatHasNoCircle) {
    const test::WithoutTraps numbers_that_are_none;
    const ArcTolerances within = arc_tolerances(LengthUnit::mm, Dialect::linuxcnc);
    const Vec2 o(0.0, 0.0);
    EXPECT_THROW(check_centre({1, 0}, {0, 2}, o, within, Plane::xy, 1), Refusal);
    EXPECT_THROW(check_centre(o, o, o, within, Plane::xy, 1), Refusal);
    EXPECT_THROW(check_centre({2e6, 0}, {0, 2e6}, o, within, Plane::xy, 1), Refusal);
    EXPECT_THROW(check_centre({std::nan(""), 0}, {0, 1}, o, within, Plane::xy, 1), Refusal);
    EXPECT_NO_THROW(check_centre({10.0, 0}, {0, 10.005}, o, within, Plane::xy, 1));
    EXPECT_THROW(static_cast<void>(centre_from_radius(o, {10, 0}, 4.9, 1, 0.001, 1)), Refusal);
    EXPECT_THROW(static_cast<void>(centre_from_radius(o, o, 4.9, 1, 0.001, 1)), Refusal);
    EXPECT_THROW(static_cast<void>(centre_from_radius(o, {1e-6, 0}, 100.0, 1, 0.001, 1)), Refusal);
}

TEST(ArcGeometry, GrblTakesMoreOfLargeArcs) {
    const ArcTolerances within = arc_tolerances(LengthUnit::mm, Dialect::grbl);
    const Vec2 o(0.0, 0.0);
    EXPECT_NO_THROW(check_centre({300.0, 0}, {0, 300.2}, o, within, Plane::xy, 1));
    EXPECT_NO_THROW(check_centre({1.0, 0}, {0, 1.004}, o, within, Plane::xy, 1));
    EXPECT_THROW(check_centre({1.0, 0}, {0, 1.1}, o, within, Plane::xy, 1), Refusal);
}

} // namespace
} // namespace millwright::gcode::internal
