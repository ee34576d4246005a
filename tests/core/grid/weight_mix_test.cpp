#include "core/grid/weight_mix.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/geometry/presets.h"
#include "tests/support/test_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace millwright::grid {
namespace {

constexpr int mix_nu = 21;
constexpr int mix_nv = 11;

geometry::BezierPatch dome_patch() {
    return geometry::surface_preset("dome").make().patch(geometry::PatchId{0});
}

double at(const WeightPtr& weight, const Vec2& uv) {
    const Vec2 p = uv.cwiseProduct(Vec2(mix_nu - 1, mix_nv - 1));
    double w = 0.0;
    weight->values({&p, 1}, {&w, 1});
    return w;
}

MixSettings unsmoothed() {
    MixSettings settings;
    settings.smoothing_passes = 0;
    return settings;
}

// T16.
TEST(WeightMix, AddsMultipliesOrTakesTheLargest) {
    const MixedReasons reasons{.painted = constant_weight(0.5), .expression = constant_weight(3.0)};
    MixSettings settings = unsmoothed();
    settings.error = 0.0;
    settings.painted = 4.0;
    settings.expression = 2.0;
    EXPECT_NEAR(at(mixed_weight(reasons, settings, mix_nu, mix_nv), {0.3, 0.7}), 2.0 + 6.0, 1e-12);
    settings.combination = Combination::product;
    EXPECT_NEAR(at(mixed_weight(reasons, settings, mix_nu, mix_nv), {0.3, 0.7}), 3.0 * 7.0, 1e-12);
    settings.combination = Combination::largest;
    EXPECT_NEAR(at(mixed_weight(reasons, settings, mix_nu, mix_nv), {0.3, 0.7}), 6.0, 1e-12);
}

TEST(WeightMix, StaysInItsRange) {
    const WeightPtr slope = weight_from([](const Vec2& p) {
        return WeightAndSlope{p.x() - 5.0, Vec2(1.0, 0.0)};
    });
    MixSettings settings = unsmoothed();
    settings.error = 0.0;
    settings.expression = 1.0;
    settings.low = 0.5;
    settings.high = 9.0;
    const WeightPtr mixed = mixed_weight({.expression = slope}, settings, mix_nu, mix_nv);
    EXPECT_DOUBLE_EQ(at(mixed, {0.0, 0.5}), 0.5);
    EXPECT_NEAR(at(mixed, {0.5, 0.5}), 5.0, 1e-9);
    EXPECT_DOUBLE_EQ(at(mixed, {1.0, 0.5}), 9.0);
}

TEST(WeightMix, DividesTheErrorByItsLargest) {
    const WeightPtr error = weight_from([](const Vec2& p) {
        return WeightAndSlope{0.001 * p.x(), Vec2(0.001, 0.0)};
    });
    MixSettings settings = unsmoothed();
    settings.low = 1e-6;
    const WeightPtr mixed = mixed_weight({.error = error}, settings, mix_nu, mix_nv);
    EXPECT_NEAR(at(mixed, {1.0, 0.5}), 1.0, 1e-2);
    EXPECT_NEAR(at(mixed, {0.5, 0.5}), std::pow(0.5, 0.7), 1e-3);
}

TEST(WeightMix, SmoothingLowersASpikeAndKeepsAConstant) {
    const WeightPtr spike = weight_from([](const Vec2& p) {
        return WeightAndSlope{(p - Vec2(10.0, 5.0)).norm() < 0.3 ? 1.0 : 0.0, Vec2::Zero()};
    });
    const auto peak = [&](int passes) {
        MixSettings settings = unsmoothed();
        settings.error = 0.0;
        settings.expression = 1.0;
        settings.smoothing_passes = passes;
        return at(mixed_weight({.expression = spike}, settings, mix_nu, mix_nv), {0.5, 0.5});
    };
    EXPECT_GT(peak(0), 2.0 * peak(1));
    EXPECT_GT(peak(1), peak(3));
    MixSettings settings = unsmoothed();
    settings.error = 0.0;
    settings.expression = 1.0;
    settings.smoothing_passes = 7;
    EXPECT_NEAR(at(mixed_weight({.expression = constant_weight(2.0)}, settings, mix_nu, mix_nv), {0.1, 0.9}),
                2.0,
                1e-12);
}

TEST(WeightMix, HasTheGradientOfItsValues) {
    const WeightPtr mixed = field_weight({2, 2, {0.0, 1.0, 0.5, 0.2}}, mix_nu, mix_nv);
    const Vec2 p(7.3, 4.6);
    Vec2 slope = Vec2::Zero();
    mixed->gradients({&p, 1}, {&slope, 1});
    constexpr double h = 1e-5;
    const auto value = [&](double x, double y) {
        return at(mixed, Vec2(x / (mix_nu - 1), y / (mix_nv - 1)));
    };
    EXPECT_NEAR(slope.x(), (value(7.3 + h, 4.6) - value(7.3 - h, 4.6)) / (2.0 * h), 1e-6);
    EXPECT_NEAR(slope.y(), (value(7.3, 4.6 + h) - value(7.3, 4.6 - h)) / (2.0 * h), 1e-6);
}

TEST(WeightMix, OfTheCurvatureIsLargestWhereTheSurfaceBendsMost) {
    // z = x^3 along u bends more and more; its closed form is |z''| / (1 + z'^2)^1.5
    geometry::ControlNet net = geometry::ControlNet::sized(4, 2);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = Vec3(i / 3.0, j, i == 3 ? 1.0 : 0.0);
        }
    }
    const WeightPtr curvature = curvature_weight(geometry::BezierPatch(net), mix_nu, mix_nv);
    const auto bent = [](double x) { return 6.0 * x / std::pow(1.0 + 9.0 * x * x * x * x, 1.5); };
    double largest = 0.0;
    for (int k = 0; k <= 2 * (mix_nu - 1); ++k) {
        largest = std::max(largest, bent(k / (2.0 * (mix_nu - 1))));
    }
    for (const double u : {0.2, 0.45, 0.8}) {
        EXPECT_NEAR(at(curvature, {u, 0.5}), bent(u) / largest, 0.02) << u;
    }
}

// T20.
TEST(WeightMix, ABrushIsRoundOnTheSurfaceInMillimetres) {
    const geometry::BezierPatch patch = dome_patch();
    const Vec2 middle(0.4, 0.6);
    const Vec3 at_middle = patch.position(0.4, 0.6);
    Field field = Field::constant(65, 49, 0.0);
    ASSERT_TRUE(
        dab(field, patch, middle, {.radius_mm = 12.0, .value = 1.0, .strength = 1.0, .hardness = 0.5}));
    for (int i = 0; i < field.rows; ++i) {
        for (int j = 0; j < field.columns; ++j) {
            const Vec2 uv = field.place(i, j);
            const double away = (patch.position(uv.x(), uv.y()) - at_middle).norm();
            const double painted = field.values[field.index(i, j)];
            EXPECT_TRUE(away < 12.0 || exactly_equal(painted, 0.0));
            EXPECT_TRUE(away > 11.5 || painted > 0.0); // nearer to the rim less than a step is left
            EXPECT_EQ(painted >= 1.0, away <= 6.0);
            EXPECT_LE(painted, 1.0);
        }
    }
    Field rubbed = field;
    ASSERT_TRUE(dab(rubbed, patch, middle, {.radius_mm = 200.0, .value = 0.0, .hardness = 1.0}));
    EXPECT_EQ(rubbed, Field::constant(65, 49, 0.0));
    EXPECT_FALSE(dab(rubbed, patch, middle, {.radius_mm = 200.0, .value = 0.0, .hardness = 1.0}));
}

TEST(WeightMix, AStrokeLeavesNoGapBetweenItsDabs) {
    const geometry::BezierPatch patch = dome_patch();
    Field field = Field::constant(129, 129, 0.0);
    ASSERT_TRUE(stroke(field, patch, {0.1, 0.5}, {0.9, 0.5}, {.radius_mm = 5.0, .hardness = 0.9}));
    for (double u = 0.15; u < 0.9; u += 0.01) {
        EXPECT_GT(field.at({u, 0.5}), 0.95) << u;
    }
    EXPECT_EQ(field.at({0.5, 0.02}), 0.0);
}

TEST(WeightMix, RefusesWhatHasNoSense) {
    MixSettings settings;
    EXPECT_THROW((void)mixed_weight({}, settings, mix_nu, mix_nv), Defect); // the error is not there
    settings.error = 0.0;
    settings.low = 0.0;
    EXPECT_THROW((void)mixed_weight({}, settings, mix_nu, mix_nv), Defect);
    settings.low = 2.0;
    settings.high = 1.0;
    EXPECT_THROW((void)mixed_weight({}, settings, mix_nu, mix_nv), Defect);
    EXPECT_THROW((void)Field::constant(1, 5, 0.0), Defect);
}

} // namespace
} // namespace millwright::grid
