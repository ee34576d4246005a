#include "core/plot/carving/v_carving.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/core/plot/carving/carving_shapes.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace millwright::plot {
namespace {

using testing::HasSubstr;

const double half_tan = std::tan(from_degrees(30.0)); // of a bit of 60 degrees
const ToolTip wide_bit{TipKind::v, 60.0, from_degrees(60.0)};

CarvingSettings with_bit(const ToolTip& tip) {
    CarvingSettings settings;
    settings.tip = tip;
    return settings;
}

Carving carved(const Region& region, const CarvingSettings& settings = with_bit(wide_bit)) {
    return v_carving(strokes_around(region), settings);
}

std::string refused(const Strokes& strokes, const CarvingSettings& settings = {}) {
    try {
        (void)v_carving(strokes, settings);
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return {};
}

std::string all_notices(const Carving& carving) {
    std::string text;
    for (const Diagnostic& notice : carving.notices) {
        text += to_text(notice) + "\n";
    }
    return text;
}

double length_in_work(const CutPath& path) {
    double length = 0.0;
    for (std::size_t n = 1; n < path.size(); ++n) {
        length += path[n].move == CutMove::cut ? (path[n].at - path[n - 1].at).norm() : 0.0;
    }
    return length;
}

void expect_inside(const Carving& carving, const Region& region) {
    constexpr double just_below = 1e-3; // where the bit is on the outline it is at the top
    for (const CutPoint& point : carving.path) {
        if (point.move == CutMove::cut && point.at.z() < -just_below) {
            ASSERT_TRUE(contains(region, point.at.head<2>())) << point.at.transpose();
        }
    }
}

/// Lifts between cuts.
int runs_of(const CutPath& path) {
    return static_cast<int>(std::ranges::count(path, CutMove::plunge, &CutPoint::move));
}

TEST(VCarving, OfASquareIsAPyramid) {
    constexpr double side = 20.0;
    const Region square{box_ring({0, 0}, {side, side})};
    const Carving carving = carved(square);
    EXPECT_NEAR(carving.deepest, side / 2.0 / half_tan, 1e-4);
    EXPECT_NEAR(carving.area, side * side, 1e-6);
    EXPECT_LT(carving.deviation, 1e-4);
    EXPECT_DOUBLE_EQ(carving.floor_area, 0.0);
    EXPECT_EQ(runs_of(carving.path), 2);         // both diagonals
    std::set<std::pair<double, double>> corners; // where the path is at the surface
    for (const CutPoint& point : carving.path) {
        if (point.move != CutMove::rapid && point.move != CutMove::retract && point.at.z() > -1e-9) {
            corners.emplace(std::round(point.at.x()), std::round(point.at.y()));
        }
    }
    EXPECT_EQ(corners.size(), 4U);
    // The mean depth times the area: a third of the deepest.
    const std::vector<Vec3> places = places_in_work(carving.path, 0.02);
    double sum = 0.0;
    constexpr int grid = 40;
    for (int n = 0; n < grid * grid; ++n) {
        const Vec2 at =
            side / grid * Vec2(n % grid + 0.5, n / grid + 0.5); // NOLINT(bugprone-integer-division)
        sum += carved_depth(places, wide_bit, at);
    }
    EXPECT_NEAR(sum / (grid * grid), carving.deepest / 3.0, 0.002 * carving.deepest);
}

TEST(VCarving, CutsASharpValleyToEveryOutline) {
    for (const Region& region : {ell(), letter(), random_star(1, 9), turned(random_star(2, 60), 0.4, 0.5)}) {
        const Carving carving = carved(region);
        const std::vector<Vec3> places = places_in_work(carving.path, 0.01);
        double missing = 0.0;
        double too_deep = 0.0;
        for (const Vec2& at : places_inside(region, 300, 3)) {
            const double wanted = brute_clearance(region, at) / half_tan;
            const double depth = carved_depth(places, wide_bit, at);
            missing = std::max(missing, wanted - depth);
            too_deep = std::max(too_deep, depth - wanted);
        }
        EXPECT_LT(too_deep, 0.01);
        EXPECT_LT(missing, 0.01 + 0.01 / half_tan); // and half of the step between places
        for (const Vec3& at : places) {             // the cone stays inside
            EXPECT_LT(-at.z() * half_tan - brute_clearance(region, at.head<2>()), 0.01);
        }
        EXPECT_LT(carving.deviation, 0.01);
    }
}

TEST(VCarving, DepthsTurnAndGrowWithTheOutline) {
    CarvingSettings settings = with_bit(wide_bit);
    const Carving one = carved(letter(), settings);
    settings.tolerance *= 2.0;
    const Carving other = carved(turned(letter(), 1.1, 2.0), settings);
    EXPECT_NEAR(other.deepest, 2.0 * one.deepest, 0.02);
    EXPECT_NEAR(other.area, 4.0 * one.area, 1e-3);
    EXPECT_NEAR(
        length_in_work(other.path), 2.0 * length_in_work(one.path), 0.01 * length_in_work(other.path));
}

TEST(VCarving, ADiscIsOnePlungeAndAFlatOrRoundEndCountsForItsDepth) {
    const Region disc{disc_ring({0, 0}, 5.0, 2000)};
    const Carving sharp = carved(disc);
    EXPECT_EQ(runs_of(sharp.path), 1);
    EXPECT_EQ(sharp.path.size(), 3U);
    EXPECT_NEAR(sharp.deepest, 5.0 / half_tan, 0.01);
    ToolTip flat = wide_bit;
    flat.end_width = 0.8;
    EXPECT_NEAR(carved(disc, with_bit(flat)).deepest, (5.0 - 0.4) / half_tan, 0.01);
    ToolTip round = wide_bit;
    round.end_radius = 1.0; // touches the cone 30 degrees above its equator
    EXPECT_NEAR(carved(disc, with_bit(round)).deepest,
                (5.0 - std::cos(from_degrees(30.0))) / half_tan + 1.0 - std::sin(from_degrees(30.0)),
                0.01);
}

TEST(VCarving, ARoundEndCutsValleysOfItsOwnShape) {
    ToolTip round{TipKind::v, 30.0, from_degrees(90.0), 0.0, 1.5};
    const Region region = ell();
    const Carving carving = carved(region, with_bit(round));
    EXPECT_LT(carving.deviation, 0.01);
    for (const Vec3& at : places_in_work(carving.path, 0.05)) {
        EXPECT_NEAR(-at.z(), rise(round, brute_clearance(region, at.head<2>())), 0.02);
    }
}

TEST(VCarving, ARingHasOneDepthAllAround) {
    const Carving carving = carved({disc_ring({0, 0}, 10.0, 720), disc_ring({0, 0}, 6.0, 720)});
    EXPECT_EQ(runs_of(carving.path), 1);
    for (const CutPoint& point : carving.path) {
        if (point.move == CutMove::cut) {
            EXPECT_NEAR(-point.at.z(), 2.0 / half_tan, 0.01);
            EXPECT_NEAR(point.at.head<2>().norm(), 8.0, 0.01);
        }
    }
}

// A square of 20 mm at 4 mm: a floor of (20 - 2 * 4 tan 30)^2.
TEST(VCarving, AFloorIsClearedToItsRidges) {
    constexpr double depth = 4.0;
    const Region square{box_ring({0, 0}, {20, 20})};
    CarvingSettings settings = with_bit(wide_bit);
    settings.largest_depth = depth;
    settings.step_over = 0.5;
    const Carving carving = carved(square, settings);
    const double floor_side = 20.0 - 2.0 * depth * half_tan;
    EXPECT_DOUBLE_EQ(carving.deepest, depth);
    EXPECT_NEAR(carving.floor_area, floor_side * floor_side, 1e-3);
    EXPECT_DOUBLE_EQ(carving.floor_left, 0.0);
    EXPECT_NEAR(carving.ridge, 0.25 / half_tan, 1e-9);
    EXPECT_LT(carving.deviation, 0.01);
    EXPECT_THAT(all_notices(carving), HasSubstr("mm2 of floor"));
    const std::vector<Vec3> places = places_in_work(carving.path, 0.02);
    for (const Region& region : {square}) {
        for (const Vec2& at : places_inside(region, 300, 5)) {
            const double wanted = std::min(depth, brute_clearance(region, at) / half_tan);
            const double found = carved_depth(places, wide_bit, at);
            EXPECT_LT(found, wanted + 0.01);
            EXPECT_GT(found, wanted - carving.ridge - 0.03);
        }
    }
}

TEST(VCarving, FloorsOfAnyShapeAreClearedToTheirRidges) {
    for (const Region& region : {ell(), letter(), random_star(3, 12)}) {
        CarvingSettings settings = with_bit(wide_bit);
        settings.largest_depth = 1.5;
        const Carving carving = carved(region, settings);
        EXPECT_NEAR(carving.ridge, 0.15, 1e-9); // a tenth
        EXPECT_LT(carving.deviation, 0.01);
        const std::vector<Vec3> places = places_in_work(carving.path, 0.04);
        double missing = 0.0;
        double too_deep = 0.0;
        for (const Vec2& at : places_inside(region, 100, 6)) {
            const double wanted = std::min(1.5, brute_clearance(region, at) / half_tan);
            const double depth = carved_depth(places, wide_bit, at);
            missing = std::max(missing, wanted - depth);
            too_deep = std::max(too_deep, depth - wanted);
        }
        EXPECT_LT(too_deep, 0.01);
        EXPECT_LT(missing, carving.ridge + 0.04);
    }
}

TEST(VCarving, AFloorThatIsLeftIsMeasured) {
    const Region square{box_ring({0, 0}, {20, 20})};
    CarvingSettings settings = with_bit(wide_bit);
    settings.largest_depth = 4.0;
    settings.clear_floor = false;
    const Carving carving = carved(square, settings);
    const double floor_side = 20.0 - 8.0 * half_tan;
    EXPECT_NEAR(carving.floor_left, floor_side * floor_side, 1e-3);
    EXPECT_THAT(all_notices(carving), HasSubstr("of the floor at 4.000 mm are not cleared"));
    for (const CutPoint& point : carving.path) { // along the edge of the floor, not on it
        const bool within = brute_clearance(square, point.at.head<2>()) > 4.0 * half_tan + 0.01;
        EXPECT_FALSE(within && point.at.z() < 0.0);
    }
    settings.tip.end_width = 2.0;
    EXPECT_NEAR(carved(square, settings).floor_left, std::pow(floor_side - 4.0, 2.0), 0.01);
}

TEST(VCarving, ABitThatIsTooNarrowCutsAFloorAtItsOwnDepth) {
    const Carving carving =
        carved({box_ring({0, 0}, {20, 20})}, with_bit({TipKind::v, 6.0, from_degrees(60.0)}));
    EXPECT_NEAR(carving.deepest, 3.0 / half_tan, 1e-9);
    EXPECT_NEAR(carving.floor_area, 14.0 * 14.0, 1e-3);
    EXPECT_LT(carving.deviation, 0.01);
}

TEST(VCarving, StepsDownInEqualPassesThatLeaveTheSame) {
    CarvingSettings settings = with_bit(wide_bit);
    const Carving at_once = carved(letter(), settings);
    settings.depth_per_pass = 1.5;
    const Carving stepped = carved(letter(), settings);
    EXPECT_DOUBLE_EQ(stepped.deepest, at_once.deepest);
    const double count = std::ceil(at_once.deepest / 1.5);
    const std::vector<Vec3> once = places_in_work(at_once.path, 0.02);
    const std::vector<Vec3> twice = places_in_work(stepped.path, 0.02);
    for (const Vec2& at : places_inside(letter(), 200, 4)) {
        EXPECT_NEAR(carved_depth(twice, wide_bit, at), carved_depth(once, wide_bit, at), 0.04);
    }
    // No place is more than a step below what the passes before have left there.
    std::vector<Vec3> before;
    double deepest = 0.0;
    double pass = 1.0;
    for (const Vec3& at : twice) {
        const double least = stepped.deepest * (pass - 1.0) / count;
        if (-at.z() > stepped.deepest * pass / count + 1e-9) {
            pass += 1.0;
        }
        deepest = std::max(deepest, -at.z());
        EXPECT_GE(-at.z(), least - 1e-9);
    }
    EXPECT_DOUBLE_EQ(pass, count);
}

TEST(VCarving, FinishesOnePartBeforeTheNext) {
    Region three = ell();
    for (const double x : {100.0, 50.0}) {
        for (Ring ring : letter()) {
            for (Vec2& p : ring) {
                p += Vec2(x, 0.0);
            }
            three.push_back(ring);
        }
    }
    CarvingSettings settings = with_bit(wide_bit);
    settings.depth_per_pass = 2.0;
    const Carving carving = carved(three, settings);
    EXPECT_EQ(carving.parts, 3);
    std::vector<int> order;
    for (const CutPoint& point : carving.path) {
        const int part = static_cast<int>(point.at.x() / 45.0);
        if (order.empty() || order.back() != part) {
            order.push_back(part);
        }
    }
    EXPECT_THAT(order, testing::ElementsAre(0, 1, 2)); // from the origin, nearest next
}

TEST(VCarving, NeverGoesDownFasterThanItPlunges) {
    CarvingSettings settings = with_bit({TipKind::v, 60.0, from_degrees(20.0)});
    settings.cutting = 20.0;
    settings.plunging = 1.0;
    const Carving carving = carved(ell(), settings);
    int slowed = 0;
    for (std::size_t n = 1; n < carving.path.size(); ++n) {
        const CutPoint& point = carving.path[n];
        const Vec3 way = point.at - carving.path[n - 1].at;
        if (point.move == CutMove::cut && way.norm() > 0.0) {
            EXPECT_LE(point.speed * std::max(0.0, -way.z()) / way.norm(), 1.0 + 1e-9);
            EXPECT_LE(point.speed, 20.0);
            slowed += point.speed < 20.0 ? 1 : 0;
        }
    }
    EXPECT_GT(slowed, 0);
}

TEST(VCarving, WhatIsNarrowerThanTheFlatEndIsMeasuredOrRefused) {
    ToolTip flat = wide_bit;
    flat.end_width = 5.0;
    const Region two{box_ring({0, 0}, {20, 20}), box_ring({30, 0}, {34, 20})}; // of 20 and 4 mm
    const Carving carving = carved(two, with_bit(flat));
    const double corners = (4.0 - pi) * 2.5 * 2.5;
    EXPECT_NEAR(carving.narrow_area, 80.0 + corners, 0.1);
    EXPECT_THAT(all_notices(carving),
                HasSubstr("narrower than the flat end of the bit, 5 mm, and are not cut"));
    EXPECT_THAT(refused(strokes_around({box_ring({30, 0}, {34, 20})}), with_bit(flat)),
                HasSubstr("the whole drawing is narrower than the flat end of the bit, 5 mm"));
}

Stroke line(std::vector<Vec2> points) {
    return {.points = std::move(points), .byte = 12};
}

TEST(VCarving, JoinsOpenOutlinesWithinTheGapAndNamesTheOthers) {
    const Stroke nearly = line({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0.3}});
    EXPECT_THAT(refused({nearly}),
                HasSubstr("no outline is closed, so there is nothing to carve: 1 open stroke is skipped, the "
                          "first from (0.000, 0.000) to (0.000, 0.300) mm, with its ends 0.300 mm apart"));
    CarvingSettings settings = with_bit(wide_bit);
    settings.close_gaps = 0.5;
    EXPECT_NEAR(v_carving({nearly}, settings).area, 100.0, 1e-6);
    // The last point counts, also within the gap.
    const Stroke beside = line({{0, 0}, {20, 0}, {20, 20}, {0, 20}, {0.4, 0}});
    EXPECT_NEAR(v_carving({beside}, settings).area, 396.0, 1e-6);
    // Four lines whose ends touch, and two that go nowhere.
    const Strokes lines{line({{0, 0}, {10, 0}}),
                        line({{10, 10}, {10, 0}}),
                        line({{10, 10}, {0, 10}}),
                        line({{0, 10}, {0, 0}}),
                        line({{50, 50}, {60, 60}}),
                        line({{70, 70}})};
    const Carving carving = v_carving(lines, {});
    EXPECT_NEAR(carving.area, 100.0, 1e-6);
    EXPECT_THAT(all_notices(carving),
                HasSubstr("2 open strokes are skipped, the first from (50.000, 50.000)"));
    EXPECT_EQ(carving.notices.front().place.byte, 12);
}

TEST(VCarving, SaysWhatIsWrongWithOutlines) {
    EXPECT_THAT(refused({}), HasSubstr("there is no outline to carve"));
    EXPECT_THAT(refused(strokes_around({{{0, 0}, {5, 5}, {9, 9}}})),
                HasSubstr("the outlines enclose no area"));
    const Carving bow = carved({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}});
    EXPECT_THAT(all_notices(bow), HasSubstr("outlines cross or overlap 1 time, at (5.000, 5.000) mm"));
    const Ring square = box_ring({0, 0}, {10, 10});
    const Carving twice = carved({square, square, {{1, 1}, {5, 5}, {9, 9}}});
    EXPECT_THAT(all_notices(twice), HasSubstr("duplicate outlines are skipped 1 time, at (0.000, 0.000) mm"));
    EXPECT_THAT(all_notices(twice),
                HasSubstr("that enclose no area are skipped 1 time, at (1.000, 1.000) mm"));
    EXPECT_NEAR(twice.area, 100.0, 1e-6);
    const Ring from_a_side{{5, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
    EXPECT_NEAR(carved({square, from_a_side}).area, 100.0, 1e-6);
    EXPECT_THAT(refused({line({{0, 0}, {10, 10}, {0, 0}})}), HasSubstr("enclose no area"));
}

/// Some of their sides run on two outlines of what they surround together, and are inside it.
TEST(VCarving, OutlinesThatShareSidesAreOneInsideAndNothingElseIsCut) {
    const Region shapes{{{3, 0}, {2, 0}, {1, 2}}, {{1, 2}, {2, 1}, {0, 0}, {2, 0}}};
    const Carving carving = carved(shapes);
    EXPECT_LE(carving.deviation, CarvingSettings{}.tolerance);
    expect_inside(carving, shapes);
    const Region frame{box_ring({0, 0}, {20, 20}), box_ring({7, 7}, {13, 13})};
    expect_inside(carved(frame), frame);
    CarvingSettings shallow = with_bit(wide_bit);
    shallow.largest_depth = 1.0;
    expect_inside(carved(frame, shallow), frame);
    std::mt19937 random(7);
    std::uniform_int_distribution<int> place(0, 5);
    for (int n = 0; n < 60; ++n) {
        Region drawn;
        for (int k = 0; k < 3; ++k) {
            Ring& ring = drawn.emplace_back();
            for (int corner = 0; corner < 4; ++corner) {
                ring.emplace_back(place(random), place(random));
            }
        }
        const std::string why = refused(strokes_around(drawn), with_bit(wide_bit));
        EXPECT_THAT(why, testing::AnyOf("", HasSubstr("enclose no area"))) << n;
    }
}

TEST(VCarving, RefusesSettingsOutOfTheirRange) {
    const millwright::test::WithoutTraps no_traps;
    const Strokes square = strokes_around({box_ring({0, 0}, {10, 10})});
    const auto with = [](auto set) {
        CarvingSettings settings;
        set(settings);
        return settings;
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refused(square, with_bit({TipKind::ball, 3.0})), HasSubstr("ball:3 cannot carve"));
    EXPECT_THAT(refused(square, with_bit({TipKind::flat, 3.0})), HasSubstr("flat:3 cannot carve"));
    for (const double angle : {0.0, pi, -1.0, nan}) {
        EXPECT_THAT(refused(square, with_bit({TipKind::v, 6.0, angle})), HasSubstr("not a valid V-bit"))
            << angle;
    }
    EXPECT_THAT(refused(square, with_bit({TipKind::v, 6.0, 1.0, 6.0})),
                HasSubstr("an end narrower than the bit"));
    EXPECT_THAT(refused(square, with([](CarvingSettings& s) { s.largest_depth = 0.0; })),
                HasSubstr("the largest depth must be above 0, not 0"));
    EXPECT_THAT(refused(square, with([](CarvingSettings& s) { s.depth_per_pass = -1.0; })),
                HasSubstr("the depth per pass must be above 0, not -1"));
    EXPECT_THAT(refused(square, with([](CarvingSettings& s) { s.depth_per_pass = 1e-6; })),
                HasSubstr("the depth per pass must be 0.002 mm or more, not 1e-06"));
    const Strokes wide = strokes_around({box_ring({0, 0}, {60, 60})});
    CarvingSettings thin = with_bit(wide_bit);
    thin.depth_per_pass = 0.002; // of 52 mm
    EXPECT_THAT(refused(wide, thin), HasSubstr("needs more than 10000 passes"));
    EXPECT_THAT(refused(square, with([nan](CarvingSettings& s) { s.step_over = nan; })),
                HasSubstr("the step-over"));
    EXPECT_THAT(refused(square, with([](CarvingSettings& s) { s.tolerance = 1e-5; })),
                HasSubstr("the tolerance must be 0.0001 mm or more, not 1e-05"));
    EXPECT_THAT(refused(square, with([](CarvingSettings& s) { s.close_gaps = 0.0; })),
                HasSubstr("the largest gap"));
}

// Each spike has a branch to the middle and a floor beside it: with loops over all of them this took minutes.
TEST(VCarving, OfManySpikesIsMade) {
    Ring ring;
    constexpr int spikes = 300;
    for (int n = 0; n < 2 * spikes; ++n) {
        const double angle = pi * n / spikes;
        ring.emplace_back((n % 2 == 0 ? 60.0 : 40.0) * Vec2(std::cos(angle), std::sin(angle)));
    }
    CarvingSettings settings = with_bit({TipKind::v, 12.0, from_degrees(60.0)});
    settings.tolerance = 0.05;
    const Carving carving = carved({ring}, settings);
    EXPECT_NEAR(carving.deepest, 6.0 / half_tan, 1e-9);
    EXPECT_LT(carving.deviation, settings.tolerance);
    EXPECT_GE(runs_of(carving.path), spikes / 2); // a trail goes up one spike and down another
    expect_inside(carving, {ring});
}

TEST(VCarving, OfManySegmentsIsMadeAndCanBeCancelled) {
    const Strokes many = strokes_around({disc_ring({0, 0}, 40.0, 6000), disc_ring({0, 0}, 30.0, 4000)});
    const Carving carving = v_carving(many, with_bit(wide_bit));
    EXPECT_NEAR(carving.deepest, 5.0 / half_tan, 0.01);
    EXPECT_LT(carving.deviation, 0.01);
    std::stop_source stop;
    int reports = 0;
    const Progress stopping(
        [&](const Progress::Report&) {
            if (++reports > 2) {
                stop.request_stop();
            }
        },
        stop.get_token());
    EXPECT_THROW((void)v_carving(many, with_bit(wide_bit), stopping), Cancelled);
}

} // namespace
} // namespace millwright::plot
