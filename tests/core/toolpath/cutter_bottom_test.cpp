#include "core/base/units.h"
#include "core/toolpath/internal/tool_curve.h"
#include "tests/support/cutters.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace millwright::toolpath {
namespace {

double height_of(const Vec3& point, const BentGround& ground) {
    const Vec3 from = point - ground.point;
    return from.dot(ground.normal) - 0.5 * from.dot(ground.bend * from);
}

/// By looking at very many points of the disc.
double least_by_looking(const Vec3& middle, const Vec3& axis, double radius, const BentGround& ground) {
    const Vec3 e1 = axis.unitOrthogonal();
    const Vec3 e2 = axis.cross(e1);
    double least = height_of(middle, ground);
    for (int ring = 1; ring <= 100; ++ring) {
        for (int k = 0; k < 720; ++k) {
            const double angle = from_degrees(0.5 * k);
            const double rho = radius * ring / 100.0;
            const Vec3 point = middle + rho * (std::cos(angle) * e1 + std::sin(angle) * e2);
            least = std::min(least, height_of(point, ground));
        }
    }
    return least;
}

TEST(CutterBottom, LeastHeightOfADiscIsThatOfVeryManyOfItsPoints) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int n = 0; n < 60; ++n) {
        const Vec3 across = Vec3(any(random), any(random), 0.0);
        Mat3 bend = Mat3::Zero(); // of all kinds: hollow, round, saddle, along one direction only
        bend(0, 0) = n % 4 == 0 ? 0.0 : 0.1 * any(random);
        bend(1, 1) = 0.1 * any(random);
        bend(0, 1) = bend(1, 0) = n % 3 == 0 ? 0.0 : 0.05 * any(random);
        const BentGround ground{Vec3(any(random), any(random), any(random)), Vec3::UnitZ(), bend};
        const double leans = n % 5 == 0 ? 0.0 : n % 5 == 1 ? 0.3 : 0.02;
        const Vec3 axis = (Vec3::UnitZ() + leans * across).normalized();
        const Vec3 middle = ground.point + Vec3(any(random), any(random), any(random));
        const double least = least_height(middle, axis, 5.0, ground);
        const double looked = least_by_looking(middle, axis, 5.0, ground);
        EXPECT_LE(least, looked + 1e-9) << n;
        EXPECT_NEAR(least, looked, 1e-3) << n;
    }
}

/// Across a valley both sides of the disc are alike, but for rounding.
TEST(CutterBottom, LeastHeightInAValleyDoesNotHangOnTheLastBits) {
    const Mat3 valley = Vec3(0.08, -0.02, 0.0).asDiagonal().toDenseMatrix();
    for (const double slope : {0.0, 1e-18, -1e-17, 1e-16, 1e-15, 1e-12}) {
        for (const double away : {0.0, 0.4, -0.4}) {
            const BentGround ground{Vec3::Zero(), Vec3(slope, 0.0, 1.0).normalized(), valley};
            const Vec3 middle(0.0, away, 1.0);
            const double least = least_height(middle, Vec3::UnitZ(), 5.0, ground);
            EXPECT_NEAR(least, least_by_looking(middle, Vec3::UnitZ(), 5.0, ground), 1e-4) << slope;
        }
    }
}

TEST(CutterBottom, LeastHeightOfAPointIsItsOwn) {
    const BentGround ground{Vec3::Zero(), Vec3::UnitZ(), -0.1 * Vec3(1, 1, 0).asDiagonal().toDenseMatrix()};
    EXPECT_NEAR(least_height({2, 0, 1}, Vec3::UnitZ(), 0.0, ground), 1.0 + 0.05 * 4.0, 1e-12);
}

/// What points of the surface are off the second order is of the fourth: the third cancels between two sides.
TEST(CutterBottom, BendOfASurfaceIsItsSecondOrder) {
    const auto patch = test::patch("two-bell");
    for (const auto& [u, v] : {std::pair{0.3, 0.4}, {0.62, 0.21}, {0.8, 0.75}}) {
        const geometry::SurfaceDerivatives at = patch.derivatives(u, v);
        for (const double side : {1.0, -1.0}) {
            const Vec3 normal = side * patch.unit_normal(at).value();
            const BentGround ground{at.position, normal, bend_of(at, normal, 0.0)};
            const BentGround plane{at.position, normal};
            for (const Vec2& way : {Vec2(1e-3, 0), Vec2(0, 1e-3), Vec2(1e-3, 1e-3), Vec2(1e-3, -2e-3)}) {
                const Vec3 ahead = patch.position(u + way.x(), v + way.y());
                const Vec3 behind = patch.position(u - way.x(), v - way.y());
                const double second = height_of(ahead, plane) + height_of(behind, plane);
                const double fourth = height_of(ahead, ground) + height_of(behind, ground);
                EXPECT_LT(std::abs(fourth), 1e-3 * std::abs(second));
            }
        }
    }
}

/// A sphere of 30 mm seen from outside bends away as one of 34 mm 4 mm off it; from inside as one of 26 mm.
TEST(CutterBottom, BendIsThatOfTheSurfaceFurtherOut) {
    geometry::SurfaceDerivatives at; // at the top of the sphere
    at.du = {30, 0, 0};
    at.dv = {0, 60, 0};
    at.duu = {0, 0, -30};
    at.dvv = {0, 0, -120};
    const Mat3 outside = bend_of(at, Vec3::UnitZ(), 4.0);
    const Mat3 inside = bend_of(at, -Vec3::UnitZ(), 4.0);
    for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(outside(k, k), -1.0 / 34.0, 1e-12);
        EXPECT_NEAR(inside(k, k), 1.0 / 26.0, 1e-12);
    }
    EXPECT_TRUE(bend_of(at, -Vec3::UnitZ(), 50.0).allFinite()); // a ball that does not fit in
    at.dvv = {0, 0, 1200};                                      // a saddle: sharp where it is round
    EXPECT_NEAR(bend_of(at, Vec3::UnitZ(), 2.0)(0, 0), -1.0 / 32.0, 1e-12);
    EXPECT_NEAR(bend_of(at, -Vec3::UnitZ(), 20.0)(1, 1), -1.0 / 23.0, 1e-12);
}

/// The middle of the bottom of a leaning cutter keeps the same distances from its contact.
TEST(CutterBottom, MiddleIsWhereTheDiscIs) {
    const Vec3 normal = Vec3(0.2, -0.1, 1.0).normalized();
    const Vec3 axis = Vec3(-0.1, 0.3, 1.0).normalized();
    for (const auto& shape : {test::flat_end, test::bull_nose, test::ball}) {
        const Tool tool{.cutter = test::body(shape)};
        const geometry::ToolPose pose{tip_for(*tool.cutter, {1, 2, 3}, normal, axis), axis};
        const CutterBottom bottom = bottom_of(tool);
        const Vec3 from_contact = bottom.middle(pose) - (Vec3(1, 2, 3) + bottom.corner * normal);
        EXPECT_NEAR(from_contact.norm(), bottom.disc, 1e-12);
        EXPECT_NEAR(from_contact.dot(axis), 0.0, 1e-12);
    }
}

} // namespace
} // namespace millwright::toolpath
