#include "core/geometry/bezier_patch.h"

#include "core/base/error.h"
#include "core/geometry/presets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace millwright::geometry {
namespace {

ControlNet random_net_of(int rows, int columns, unsigned seed, bool rational) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
    std::uniform_real_distribution<double> weight(0.3, 3.0);
    ControlNet net = ControlNet::sized(rows, columns);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            net.point(i, j) = {20.0 * i + 0.1 * coordinate(random), 20.0 * j, coordinate(random)};
            net.weight(i, j) = rational ? weight(random) : 1.0;
        }
    }
    return net;
}

// Beside a light control point the tangent is 1e-12 of the patch, and right: it was taken for none.
TEST(BezierPatch, HasANormalBesideLightControlPoints) {
    ControlNet net = ControlNet::sized(4, 4);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            net.point(i, j) = {26.0 * i - 40.0, 26.0 * j - 40.0, i * j * 1.1};
            net.weight(i, j) = (i + j) % 2 == 0 ? 1e6 : 1e-6;
        }
    }
    const BezierPatch patch(net);
    const auto normal = patch.unit_normal(0.0, 0.0); // both tangents lie in the plane z = 0
    ASSERT_TRUE(normal.has_value());
    EXPECT_LT((*normal - Vec3::UnitZ()).norm(), 1e-3);
    net.point(0, 1) = net.point(0, 0); // a side that begins twice at the same place
    net.weight(0, 1) = 1.0;
    EXPECT_FALSE(BezierPatch(net).unit_normal(0.0, 0.0).has_value());
}

/// Eq. 14 with the transpose put back: S = U B P B^T V^T, coordinate by coordinate.
Vec3 matrix_form(const ControlNet& net, double u, double v) {
    Eigen::Matrix4d B;
    B << -1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0;
    const Eigen::RowVector4d U(u * u * u, u * u, u, 1.0);
    const Eigen::Vector4d V(v * v * v, v * v, v, 1.0);
    Vec3 s;
    for (int axis = 0; axis < 3; ++axis) {
        Eigen::Matrix4d P;
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                P(i, j) = net.point(i, j)[axis];
            }
        }
        s[axis] = U * B * P * B.transpose() * V;
    }
    return s;
}

// T2.
TEST(BezierPatch, MatrixFormEqualsBernsteinForm) {
    const ControlNet net = random_net_of(4, 4, 7, false);
    const BezierPatch patch(net);
    for (double u = 0.0; u <= 1.0; u += 0.125) {
        for (double v = 0.0; v <= 1.0; v += 0.125) {
            EXPECT_LT((patch.position(u, v) - matrix_form(net, u, v)).norm(), 1e-12);
        }
    }
}

TEST(BezierPatch, PassesThroughItsCornerPointsExactly) {
    const ControlNet net = random_net_of(5, 3, 11, true);
    const BezierPatch patch(net);
    EXPECT_LT((patch.position(0.0, 0.0) - net.point(0, 0)).norm(), 1e-13);
    EXPECT_LT((patch.position(1.0, 0.0) - net.point(4, 0)).norm(), 1e-13);
    EXPECT_LT((patch.position(0.0, 1.0) - net.point(0, 2)).norm(), 1e-13);
    EXPECT_LT((patch.position(1.0, 1.0) - net.point(4, 2)).norm(), 1e-13);
}

class BezierDerivatives : public ::testing::TestWithParam<std::tuple<int, int, bool>> {};

// T2.
TEST_P(BezierDerivatives, EqualCentralDifferences) {
    const auto [rows, columns, rational] = GetParam();
    const BezierPatch patch(random_net_of(rows, columns, 3, rational));
    constexpr double h = 1e-5;
    const auto near = [](const Vec3& a, const Vec3& b, double tolerance) {
        return (a - b).norm() < tolerance * (1.0 + a.norm());
    };
    for (const double u : {0.0, 0.2, 0.55, 1.0}) {
        for (const double v : {0.0, 0.35, 0.8, 1.0}) {
            const SurfaceDerivatives at = patch.derivatives(u, v);
            const auto east = patch.derivatives(u + h, v);
            const auto west = patch.derivatives(u - h, v);
            const auto north = patch.derivatives(u, v + h);
            const auto south = patch.derivatives(u, v - h);
            EXPECT_TRUE(near(at.du, (east.position - west.position) / (2 * h), 1e-6));
            EXPECT_TRUE(near(at.dv, (north.position - south.position) / (2 * h), 1e-6));
            EXPECT_TRUE(near(at.duu, (east.du - west.du) / (2 * h), 1e-5));
            EXPECT_TRUE(near(at.duv, (north.du - south.du) / (2 * h), 1e-5));
            EXPECT_TRUE(near(at.duv, (east.dv - west.dv) / (2 * h), 1e-5));
            EXPECT_TRUE(near(at.dvv, (north.dv - south.dv) / (2 * h), 1e-5));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         BezierDerivatives,
                         ::testing::Combine(::testing::Values(2, 3, 4, 7),
                                            ::testing::Values(2, 4, 6),
                                            ::testing::Bool()));

TEST(BezierPatch, ARationalPatchOfDegreeTwoIsExactlyACylinder) {
    const double w = std::sqrt(0.5);
    ControlNet net = ControlNet::sized(3, 2);
    for (int j = 0; j < 2; ++j) {
        net.point(0, j) = {10.0, 0.0, 5.0 * j};
        net.point(1, j) = {10.0, 10.0, 5.0 * j};
        net.point(2, j) = {0.0, 10.0, 5.0 * j};
        net.weight(1, j) = w;
    }
    const BezierPatch patch(net);
    EXPECT_TRUE(patch.rational());
    for (double u = 0.0; u <= 1.0; u += 0.1) {
        const Vec3 p = patch.position(u, 0.4);
        EXPECT_NEAR(std::hypot(p.x(), p.y()), 10.0, 1e-13);
        const auto normal = patch.unit_normal(u, 0.4);
        ASSERT_TRUE(normal.has_value());
        EXPECT_NEAR(normal->x(), p.x() / 10.0, 1e-13);
        EXPECT_NEAR(normal->z(), 0.0, 1e-13);
    }
}

TEST(BezierPatch, EqualWeightsOtherThanOneChangeNothing) {
    ControlNet net = random_net_of(4, 4, 5, false);
    const BezierPatch plain(net);
    net.weights.assign(net.weights.size(), 2.5);
    const BezierPatch weighted(net);
    EXPECT_LT((plain.position(0.3, 0.7) - weighted.position(0.3, 0.7)).norm(), 1e-13);
    EXPECT_LT((plain.derivatives(0.3, 0.7).duv - weighted.derivatives(0.3, 0.7).duv).norm(), 1e-11);
}

TEST(BezierPatch, TheHighestDegreeStillSumsToOne) {
    ControlNet net = ControlNet::sized(max_degree + 1, 2);
    for (int i = 0; i <= max_degree; ++i) {
        net.point(i, 0) = {static_cast<double>(i), 0.0, 1.0};
        net.point(i, 1) = {static_cast<double>(i), 1.0, 1.0};
    }
    const BezierPatch patch(net);
    EXPECT_NEAR(patch.position(0.37, 0.5).x(), 0.37 * max_degree, 1e-11);
    EXPECT_NEAR(patch.position(0.37, 0.5).z(), 1.0, 1e-13);
}

// T2.
TEST(UnitNormal, IsReportedMissingWhereAnEdgeHasCollapsed) {
    ControlNet net = random_net_of(4, 4, 9, false);
    for (int j = 0; j < 4; ++j) {
        net.point(0, j) = {0.0, 0.0, 0.0};
    }
    const BezierPatch patch(net);
    EXPECT_FALSE(patch.unit_normal(0.0, 0.5).has_value());
    EXPECT_TRUE(patch.unit_normal(0.2, 0.5).has_value());
}

TEST(UnitNormal, IsReportedMissingForANetOfCoincidentPoints) {
    const BezierPatch patch(ControlNet::sized(4, 4));
    EXPECT_FALSE(patch.unit_normal(0.5, 0.5).has_value());
}

// T1.
TEST(ControlNet, FaultsAreNamed) {
    EXPECT_NE(fault_of(ControlNet::sized(1, 4)).find("1 x 4"), std::string::npos);
    EXPECT_NE(fault_of(ControlNet::sized(4, 65)).find("4 x 65"), std::string::npos);
    ControlNet net = ControlNet::sized(4, 4);
    net.point(2, 1).z() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(fault_of(net).find("(2,1) is not finite"), std::string::npos);
    EXPECT_THROW(BezierPatch{net}, Error);
    net.point(2, 1).z() = 1e300;
    EXPECT_NE(fault_of(net).find("(2,1)"), std::string::npos);
    net.point(2, 1).z() = 0.0;
    net.weight(3, 0) = 0.0;
    EXPECT_NE(fault_of(net).find("weight (3,0)"), std::string::npos);
    net.weight(3, 0) = 1.0;
    net.points.pop_back();
    EXPECT_NE(fault_of(net).find("15 points"), std::string::npos);
}

} // namespace
} // namespace millwright::geometry
