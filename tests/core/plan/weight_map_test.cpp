#include "core/plan/weight_map.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/geometry/presets.h"
#include "core/plan/grids.h"
#include "core/project/grid_methods/chosen_weight.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::plan {
namespace {

CuttingSetup dome_cutting_setup() {
    return {geometry::surface_preset("dome").make().patch(geometry::PatchId{0}),
            test::machine("rotary-tilt-listing")};
}

project::GridInput input(project::WeightSource source) {
    project::GridInput made;
    made.nu = made.nv = 20;
    made.elliptic.weight = source;
    return made;
}

WeightMap map_of(const project::GridInput& chosen) {
    return weight_map(chosen, dome_cutting_setup(), Progress());
}

// T16.
TEST(WeightMap, OfW1IsTheClosedFormOfTheThesis) {
    const WeightMap map = map_of(input(project::WeightSource::w1));
    for (const auto& [i, j] : {std::pair{0, 0}, std::pair{50, 50}, std::pair{70, 31}, std::pair{96, 3}}) {
        const double x = 19.0 * i / (map.rows - 1) - 10.0;
        const double y = 19.0 * j / (map.columns - 1) - 10.0;
        EXPECT_NEAR(map.at(i, j), std::exp(-std::abs(25.0 - x * x - y * y)) + 0.01, 1e-12) << i << j;
    }
    EXPECT_EQ(map.low, *std::ranges::min_element(map.values));
    EXPECT_EQ(map.high, *std::ranges::max_element(map.values));
}

TEST(WeightMap, OfW4ChangesItsSign) {
    const WeightMap map = map_of(input(project::WeightSource::w4));
    EXPECT_NEAR(map.low, -0.001, 1e-5);
    EXPECT_NEAR(map.high, 0.001, 1e-5);
}

TEST(WeightMap, OfAnExpressionHasItsValuesWithRowsAlongU) {
    project::GridInput chosen = input(project::WeightSource::expression);
    chosen.nu = 8;
    chosen.elliptic.expression = "1 + 2*u + i*v";
    const WeightMap map = map_of(chosen);
    const double u = 30.0 / (map.rows - 1);
    const double v = 80.0 / (map.columns - 1);
    EXPECT_NEAR(map.at(30, 80), 1.0 + 2.0 * u + 7.0 * u * v, 1e-12);
}

TEST(WeightMap, OfAFormulaKnowsTheSurfaceAndTheError) {
    project::GridInput chosen = input(project::WeightSource::expression);
    chosen.elliptic.expression = "1 + abs(z) + 0*err";
    const WeightMap map = map_of(chosen);
    const geometry::BezierPatch patch(project::project_from_preset("dome").surface.patches.front());
    const double u = 12.0 / (map.rows - 1);
    const double v = 70.0 / (map.columns - 1);
    EXPECT_NEAR(map.at(12, 70), 1.0 + std::abs(patch.position(u, v).z()), 1e-12);
    chosen.elliptic.expression = "0.01 + err";
    EXPECT_TRUE(needs_error(chosen.elliptic));
    EXPECT_GT(map_of(chosen).high, 0.1);
}

// T20.
TEST(WeightMap, OfAMixShowsWhatIsPainted) {
    project::GridInput chosen = input(project::WeightSource::mixed);
    chosen.elliptic.mix = {.error = 0.0, .painted = 5.0, .smoothing_passes = 0, .low = 0.5};
    const geometry::BezierPatch patch(project::project_from_preset("dome").surface.patches.front());
    const WeightMap before = map_of(chosen);
    EXPECT_NEAR(before.high, 0.5, 1e-12);
    ASSERT_TRUE(paint_weight(chosen.elliptic, patch, {0.25, 0.5}, {0.75, 0.5}, {.radius_mm = 15.0}));
    const WeightMap map = map_of(chosen);
    EXPECT_NEAR(map.at(map.rows / 2, map.columns / 2), 5.0, 1e-9);
    EXPECT_NEAR(map.at(map.rows / 2, 0), 0.5, 1e-12);
    ASSERT_TRUE(paint_weight(chosen.elliptic,
                             patch,
                             {0.25, 0.5},
                             {0.75, 0.5},
                             {.radius_mm = 200.0, .value = 0.0, .hardness = 1.0}));
    EXPECT_NEAR(map_of(chosen).high, 0.5, 1e-12);
}

TEST(WeightMap, OfAFormulaWithAPoleBetweenTheNodesShowsTheNodes) {
    project::GridInput chosen = input(project::WeightSource::expression);
    chosen.nu = 20;
    chosen.nv = 10;
    chosen.elliptic.expression = "1 / abs(u - 0.25)"; // 0.25 is on the raster, and no node is there
    const WeightMap map = map_of(chosen);
    EXPECT_EQ(map.rows, 20);
    EXPECT_EQ(map.columns, 10);
    EXPECT_NEAR(map.at(19, 4), 1.0 / 0.75, 1e-12);
    EXPECT_TRUE(std::ranges::all_of(map.values, [](double w) { return std::isfinite(w); }));
}

TEST(WeightMap, OfTheErrorIsLargestWhereAMoveOfTheUniformGridIsWorst) {
    const project::GridInput chosen = input(project::WeightSource::error);
    const WeightMap map = map_of(chosen);
    const CuttingSetup cutting_setup = dome_cutting_setup();
    const toolpath::KinematicError model = cutting_setup.error_model();
    double worst = 0.0;
    Vec2 there = Vec2::Zero();
    const bool along_v = chosen.direction == grid::TrackDirection::along_v;
    for (int t = 0; t < 20; ++t) {
        for (int k = 0; k < 19; ++k) {
            const Vec2 a = along_v ? Vec2(t, k) : Vec2(k, t);
            const Vec2 b = along_v ? Vec2(t, k + 1) : Vec2(k + 1, t);
            const double error = model.move(a / 19.0, b / 19.0, grid::coarse).tip;
            if (error > worst) {
                worst = error;
                there = 0.5 * (a + b) / 19.0;
            }
        }
    }
    const auto nearest = [](double t, int count) { return static_cast<int>(std::lround(t * (count - 1))); };
    const double here = map.at(nearest(there.x(), map.rows), nearest(there.y(), map.columns));
    EXPECT_GT(here, map.low + 0.5 * (map.high - map.low));
    EXPECT_GT(map.low, 0.0);
    EXPECT_LE(map.high, 1.01 + 1e-12); // the largest density counts as 1, and the floor is added
}

TEST(WeightMap, IsTheSameOnAnyNumberOfThreads) {
    set_thread_count(1);
    const WeightMap alone = map_of(input(project::WeightSource::error));
    set_thread_count(3);
    const WeightMap together = map_of(input(project::WeightSource::error));
    set_thread_count(0);
    EXPECT_EQ(alone.values, together.values);
}

TEST(WeightMap, OfNonsenseIsRefused) {
    project::GridInput chosen = input(project::WeightSource::expression);
    chosen.elliptic.expression = "1 +";
    EXPECT_THROW((void)map_of(chosen), Error);
}

} // namespace
} // namespace millwright::plan
