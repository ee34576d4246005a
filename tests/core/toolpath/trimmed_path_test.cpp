#include "core/toolpath/trimmed_path.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/toolpath/spiral.h"
#include "core/toolpath/strategy.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/cutters.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::toolpath {
namespace {

using geometry::Trim;
using grid::Grid;
using grid::TrackDirection;

/// A square with a square hole.
Trim frame() {
    return {
        {{{0.2, 0.1}, {0.8, 0.1}, {0.8, 0.9}, {0.2, 0.9}}, {{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}}}};
}

/// By hand, not by Trim.
bool in_frame(const Vec2& uv, double grown) {
    const auto within = [&](double low, double high, double value) { return value > low && value < high; };
    const bool outer = within(0.2 - grown, 0.8 + grown, uv.x()) && within(0.1 - grown, 0.9 + grown, uv.y());
    const bool hole = within(0.4 + grown, 0.6 - grown, uv.x()) && within(0.4 + grown, 0.6 - grown, uv.y());
    return outer && !hole;
}

double cut_length(const Toolpath& path) {
    double sum = 0.0;
    for (std::size_t n = 1; n < path.points.size(); ++n) {
        if (path.points[n].reached_by == MoveKind::track) {
            sum += (path.points[n].origin.uv - path.points[n - 1].origin.uv).norm();
        }
    }
    return sum;
}

TEST(TrimmedPath, WithoutAnOutlineIsTheSame) {
    const Toolpath whole = zigzag(test::patch("dome"), Grid::uniform(5, 6), TrackDirection::along_v, false);
    const Toolpath same = trimmed(test::patch("dome"), {}, whole, false);
    ASSERT_EQ(same.points.size(), whole.points.size());
}

TEST(TrimmedPath, CutsInsideOnlyAndAllOfThat) {
    const auto patch = test::patch("dome");
    const Toolpath whole = zigzag(patch, Grid::uniform(21, 13), TrackDirection::along_v, false);
    const Toolpath path = trimmed(patch, frame(), whole, false);
    EXPECT_EQ(path.points.front().reached_by, MoveKind::start);
    for (std::size_t n = 1; n < path.points.size(); ++n) {
        const PathPoint& a = path.points[n - 1];
        const PathPoint& b = path.points[n];
        EXPECT_EQ(b.contact, patch.position(b.origin.uv.x(), b.origin.uv.y()));
        for (double t = 0.05; t < 1.0 && b.reached_by == MoveKind::track; t += 0.1) {
            const Vec2 at = a.origin.uv + t * (b.origin.uv - a.origin.uv);
            EXPECT_TRUE(in_frame(at, 1e-6)) << at.transpose();
        }
    }
    // Tracks at u = 0.25 ... 0.75 and on the sides 0.2, 0.8, of which the rule keeps one or none.
    double expected = 0.0;
    for (int k = 5; k <= 15; ++k) {
        const double u = k / 20.0;
        expected += u > 0.4 + 1e-9 && u < 0.6 - 1e-9 ? 0.6 : 0.8;
    }
    const double kept = cut_length(path);
    EXPECT_GT(kept,
              expected - 2.0 * 0.2 - 1e-6); // the tracks along the sides of the hole may be whole or not
    EXPECT_LT(kept, expected + 2.0 * 0.8 + 1e-6);
}

TEST(TrimmedPath, GoesOverTheHoleAndLinksWhereItCan) {
    const auto patch = test::patch("dome");
    const Toolpath whole = zigzag(patch, Grid::uniform(8, 9), TrackDirection::along_v, false);
    const Toolpath path = trimmed(patch,
                                  {{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}},
                                    {{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}}}},
                                  whole,
                                  false);
    const auto count = [&](MoveKind kind) {
        return std::ranges::count(path.points, kind, &PathPoint::reached_by);
    };
    EXPECT_EQ(count(MoveKind::cross), 7) << "ends of tracks on the border of the patch";
    EXPECT_EQ(count(MoveKind::over), 2) << "u = 3/7 and 4/7 meet the hole";
    EXPECT_LT(length(path), length(whole)) << "what is gone over does not count";
}

TEST(TrimmedPath, EveryStrategyStaysInside) {
    const auto patch = test::patch("dome");
    const auto machine = test::machine("ac-table");
    const Tool tool;
    const Grid grid = Grid::uniform(11, 11);
    const Toolpath spiral =
        Spiral().contacts({patch, machine, tool, grid, TrackDirection::along_v, false}, Progress());
    const Toolpath path = trimmed(patch, frame(), spiral, false);
    ASSERT_GT(path.points.size(), 20U);
    for (const PathPoint& point : path.points) {
        EXPECT_TRUE(in_frame(point.origin.uv, 1e-6));
    }
}

/// A sheet that shrinks to a point on u = 0.5.
geometry::BezierPatch flat_bow_tie() {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    for (int j = 0; j < 2; ++j) {
        net.point(0, j) = {0.0, 60.0 * j, 0.0};
        net.point(1, j) = {60.0, 60.0 * (1 - j), 0.0};
    }
    return geometry::BezierPatch(net);
}

TEST(TrimmedPath, NodesWithoutANormalAreNoHarmWhereNothingIsCut) {
    const auto patch = flat_bow_tie();
    const Grid grid = Grid::uniform(9, 5); // with a row on u = 0.5
    EXPECT_THROW((void)zigzag(patch, grid, TrackDirection::along_u, false), Error);
    const Trim ends{{{{0.0, 0.0}, {0.375, 0.0}, {0.375, 1.0}, {0.0, 1.0}},
                     {{0.625, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.625, 1.0}}}}; // through nodes
    const geometry::OutlineTree outline(ends);
    for (const auto direction : {TrackDirection::along_u, TrackDirection::along_v}) {
        const Toolpath path = trimmed(patch, ends, zigzag(patch, grid, direction, false, &outline), false);
        for (const PathPoint& point : path.points) {
            EXPECT_NEAR(point.normal.norm(), 1.0, 1e-12) << point.origin.uv.transpose();
            EXPECT_NE(point.origin.uv.x(), 0.5);
        }
    }
}

/// A flat triangle, whose side u = 0 is one point.
geometry::BezierPatch triangle() {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    for (int j = 0; j < 2; ++j) {
        net.point(0, j) = Vec3::Zero();
        net.point(1, j) = {60.0, 60.0 * j - 30.0, 0.0};
    }
    return geometry::BezierPatch(net);
}

Toolpath trimmed_cover(const geometry::BezierPatch& patch,
                       const Trim& trim,
                       StrategyKind kind,
                       TrackDirection direction,
                       bool knows_outline = true) {
    const auto machine = test::machine("ac-table");
    const Tool tool =
        kind == StrategyKind::constant_scallop ? Tool{.cutter = test::body(test::ball)} : Tool{};
    const Grid grid = Grid::uniform(9, 5); // with a row on u = 0.5
    const geometry::OutlineTree outline(trim);
    const Covering all{patch, machine, tool, grid, direction, false, knows_outline ? &outline : nullptr};
    const auto strategy = make_strategy({.kind = kind, .scallop = 0.2, .tolerance = 0.5});
    return trimmed(patch, trim, strategy->contacts(all, Progress()), false);
}

// All but the zigzag refused it.
TEST(TrimmedPath, NoStrategyNeedsANormalWhereNothingIsCut) {
    const auto patch = triangle();
    const Trim far_side{{{{0.25, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.25, 1.0}}}};
    for (const auto kind : {StrategyKind::zigzag,
                            StrategyKind::spiral,
                            StrategyKind::constant_scallop,
                            StrategyKind::fewest_points}) {
        for (const auto direction : {TrackDirection::along_u, TrackDirection::along_v}) {
            if (kind != StrategyKind::fewest_points) { // which refuses after a long search
                EXPECT_THROW((void)trimmed_cover(patch, far_side, kind, direction, false), Error);
            }
            const Toolpath path = trimmed_cover(patch, far_side, kind, direction);
            double low = 1.0, high = 0.0;
            for (const PathPoint& point : path.points) {
                EXPECT_NEAR(point.normal.norm(), 1.0, 1e-12) << point.origin.uv.transpose();
                low = std::min(low, point.origin.uv.x());
                high = std::max(high, point.origin.uv.x());
            }
            EXPECT_GE(low, 0.25 - 1e-9) << static_cast<int>(kind);
            EXPECT_LE(low, 0.375) << static_cast<int>(kind);
            EXPECT_EQ(high, 1.0) << static_cast<int>(kind);
        }
    }
}

TEST(TrimmedPath, AHoleInWhichTheSurfaceTurnsOverIsNoHarm) {
    const auto patch = flat_bow_tie();
    const Trim ends{{{{0.0, 0.0}, {0.375, 0.0}, {0.375, 1.0}, {0.0, 1.0}},
                     {{0.625, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.625, 1.0}}}};
    for (const auto kind : {StrategyKind::spiral, StrategyKind::constant_scallop}) {
        for (const auto direction : {TrackDirection::along_u, TrackDirection::along_v}) {
            for (const PathPoint& point : trimmed_cover(patch, ends, kind, direction).points) {
                EXPECT_GE(std::abs(point.origin.uv.x() - 0.5), 0.125 - 1e-9);
                EXPECT_NEAR(std::abs(point.normal.z()), 1.0, 1e-12);
            }
        }
    }
}

/// The pieces of a track beside a hole begin and end at it, each with as few points as it needs.
TEST(TrimmedPath, FewestPointsAreThoseOfThePiecesThatAreCut) {
    const auto patch = test::patch("dome");
    const Toolpath path = trimmed_cover(patch, frame(), StrategyKind::fewest_points, TrackDirection::along_v);
    const Toolpath whole =
        trimmed_cover(patch, frame(), StrategyKind::fewest_points, TrackDirection::along_v, false);
    EXPECT_LT(path.points.size(), whole.points.size());
    EXPECT_NEAR(cut_length(path), cut_length(whole), 1e-9);
}

int count_of(const Toolpath& path, MoveKind kind) {
    return static_cast<int>(std::ranges::count(path.points, kind, &PathPoint::reached_by));
}

/// A chord along an outline is no way over the surface, however the ends of pieces are rounded.
TEST(TrimmedPath, FewestPointsGoFromTrackToTrackAlongTheSurfaceAtTheirOwnEndsAlone) {
    const auto patch = test::patch("dome");
    Trim::Loop round;
    for (int n = 0; n < 64; ++n) {
        const double angle = 2.0 * pi * n / 64.0;
        round.emplace_back(0.5 + 0.45 * std::cos(angle), 0.5 + 0.45 * std::sin(angle));
    }
    for (const auto direction : {TrackDirection::along_u, TrackDirection::along_v}) {
        for (const Trim& trim : {Trim{{round}}, frame()}) {
            const Toolpath path = trimmed_cover(patch, trim, StrategyKind::fewest_points, direction);
            EXPECT_EQ(count_of(path, MoveKind::cross), 0);
            EXPECT_GE(count_of(path, MoveKind::over), 2);
        }
    }
    const Trim beside{{{{0.25, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.25, 1.0}}}};
    const Toolpath path = trimmed_cover(patch, beside, StrategyKind::fewest_points, TrackDirection::along_v);
    EXPECT_EQ(count_of(path, MoveKind::over), 0);
    EXPECT_GT(count_of(path, MoveKind::cross), 2);
}

TEST(TrimmedPath, NothingLeftIsToldWithAHint) {
    const auto patch = test::patch("dome");
    const Toolpath whole = zigzag(patch, Grid::uniform(3, 3), TrackDirection::along_v, false);
    const Trim between{{{{0.1, 0.1}, {0.2, 0.1}, {0.2, 0.2}, {0.1, 0.2}}}};
    try {
        (void)trimmed(patch, between, whole, false);
        FAIL() << "no track meets it";
    } catch (const Error& error) {
        EXPECT_NE(error.diagnostic().hint.find("more tracks"), std::string::npos);
    }
}

} // namespace
} // namespace millwright::toolpath
