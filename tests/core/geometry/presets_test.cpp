// Reference points of the thesis's surfaces (Parasilmongkol 1997), computed with an independent program.
#include "core/geometry/presets.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

namespace millwright::geometry {
namespace {

BezierPatch patch_of(std::string_view id) {
    return surface_preset(id).make().patch(PatchId{0});
}

struct ReferencePoint {
    double u, v;
    Vec3 position, normal;
};

// T1.
TEST(DomePreset, HasTheReferencePointsAndNormals) {
    const BezierPatch dome = patch_of("dome");
    const ReferencePoint points[] = {
        {0.0, 0.0, {10, 10, 1}, {0, 0, 1}},
        {0.25, 0.25, {26.718750, 26.718750, 29.160156}, {-0.58239499, -0.58239499, 0.56712621}},
        {0.25, 0.5, {26.718750, 46.25, 38.546875}, {-0.80755734, 0, 0.58978907}},
        {0.5, 0.5, {46.25, 46.25, 51.0625}, {0, 0, 1}},
        {0.75, 0.3, {67.65625, 30.43, 32.539375}, {0.59796910, -0.49986745, 0.62655047}},
        {0.95, 0.95, {85.50125, 85.50125, 2.807256}, {0.33526822, 0.33526822, 0.88044900}},
        {1.0, 1.0, {90, 90, 1}, {0, 0, 1}},
    };
    for (const auto& [u, v, position, normal] : points) {
        EXPECT_LT((dome.position(u, v) - position).cwiseAbs().maxCoeff(), 1e-6) << u << ' ' << v;
        const auto n = dome.unit_normal(u, v);
        ASSERT_TRUE(n.has_value());
        EXPECT_LT((*n - normal).cwiseAbs().maxCoeff(), 1e-8) << u << ' ' << v;
    }
}

TEST(DomePreset, EqualsItsClosedForm) {
    const BezierPatch dome = patch_of("dome");
    for (double u = 0.0; u <= 1.0; u += 0.05) {
        for (double v = 0.0; v <= 1.0; v += 0.05) {
            const auto side = [](double t) { return 10.0 + 60.0 * t + 30.0 * t * t - 10.0 * t * t * t; };
            const Vec3 closed(side(u), side(v), 1.0 + 801.0 * u * (1 - u) * v * (1 - v));
            EXPECT_LT((dome.position(u, v) - closed).norm(), 1e-12);
        }
    }
}

// T1.
TEST(DomeTextPreset, HasItsBorderAtZero) {
    const BezierPatch dome = patch_of("dome-text");
    EXPECT_NEAR(dome.position(0.5, 0.5).z(), 810.0 / 16.0, 1e-12);
    EXPECT_NEAR(dome.position(0.3, 0.0).z(), 0.0, 1e-12);
}

// T1.
TEST(SinePreset, HasTheReferenceHeightsAndNormal) {
    const BezierPatch sine = patch_of("sine");
    EXPECT_NEAR(sine.position(0.25, 0.6).z(), -11.25, 1e-12);
    EXPECT_NEAR(sine.position(0.5, 0.6).z(), 0.0, 1e-12);
    EXPECT_NEAR(sine.position(0.75, 0.6).z(), 11.25, 1e-12);
    const auto normal = sine.unit_normal(0.5, 0.5);
    ASSERT_TRUE(normal.has_value());
    EXPECT_LT((*normal - Vec3(-0.58817170, 0.0, 0.80873608)).norm(), 1e-8);
}

// T1.
TEST(SineAsPrintedPreset, HasTheReferenceHeights) {
    const BezierPatch sine = patch_of("sine-as-printed");
    EXPECT_NEAR(sine.position(0.25, 0.5).z(), 1.40625, 1e-12);
    EXPECT_NEAR(sine.position(0.5, 0.5).z(), 11.25, 1e-12);
    EXPECT_NEAR(sine.position(0.75, 0.5).z(), 15.46875, 1e-12);
}

// T1.
TEST(MatlabDemoPreset, InterpolatesItsCornersAndIsASheetOverTheUnitSquare) {
    const BezierPatch demo = patch_of("matlab-demo");
    EXPECT_NEAR(demo.position(0.3, 0.8).x(), 0.3, 1e-14);
    EXPECT_NEAR(demo.position(0.3, 0.8).y(), 0.8, 1e-14);
    // Rows and columns of the net are sums a_i + a_j with a = (0, .3, .3, 0), so z = .9 (u(1-u) + v(1-v)).
    EXPECT_NEAR(demo.position(0.3, 0.8).z(), 0.9 * (0.3 * 0.7 + 0.8 * 0.2), 1e-14);
}

TEST(TwoBellPreset, EqualsItsPolynomial) {
    const BezierPatch bell = patch_of("two-bell");
    EXPECT_EQ(bell.degree_u(), 4);
    EXPECT_EQ(bell.degree_v(), 2);
    for (double u = 0.0; u <= 1.0; u += 0.1) {
        for (double v = 0.0; v <= 1.0; v += 0.1) {
            const double f = u * (3.55 + u * (-14.8 + u * (21.15 - 9.9 * u)));
            const Vec3 polynomial(100 * u - 50, 100 * v - 50, 400 * v * (1 - v) * f - 28);
            EXPECT_LT((bell.position(u, v) - polynomial).norm(), 1e-12);
        }
    }
}

// T1.
TEST(SurfacePreset, TheSaddleIsItsFormula) {
    const BezierPatch saddle = patch_of("saddle");
    for (double u = 0.0; u <= 1.0; u += 0.1) {
        for (double v = 0.0; v <= 1.0; v += 0.1) {
            const double a = 2.0 * u - 1.0;
            const double b = 2.0 * v - 1.0;
            const Vec3 formula(50.0 * a, 50.0 * b, 18.0 * (a * a - b * b));
            EXPECT_LT((saddle.position(u, v) - formula).norm(), 1e-12);
        }
    }
}

TEST(SurfacePreset, AnUnknownIdListsTheKnownOnes) {
    try {
        (void)surface_preset("dom");
        FAIL() << "no Error";
    } catch (const Error& error) {
        EXPECT_NE(error.diagnostic().message.find("'dom'"), std::string::npos);
        EXPECT_NE(error.diagnostic().hint.find("two-bell"), std::string::npos);
    }
}

} // namespace
} // namespace millwright::geometry
