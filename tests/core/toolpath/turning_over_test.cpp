#include "core/toolpath/turning_over.h"

#include "core/base/error.h"
#include "core/geometry/presets.h"
#include "core/toolpath/zigzag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace millwright::toolpath {
namespace {

using geometry::BezierPatch;
using geometry::ControlNet;
using geometry::Trim;
using grid::Grid;
using grid::TrackDirection;

/// A sheet whose last row of control points is in reverse order: it shrinks to a point at u = 0.5 for a
/// plane.
BezierPatch rising_bow_tie(double rise) {
    ControlNet net = ControlNet::sized(2, 4);
    for (int j = 0; j < 4; ++j) {
        net.point(0, j) = {0.0, 20.0 * j, 0.0};
        net.point(1, j) = {60.0, 20.0 * (3 - j), rise};
    }
    return BezierPatch(net);
}

/// An arch whose sides are all but upright.
BezierPatch steep() {
    ControlNet net = ControlNet::sized(3, 2);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = {20.0 * i, 50.0 * j, i == 1 ? 400.0 : 0.0};
        }
    }
    return BezierPatch(net);
}

/// A plane that is narrow and turned over between u = 0.28 and u = 0.72.
BezierPatch twice_over() {
    ControlNet net = ControlNet::sized(3, 2);
    for (int i = 0; i < 3; ++i) {
        const double half = i == 1 ? -15.0 : 10.0;
        net.point(i, 0) = {20.0 * i, -half, 0.0};
        net.point(i, 1) = {20.0 * i, half, 0.0};
    }
    return BezierPatch(net);
}

/// A plane whose inner control points were pulled past each other: it lies the wrong way up in its middle
/// alone, for u between 0.22 and 0.78 and v between 0.34 and 0.66.
BezierPatch pinched() {
    ControlNet net = ControlNet::sized(4, 4);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const bool inner = (i == 1 || i == 2) && (j == 1 || j == 2);
            net.point(i, j) = {20.0 * i, inner ? 240.0 - 140.0 * j : 20.0 * j, 0.0};
        }
    }
    return BezierPatch(net);
}

Trim::Loop square(double low, double high) {
    return {{low, low}, {high, low}, {high, high}, {low, high}};
}

void refuse_zigzag(const BezierPatch& patch, const Trim& trim, int nodes, TrackDirection direction) {
    const Grid grid = Grid::uniform(nodes, nodes);
    const geometry::OutlineTree outline(trim);
    refuse_turning_over(patch, trim, grid, zigzag(patch, grid, direction, false, &outline));
}

constexpr std::array both{TrackDirection::along_u, TrackDirection::along_v};

TEST(TurningOver, TheFlipIsFoundWhereTheBowTieShrinks) {
    const auto found = flip_between(rising_bow_tie(15.0), {0.3, 0.1}, {0.8, 0.1});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x(), 0.5, 1e-6);
    EXPECT_FALSE(flip_between(rising_bow_tie(15.0), {0.6, 0.1}, {0.8, 0.1}));
}

TEST(TurningOver, ABowTieIsRefusedWithItsPlace) {
    for (const auto direction : both) {
        try {
            refuse_zigzag(rising_bow_tie(15.0), {}, 8, direction);
            FAIL() << "not refused";
        } catch (const Error& error) {
            EXPECT_THAT(error.diagnostic().message, ::testing::HasSubstr("folds over itself"));
            EXPECT_THAT(error.diagnostic().message, ::testing::HasSubstr("at u 0.5000"));
        }
    }
}

TEST(TurningOver, WhatIsCutAwayMayTurnOver) {
    const Trim below{{{{0.0, 0.0}, {0.4, 0.0}, {0.4, 1.0}, {0.0, 1.0}}}};
    const Trim both_ends{{below.loops.front(), {{0.6, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.6, 1.0}}}};
    for (const auto direction : both) {
        EXPECT_NO_THROW(refuse_zigzag(rising_bow_tie(15.0), below, 8, direction));
        EXPECT_NO_THROW(refuse_zigzag(rising_bow_tie(15.0), both_ends, 8, direction))
            << "no cut leads across";
    }
}

TEST(TurningOver, AFlipInsideAHoleOfAFaceIsPassedAndOneBesideItIsNot) {
    const BezierPatch patch = pinched();
    double least_up = 1.0; // of the face with the wide hole, on its own raster
    const Trim wide{{square(0.0, 1.0), square(0.2, 0.8)}};
    for (int k = 0; k <= 40 * 40; ++k) {
        const Vec2 at = Vec2(k / 41, k % 41) / 40.0;
        if (wide.contains(at)) {
            least_up = std::min(least_up, patch.unit_normal(at.x(), at.y())->z());
        }
    }
    ASSERT_GT(least_up, 0.0);
    ASSERT_LT(patch.unit_normal(0.5, 0.5)->z(), 0.0);
    ASSERT_FALSE(patch.unit_normal(0.5, 2.0 / 6.0));
    const Trim narrow{{square(0.0, 1.0), square(0.48, 0.52)}};
    for (const auto direction : both) {
        EXPECT_NO_THROW(refuse_zigzag(patch, wide, 7, direction)) << "nodes in the hole have no normal";
        EXPECT_THROW(refuse_zigzag(patch, narrow, 8, direction), Error);
    }
}

TEST(TurningOver, AFlipBeforeAHoleIsRefusedWhereTheHoleEndsTheRightWayUp) {
    const BezierPatch patch = twice_over();
    const Trim before_and_behind{{{{0.0, 0.0}, {0.45, 0.0}, {0.45, 1.0}, {0.0, 1.0}},
                                  {{0.9, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.9, 1.0}}}};
    ASSERT_GT(patch.unit_normal(0.0, 0.5)->dot(*patch.unit_normal(1.0, 0.5)), 0.0);
    EXPECT_THROW(refuse_zigzag(patch, before_and_behind, 2, TrackDirection::along_u), Error);
}

TEST(TurningOver, AFlipBetweenTwoTracksIsRefusedWhereTheirLinksAreCutAway) {
    EXPECT_THROW(refuse_zigzag(rising_bow_tie(15.0), {{square(0.2, 0.8)}}, 8, TrackDirection::along_v),
                 Error);
}

TEST(TurningOver, SteepAndCurvedSurfacesArePassed) {
    const BezierPatch wall = steep();
    EXPECT_LT(wall.unit_normal(0.0, 0.5)->dot(*wall.unit_normal(1.0, 0.5)), 0.0)
        << "by a coarse grid it turns round at once";
    EXPECT_NO_THROW(refuse_zigzag(wall, {}, 2, TrackDirection::along_u));
    for (const auto& preset : geometry::surface_presets()) {
        EXPECT_NO_THROW(
            refuse_zigzag(preset.make().patch(geometry::PatchId{0}), {}, 12, TrackDirection::along_v));
    }
}

} // namespace
} // namespace millwright::toolpath
