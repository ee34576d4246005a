#include "core/plot/carving/medial_axis.h"

#include "core/base/error.h"
#include "tests/core/plot/carving/carving_shapes.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stop_token>
#include <string>

namespace millwright::plot {
namespace {

using testing::HasSubstr;

constexpr double exact_mm = 1e-5; // places are rounded to 1e-6 mm
constexpr AxisSettings unpruned{.sampling = 0.0025, .pruning = 0.0};

double axis_length(const MedialAxis& axis) {
    double length = 0.0;
    for (const AxisEdge& edge : axis.edges) {
        for (std::size_t n = 1; n < edge.way.size(); ++n) {
            length += (edge.way[n] - edge.way[n - 1]).head<2>().norm();
        }
    }
    return length;
}

double widest_clearance(const MedialAxis& axis) {
    double widest = 0.0;
    for (const AxisNode& node : axis.nodes) {
        widest = std::max(widest, node.clearance);
    }
    return widest;
}

/// Of a node near `place`; NaN if none is.
double clearance_near(const MedialAxis& axis, const Vec2& place) {
    for (const AxisNode& node : axis.nodes) {
        if ((node.at - place).norm() < exact_mm) {
            return node.clearance;
        }
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// Every place of it is inside, as far from the outline as it says, and so are the chords between.
void expect_true_clearance(const MedialAxis& axis, const Region& region, double sampling) {
    double worst_place = 0.0;
    double worst_chord = 0.0;
    for (const AxisEdge& edge : axis.edges) {
        for (std::size_t n = 0; n < edge.way.size(); ++n) {
            const Vec3& at = edge.way[n];
            worst_place = std::max(worst_place, std::abs(brute_clearance(region, at.head<2>()) - at.z()));
            EXPECT_TRUE(at.z() < exact_mm || contains(region, at.head<2>()));
            if (n > 0) {
                const Vec3 middle = 0.5 * (at + edge.way[n - 1]);
                worst_chord =
                    std::max(worst_chord, std::abs(brute_clearance(region, middle.head<2>()) - middle.z()));
            }
        }
    }
    EXPECT_LT(worst_place, exact_mm);
    EXPECT_LT(worst_chord, 2.0 * sampling); // of place and of clearance
}

std::string refusal_of(const Region& region, const AxisSettings& settings = {}) {
    try {
        (void)medial_axis(region, settings);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(MedialAxis, OfASquareIsItsDiagonals) {
    constexpr double side = 20.0;
    const MedialAxis axis = medial_axis({box_ring({5, 5}, {5 + side, 5 + side})});
    EXPECT_EQ(axis.parts, 1);
    EXPECT_NEAR(axis_length(axis), 4.0 * side / std::sqrt(2.0), exact_mm);
    EXPECT_NEAR(clearance_near(axis, {15, 15}), side / 2.0, exact_mm);
    for (const Vec2& corner : axis.region.front()) {
        EXPECT_DOUBLE_EQ(clearance_near(axis, corner), 0.0);
    }
    for (const AxisEdge& edge : axis.edges) {
        for (const Vec3& at : edge.way) {
            EXPECT_NEAR(std::abs(at.x() - 15.0), std::abs(at.y() - 15.0), exact_mm);
        }
    }
}

TEST(MedialAxis, OfARectangleHasARidgeOfItsHalfWidth) {
    const MedialAxis axis = medial_axis({box_ring({0, 0}, {40, 20})});
    EXPECT_NEAR(clearance_near(axis, {10, 10}), 10.0, exact_mm);
    EXPECT_NEAR(clearance_near(axis, {30, 10}), 10.0, exact_mm);
    EXPECT_NEAR(axis_length(axis), 20.0 + 4.0 * 10.0 * std::sqrt(2.0), exact_mm);
}

TEST(MedialAxis, OfADiscIsItsMiddleWherePruningTakesTheCornersOfItsChords) {
    constexpr int chords = 720;
    const MedialAxis axis = medial_axis({disc_ring({3, 4}, 10.0, chords)});
    ASSERT_EQ(axis.nodes.size(), 1U);
    EXPECT_TRUE(axis.edges.empty());
    EXPECT_NEAR((axis.nodes[0].at - Vec2(3, 4)).norm(), 0.0, 0.005);
    EXPECT_NEAR(axis.nodes[0].clearance, 10.0 * std::cos(pi / chords), 0.0026);
    EXPECT_NEAR(axis_length(medial_axis({disc_ring({3, 4}, 10.0, chords)}, unpruned)), chords * 10.0, 72.0);
}

TEST(MedialAxis, OfARingIsItsMiddleCircle) {
    const MedialAxis axis =
        medial_axis({disc_ring(Vec2::Zero(), 10.0, 720), disc_ring(Vec2::Zero(), 5.0, 720)});
    EXPECT_EQ(axis.parts, 1);
    ASSERT_EQ(axis.ring_parts.size(), 2U);
    EXPECT_NEAR(axis_length(axis), 2.0 * pi * 7.5, 0.05);
    for (const AxisEdge& edge : axis.edges) {
        for (const Vec3& at : edge.way) {
            EXPECT_NEAR(at.head<2>().norm(), 7.5, 0.002);
            EXPECT_NEAR(at.z(), 2.5, 0.002);
        }
    }
}

// Between the corner at (20, 20) and the side on y = 0: y = (x - 20)^2 / 40 + 10.
TEST(MedialAxis, OfAnEllGoesRoundItsInnerCornerOnParabolas) {
    const MedialAxis axis = medial_axis(ell(), unpruned);
    const double bend = 40.0 - std::sqrt(800.0);
    EXPECT_NEAR(clearance_near(axis, {bend, bend}), bend, exact_mm);
    int on_parabola = 0;
    for (const AxisEdge& edge : axis.edges) {
        for (const Vec3& at : edge.way) {
            if (at.x() > bend + 0.1 && at.x() < 19.9 && at.y() < 12.0 && at.y() > 9.0) {
                ++on_parabola;
                EXPECT_NEAR(at.y(), (at.x() - 20.0) * (at.x() - 20.0) / 40.0 + 10.0, exact_mm);
                EXPECT_NEAR(at.z(), at.y(), exact_mm);
            }
        }
    }
    EXPECT_GT(on_parabola, 10);
    expect_true_clearance(axis, ell(), unpruned.sampling);
}

TEST(MedialAxis, ClearanceIsThatOfBruteForce) {
    for (const Region& region :
         {letter(), random_star(1, 9), random_star(2, 40), random_star(3, 200), turned(letter(), 0.7, 3.0)}) {
        const MedialAxis axis = medial_axis(region, unpruned);
        EXPECT_EQ(axis.parts, 1);
        EXPECT_EQ(axis.crossings.count, 0U);
        expect_true_clearance(axis, region, unpruned.sampling);
        double farthest = 0.0; // of places at random, whose clearance the axis surpasses
        for (const Vec2& place : places_inside(region, 2000, 7)) {
            farthest = std::max(farthest, brute_clearance(region, place));
        }
        EXPECT_GE(widest_clearance(axis), farthest - exact_mm);
    }
}

TEST(MedialAxis, PruningLosesNoMoreThanItMay) {
    constexpr double pruning = 0.2;
    constexpr double step = 0.02;
    const Region region = random_star(5, 60);
    const MedialAxis full = medial_axis(region, unpruned);
    const MedialAxis pruned = medial_axis(region, {.sampling = 0.0025, .pruning = pruning});
    EXPECT_LT(axis_length(pruned), axis_length(full));
    for (const Vec2& place : places_inside(region, 300, 11)) {
        double reached = -1.0; // inside of a disc, from its rim
        for (const AxisEdge& edge : pruned.edges) {
            for (std::size_t n = 1; n < edge.way.size(); ++n) {
                const Vec3 way = edge.way[n] - edge.way[n - 1];
                const double parts = std::ceil(way.norm() / step);
                for (double k = 0.0; k <= parts; k += 1.0) {
                    const Vec3 at = edge.way[n - 1] + k / std::max(parts, 1.0) * way;
                    reached = std::max(reached, at.z() - (at.head<2>() - place).norm());
                }
            }
        }
        EXPECT_GE(reached, -pruning - step);
    }
}

TEST(MedialAxis, TurnsAndGrowsWithItsOutline) {
    for (const Region& region : {ell(), letter(), random_star(4, 30)}) {
        const MedialAxis axis = medial_axis(region, unpruned);
        constexpr double scale = 2.7;
        const MedialAxis turned_axis =
            medial_axis(turned(region, 0.31, scale), {.sampling = scale * 0.0025, .pruning = 0.0});
        EXPECT_NEAR(axis_length(turned_axis), scale * axis_length(axis), 1e-4 * axis_length(axis));
        EXPECT_NEAR(widest_clearance(turned_axis), scale * widest_clearance(axis), 1e-4);
        EXPECT_EQ(turned_axis.edges.size(), axis.edges.size());
    }
}

TEST(MedialAxis, OfTheSameOutlineIsTheSame) {
    const MedialAxis one = medial_axis(random_star(6, 100));
    const MedialAxis other = medial_axis(random_star(6, 100));
    ASSERT_EQ(one.edges.size(), other.edges.size());
    for (std::size_t n = 0; n < one.edges.size(); ++n) {
        EXPECT_EQ(one.edges[n].way, other.edges[n].way);
    }
}

TEST(MedialAxis, NumbersPartsAndTheirRings) {
    const MedialAxis axis = medial_axis({box_ring({0, 0}, {10, 10}),
                                         box_ring({20, 0}, {40, 20}),
                                         box_ring({24, 4}, {36, 16}),   // a hole
                                         box_ring({28, 8}, {32, 12})}); // an island in it
    EXPECT_EQ(axis.parts, 3);
    ASSERT_EQ(axis.ring_parts.size(), 4U);
    std::vector<int> rings(3, 0);
    for (const int part : axis.ring_parts) {
        ++rings.at(static_cast<std::size_t>(part));
    }
    EXPECT_THAT(rings, testing::UnorderedElementsAre(1, 2, 1));
}

TEST(MedialAxis, CrossingsAreCountedWithTheirPlaceAndFilledByTheEvenOddRule) {
    const MedialAxis axis = medial_axis({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}});
    EXPECT_EQ(axis.crossings.count, 1U);
    EXPECT_NEAR((axis.crossings.first - Vec2(5, 5)).norm(), 0.0, exact_mm);
    for (const AxisEdge& edge : axis.edges) {
        for (const Vec3& at : edge.way) {
            EXPECT_LE(std::abs(at.y() - 5.0),
                      std::abs(at.x() - 5.0) + exact_mm); // left and right of it alone
        }
    }
}

TEST(MedialAxis, OutlinesThatTouchAreOneInside) {
    // Corner to corner, an end on the middle of a side, and a side in common.
    const Region corners{box_ring({0, 0}, {10, 10}), box_ring({10, 10}, {20, 20})};
    EXPECT_EQ(medial_axis(corners).crossings.count, 0U);
    EXPECT_NEAR(widest_clearance(medial_axis(corners)), 5.0, exact_mm);
    const Region touching{box_ring({0, 0}, {20, 20}), {{10, 0}, {15, 8}, {5, 8}}};
    expect_true_clearance(medial_axis(touching, unpruned), touching, unpruned.sampling);
    const Region side{box_ring({0, 0}, {10, 10}), box_ring({10, 0}, {20, 10})};
    const MedialAxis joined = medial_axis(side);
    EXPECT_EQ(joined.crossings.count, 1U); // what has a length in common
    EXPECT_EQ(joined.parts, 1);
    EXPECT_NEAR(axis_length(joined), 10.0 + 4.0 * 5.0 * std::sqrt(2.0), exact_mm);
}

TEST(MedialAxis, ManyCrossingsNearOneAnotherHaveAnInside) {
    Region tangle;
    for (int n = 0; n < 10; ++n) {
        const double angle = 0.3 * n;
        tangle.push_back(turned({{{0, 0}, {30, 0.01}, {30, 0.02}, {0, 0.01}}}, angle, 1.0).front());
        tangle.push_back(turned({box_ring({-3, -3}, {3, 3})}, angle, 1.0).front());
    }
    const MedialAxis axis = medial_axis(tangle, unpruned);
    EXPECT_GT(axis.crossings.count, 200U);
    expect_true_clearance(axis, axis.region, unpruned.sampling);
}

TEST(MedialAxis, WhatEnclosesNothingOrIsRepeatedIsCountedAndLeftOut) {
    const Ring square = box_ring({0, 0}, {10, 10});
    Ring again(square.rbegin(), square.rend());
    Ring stuttering;
    for (const Vec2& p : square) {
        stuttering.insert(stuttering.end(), 3, p);
    }
    const MedialAxis axis = medial_axis({stuttering, again, {{1, 1}, {5, 5}, {9, 9}}, {{2, 2}, {2, 2}}, {}});
    EXPECT_EQ(axis.repeated.count, 1U);
    EXPECT_EQ(axis.flat.count, 2U);
    EXPECT_EQ(axis.flat.first, Vec2(1, 1));
    EXPECT_NEAR(axis_length(axis), 40.0 / std::sqrt(2.0), exact_mm);
    EXPECT_EQ(medial_axis({{{1, 1}, {5, 5}, {9, 9}}}).parts, 0);
    EXPECT_EQ(medial_axis({}).parts, 0);
}

TEST(MedialAxis, FarFromTheOriginIsAsExactAsNearIt) {
    Region far = letter();
    for (Ring& ring : far) {
        for (Vec2& p : ring) {
            p += Vec2(900'000.0, -900'000.0);
        }
    }
    EXPECT_NEAR(axis_length(medial_axis(far, unpruned)), axis_length(medial_axis(letter(), unpruned)), 1e-4);
}

TEST(MedialAxis, RefusesWhatItCannotHold) {
    const millwright::test::WithoutTraps no_traps;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal_of({box_ring({0, 0}, {nan, 10})}), HasSubstr("nan"));
    EXPECT_THAT(refusal_of({box_ring({0, 0}, {2e6, 10})}), HasSubstr("a point at (2e+06, 0) mm"));
    const Region wide{box_ring({-9e5, -9e5}, {9e5, 9e5})};
    EXPECT_THAT(
        refusal_of(wide),
        HasSubstr("outlines 1.8e+06 mm wide can be carved to a tolerance of 0.02 mm, not of 0.0025 mm"));
    EXPECT_EQ(refusal_of(wide, {.sampling = 0.1, .pruning = 0.1}), "");
    EXPECT_THAT(refusal_of(ell(), {.sampling = 0.0}), HasSubstr("a medial axis to 0 mm"));
    EXPECT_THAT(refusal_of(ell(), {.sampling = nan}), HasSubstr("a medial axis to nan mm"));
    EXPECT_THAT(refusal_of({disc_ring(Vec2::Zero(), 100.0, 1'000'001)}), HasSubstr("1000001 points"));
}

TEST(MedialAxis, OfAHundredThousandSegmentsReportsProgressAndCanBeCancelled) {
    const Region many{petals(100'000)};
    std::vector<double> reports;
    const Progress listening([&](const Progress::Report& report) { reports.push_back(report.fraction); }, {});
    const MedialAxis axis = medial_axis(many, {}, listening);
    EXPECT_EQ(axis.parts, 1);
    EXPECT_GT(reports.size(), 2U);
    EXPECT_TRUE(std::ranges::is_sorted(reports));
    std::stop_source stop;
    const Progress stopping([&](const Progress::Report&) { stop.request_stop(); }, stop.get_token());
    EXPECT_THROW((void)medial_axis(many, {}, stopping), Cancelled);
}

} // namespace
} // namespace millwright::plot
