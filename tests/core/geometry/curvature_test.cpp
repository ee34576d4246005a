#include "core/geometry/presets.h"
#include "core/geometry/surface_point.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::geometry {
namespace {

/// z = (a x^2 + b y^2) / 2 over [-1, 1]^2, exactly.
BezierPatch paraboloid(double a, double b) {
    ControlNet net = ControlNet::sized(3, 3);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double x2 = i == 1 ? -1.0 : 1.0; // Bezier ordinates of x^2 on [-1, 1]
            const double y2 = j == 1 ? -1.0 : 1.0;
            net.point(i, j) = Vec3(i - 1.0, j - 1.0, (a * x2 + b * y2) / 2.0);
        }
    }
    return BezierPatch(net);
}

TEST(Curvature, OfAParaboloidAtItsTopIsThatOfItsParabolas) {
    const auto found = principal_curvatures(paraboloid(-0.3, 0.8).derivatives(0.5, 0.5));
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->k1, 0.8, 1e-12);
    EXPECT_NEAR(found->k2, -0.3, 1e-12);
}

TEST(Curvature, OfASurfaceOfHeightsIsThatOfTheClosedForm) {
    const double a = 0.7;
    const double b = 0.2;
    const double x = 0.4;
    const double y = -0.6;
    const auto found = principal_curvatures(paraboloid(a, b).derivatives((x + 1.0) / 2.0, (y + 1.0) / 2.0));
    ASSERT_TRUE(found.has_value());
    const double p = a * x;
    const double q = b * y;
    const double s = 1.0 + p * p + q * q;
    EXPECT_NEAR(found->k1 * found->k2, a * b / (s * s), 1e-12);
    EXPECT_NEAR(found->k1 + found->k2, ((1.0 + q * q) * a + (1.0 + p * p) * b) / std::pow(s, 1.5), 1e-12);
}

TEST(Curvature, OfARationalCylinderIsOneOverItsRadiusAndZero) {
    const double w = std::sqrt(0.5); // a quarter circle
    ControlNet net = ControlNet::sized(3, 2);
    for (int j = 0; j < 2; ++j) {
        net.point(0, j) = Vec3(5.0, 10.0 * j, 0.0);
        net.point(1, j) = Vec3(5.0, 10.0 * j, 5.0);
        net.point(2, j) = Vec3(0.0, 10.0 * j, 5.0);
        net.weight(1, j) = w;
    }
    const BezierPatch cylinder(net);
    for (const double u : {0.0, 0.3, 0.9}) {
        const auto found = principal_curvatures(cylinder.derivatives(u, 0.4));
        ASSERT_TRUE(found.has_value());
        EXPECT_NEAR(std::max(std::abs(found->k1), std::abs(found->k2)), 0.2, 1e-10);
        EXPECT_NEAR(found->k1 * found->k2, 0.0, 1e-10);
    }
}

TEST(Curvature, OfTangentsThatVanishIsNothing) {
    ControlNet net = ControlNet::sized(2, 2);
    net.point(1, 0) = net.point(1, 1) = Vec3(1.0, 0.0, 0.0);
    net.point(0, 1) = net.point(0, 0);
    EXPECT_FALSE(principal_curvatures(BezierPatch(net).derivatives(0.5, 0.5)).has_value());
}

} // namespace
} // namespace millwright::geometry
