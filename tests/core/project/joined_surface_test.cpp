#include "core/project/joined_surface.h"

#include "core/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::project {
namespace {

/// Flat, over four corners: u = 0 and v = 0, u = 1 and v = 0, then both at v = 1.
geometry::ControlNet flat(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    net.point(0, 0) = {a.x(), a.y(), 0.0};
    net.point(1, 0) = {b.x(), b.y(), 0.0};
    net.point(0, 1) = {c.x(), c.y(), 0.0};
    net.point(1, 1) = {d.x(), d.y(), 0.0};
    return net;
}

/// Squares of 10 mm beside each other with gaps.
SurfaceInput row_of_squares(int count, double gap) {
    SurfaceInput surface;
    for (int n = 0; n < count; ++n) {
        const double x = n * (10.0 + gap);
        surface.patches.push_back(flat({x, 0.0}, {x + 10.0, 0.0}, {x, 10.0}, {x + 10.0, 10.0}));
    }
    return surface;
}

/// Its neighbours above and below pull the corners of the first patch towards the second one.
TEST(JoinedSurface, WhatIsSaidOfAnOpenSeamIsWhyItWasLeftOpen) {
    SurfaceInput surface = row_of_squares(2, 2.05);
    surface.patches.push_back(flat({0.0, 10.0}, {11.2, 10.0}, {0.0, 21.0}, {10.0, 21.0}));
    surface.patches.push_back(flat({0.0, -11.0}, {10.0, -11.0}, {0.0, 0.0}, {11.2, 0.0}));
    const JoinedSurface joined = joined_surface(surface, geometry::Continuity::position, 2.0);
    EXPECT_EQ(joined.seams.size(), 2U);
    ASSERT_EQ(joined.open.size(), 1U);
    EXPECT_NEAR(joined.open.front().gap, 2.05, 1e-9) << "more than the limit of 2";
    EXPECT_EQ(open_text(joined.open), "0 u = 1 - 1 u = 0 with a gap of 2.0500 mm");
    const double after = joined.surface.patches[1].point(0, 0).x() -
                         joined.surface.patches[0].point(joined.surface.patches[0].rows - 1, 0).x();
    EXPECT_LT(after, 2.0) << "the corner was pulled";
}

TEST(JoinedSurface, NamesEightOpenSeamsAndCountsTheRest) {
    try {
        (void)joined_surface(row_of_squares(12, 1.0), geometry::Continuity::position, 0.5);
        FAIL() << "nothing is within the gap";
    } catch (const Error& error) {
        EXPECT_THAT(
            error.what(),
            ::testing::HasSubstr("within 0.5 mm of each other; open seams: 0 u = 1 - 1 u = 0 with a gap"));
        EXPECT_THAT(error.what(),
                    ::testing::HasSubstr("7 u = 1 - 8 u = 0 with a gap of 1.0000 mm, and 3 more"));
    }
}

} // namespace
} // namespace millwright::project
