#include "core/toolpath/set_up_search.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/toolpath/error_field.h"
#include "core/toolpath/kinematic_error.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/paths.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

SetUpCost set_up_cost(const char* preset, const char* machine, int nodes, SetUpGoal goal = SetUpGoal::error) {
    return {test::patch(preset),
            test::machine(machine),
            false,
            Grid::uniform(nodes, nodes),
            TrackDirection::along_v,
            goal};
}

/// Where the dome may stand on the thesis's table.
const SetUpSearchSettings on_the_table{{-100.0, -100.0, 150.0, 0.0}, {50.0, 50.0, 260.0, 0.0}, 3, 4, 100};

TEST(SetUpSearch, HalvesTheErrorOfADomeThatStoodFarFromTheAxis) {
    const SetUpCost cost = set_up_cost("dome", "rotary-tilt-listing", 20);
    const SetUpSearch found = search_set_up(cost, on_the_table, {});
    EXPECT_EQ(found.start.place, SetUpPlace(-15.0, 0.0, 175.0, 0.0));
    EXPECT_LE(found.best.cost, 0.55 * found.start.cost);
    EXPECT_LE(found.best.cost, 0.194) << "mm: what a prototype found";
    EXPECT_LE(found.evaluations, 1 + 27 + 100);
    EXPECT_NEAR(found.best.place.x(), -50.0, 20.0) << "the middle of the part is above the turning axis";
    EXPECT_NEAR(found.best.place.y(), -50.0, 20.0);
    const KinematicError there(
        test::patch("dome"),
        test::machine("rotary-tilt-listing").with_workpiece_offset(offset_of(found.best.place)),
        false);
    const auto moves = measure(there, Grid::uniform(20, 20), TrackDirection::along_v, grid::coarse);
    EXPECT_DOUBLE_EQ(grid::summary(moves).mean, found.best.cost);
    ASSERT_TRUE(found.best.axis_max && found.start.axis_max);
    const Toolpath path = zigzag(test::patch("dome"), Grid::uniform(20, 20), TrackDirection::along_v, false);
    const auto machine =
        test::machine("rotary-tilt-listing").with_workpiece_offset(offset_of(found.best.place));
    const ErrorField field =
        error_field(test::patch("dome"), machine, path, sequence(machine, path), {4095}, {});
    EXPECT_NEAR(summary(field, Distance::closest, MoveKind::track).axis_max,
                *found.best.axis_max,
                from_degrees(2e-3));
    EXPECT_GT(*found.start.axis_max, *cost.figures_at(found.start.place, {}).axis_max);
}

TEST(SetUpSearch, NoAxisDeviationWhereNoneIsMeasuredOrTheToolCannotTurn) {
    const SetUpCost travel = set_up_cost("dome", "rotary-tilt-listing", 5, SetUpGoal::travel);
    EXPECT_EQ(travel.figures_at(travel.start(), {}).axis_max, std::nullopt);
    const SetUpCost upright = set_up_cost("dome", "router-xyz", 5);
    const PlaceFigures there = upright.figures_at(upright.start(), {});
    ASSERT_TRUE(std::isfinite(there.cost));
    EXPECT_EQ(there.axis_max, std::nullopt);
    const SetUpCost far = set_up_cost("dome", "rotary-tilt-listing", 5);
    EXPECT_EQ(far.figures_at({1e5, 0.0, 0.0, 0.0}, {}), PlaceFigures{});
}

TEST(SetUpSearch, IsNeverWorseThanTheStart) {
    const SetUpCost cost = set_up_cost("dome", "rotary-tilt-listing", 6);
    SetUpSearchSettings far = on_the_table; // the start lies outside, and everything inside is worse
    far.least = {400.0, 400.0, 175.0, 0.0};
    far.most = {500.0, 500.0, 180.0, 0.0};
    far.places = 2;
    far.descent = 20;
    const SetUpSearch found = search_set_up(cost, far, {});
    EXPECT_EQ(found.best.place, found.start.place);
    EXPECT_EQ(found.best.cost, found.start.cost);
}

TEST(SetUpSearch, APartStaysWhereNoPlaceIsBetterByMoreThanRounding) {
    const SetUpCost cost = set_up_cost("dome", "ca-head", 6); // both rotary axes move the tool
    SetUpSearchSettings box;
    box.least = cost.start() - SetUpPlace(60.0, 60.0, 80.0, 0.0);
    box.most = cost.start() + SetUpPlace(60.0, 60.0, 80.0, 0.0);
    const SetUpSearch found = search_set_up(cost, box, {});
    EXPECT_EQ(found.best.place, found.start.place);
    EXPECT_EQ(found.best.cost, found.start.cost);
}

TEST(SetUpSearch, LessTravelOfTheLinearAxesNearTheTurningAxis) {
    const SetUpCost cost = set_up_cost("dome", "rotary-tilt-listing", 8, SetUpGoal::travel);
    const SetUpSearch found = search_set_up(cost, on_the_table, {});
    EXPECT_LT(found.best.cost, 0.8 * found.start.cost);
}

TEST(SetUpSearch, AMapTellsWhatTheCostTells) {
    const SetUpCost cost = set_up_cost("two-bell", "ac-table", 5);
    SetUpSearchSettings box;
    box.least = {-20.0, -30.0, -10.0, 0.0};
    box.most = {20.0, 30.0, 10.0, 0.0};
    const SetUpMap map =
        set_up_map(cost, {1.0, 2.0, 3.0, 0.0}, SetUpParameter::c, SetUpParameter::a, 3, box, {});
    ASSERT_EQ(map.costs.size(), 9U);
    EXPECT_EQ(map.x, (std::vector{-10.0, 0.0, 10.0}));
    EXPECT_EQ(map.y, (std::vector{-20.0, 0.0, 20.0}));
    const PlaceFigures there = cost.figures_at({0.0, 2.0, 10.0, 0.0}, {});
    EXPECT_EQ(map.costs[5], there.cost) << "row y = 0, column x = 10";
    EXPECT_EQ(map.axis_max[5], there.axis_max);
}

TEST(SetUpSearch, ATurnOnATurntableIsAShiftRoundItsAxis) {
    // The table turns about the vertical itself: turned part and offset together change nothing but its
    // angle.
    for (const char* machine : {"ac-table", "bc-table-head", "rotary-tilt-listing"}) {
        const SetUpCost cost = set_up_cost("dome", machine, 7);
        const double turn = 0.7;
        const SetUpPlace here = cost.start() + SetUpPlace(20.0, -10.0, 0.0, 0.0);
        SetUpPlace there = here;
        there.head<2>() = Eigen::Rotation2Dd(turn) * here.head<2>();
        there[3] = turn;
        EXPECT_NEAR(cost.at(there, {}), cost.at(here, {}), 1e-6 * cost.at(here, {})) << machine;
    }
}

TEST(SetUpSearch, FindsATurnThatTravelsLess) {
    const SetUpCost cost = set_up_cost("sine", "ca-head", 6, SetUpGoal::travel);
    SetUpSearchSettings box;
    box.least << offset_of(cost.start()) - Vec3::Constant(1.0), -1.5;
    box.most << offset_of(cost.start()) + Vec3::Constant(1.0), 1.5;
    box.places = 1;
    const SetUpSearch found = search_set_up(cost, box, {});
    EXPECT_LE(found.best.cost, found.start.cost);
    for (const double turn : {-1.2, -0.6, 0.6, 1.2}) {
        SetUpPlace place = found.best.place;
        place[3] = turn;
        EXPECT_LE(found.best.cost, cost.at(place, {}) * (1.0 + 1e-3)) << turn;
    }
    const SetUpMap map =
        set_up_map(cost, found.best.place, SetUpParameter::turn, SetUpParameter::a, 3, box, {});
    EXPECT_EQ(map.x.front(), -1.5);
    SetUpPlace corner = found.best.place;
    corner[3] = 1.5;
    corner[0] = box.most[0];
    EXPECT_EQ(map.costs.back(), cost.at(corner, {}));
}

TEST(SetUpSearch, OutOfReachIsInfinite) {
    const SetUpCost cost = set_up_cost("dome", "ac-table", 5);
    EXPECT_TRUE(std::isinf(cost.at({1e5, 0.0, 0.0, 0.0}, {})));
}

TEST(SetUpSearch, CanBeCancelledInTheDescent) {
    const SetUpCost cost = set_up_cost("dome", "rotary-tilt-listing", 6);
    SetUpSearchSettings settings = on_the_table;
    settings.places = 1;
    settings.descent = 1000;
    std::stop_source stop;
    const Progress progress(
        [&](const Progress::Report& report) {
            if (report.fraction > 0.01) {
                stop.request_stop();
            }
        },
        stop.get_token());
    EXPECT_THROW((void)search_set_up(cost, settings, progress), Cancelled);
}

TEST(SetUpSearch, RefusesABoxWithoutAVolume) {
    const SetUpCost cost = set_up_cost("dome", "rotary-tilt-listing", 4);
    SetUpSearchSettings flat;
    flat.most.z() = flat.least.z();
    EXPECT_THROW((void)search_set_up(cost, flat, {}), Defect);
    EXPECT_THROW((void)set_up_map(cost, SetUpPlace::Zero(), SetUpParameter::b, SetUpParameter::b, 5, {}, {}),
                 Defect);
}

} // namespace
} // namespace millwright::toolpath
