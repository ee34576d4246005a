#include "core/toolpath/turning_over.h"

#include "core/base/error.h"
#include "core/geometry/presets.h"
#include "core/toolpath/zigzag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::toolpath {
namespace {

using geometry::BezierPatch;
using geometry::ControlNet;
using geometry::Trim;
using grid::Grid;
using grid::TrackDirection;

/// A sheet whose last row of control points is in reverse order: it shrinks to a point at u = 0.5 for a
/// plane.
BezierPatch bow_tie(double rise) {
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

Toolpath contacts(const BezierPatch& patch, int nodes, TrackDirection direction) {
    return zigzag(patch, Grid::uniform(nodes, nodes), direction, false);
}

TEST(TurningOver, TheFlipIsFoundWhereTheBowTieShrinks) {
    const auto found = flip_between(bow_tie(15.0), {0.3, 0.1}, {0.8, 0.1});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x(), 0.5, 1e-6);
    EXPECT_FALSE(flip_between(bow_tie(15.0), {0.6, 0.1}, {0.8, 0.1}));
}

TEST(TurningOver, ABowTieIsRefusedWithItsPlace) {
    for (const auto direction : {TrackDirection::along_u, TrackDirection::along_v}) {
        const BezierPatch patch = bow_tie(15.0);
        try {
            refuse_turning_over(patch, {}, contacts(patch, 8, direction));
            FAIL() << "not refused";
        } catch (const Error& error) {
            EXPECT_THAT(error.diagnostic().message, ::testing::HasSubstr("turns over on itself"));
            EXPECT_THAT(error.diagnostic().message, ::testing::HasSubstr("at u 0.5000"));
        }
    }
}

TEST(TurningOver, WhatIsCutAwayMayTurnOver) {
    const BezierPatch patch = bow_tie(15.0);
    const Trim below{{{{0.0, 0.0}, {0.4, 0.0}, {0.4, 1.0}, {0.0, 1.0}}}};
    EXPECT_NO_THROW(refuse_turning_over(patch, below, contacts(patch, 8, TrackDirection::along_u)));
}

TEST(TurningOver, SteepAndCurvedSurfacesArePassed) {
    const BezierPatch wall = steep();
    const auto path = contacts(wall, 2, TrackDirection::along_u);
    EXPECT_LT(path.points[0].normal.dot(path.points[1].normal), 0.0)
        << "by a coarse grid it turns round at once";
    EXPECT_NO_THROW(refuse_turning_over(wall, {}, path));
    for (const auto& preset : geometry::surface_presets()) {
        const BezierPatch patch = preset.make().patch(geometry::PatchId{0});
        EXPECT_NO_THROW(refuse_turning_over(patch, {}, contacts(patch, 12, TrackDirection::along_v)));
    }
}

} // namespace
} // namespace millwright::toolpath
