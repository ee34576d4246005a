#include "core/plot/compensation.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/core/plot_strokes/circle_ring.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace millwright::plot {
namespace {

using test::circle_ring;

Ring square_ring(double lower, double upper) {
    return {{lower, lower}, {upper, lower}, {upper, upper}, {lower, upper}};
}

double distance_to_region(const Region& region, const Vec2& p) {
    double least = std::numeric_limits<double>::max();
    for (const Ring& ring : region) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const Vec2 ab = ring[(n + 1) % ring.size()] - ring[n];
            const double t = std::clamp((p - ring[n]).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
            least = std::min(least, (ring[n] + t * ab - p).norm());
        }
    }
    return least;
}

// The two jobs of the KMITL thesis of 2006: 412 mm around the square, 323.58 mm around the circle.
TEST(Compensation, PathsOfTheThesisHaveTheirLengths) {
    const Strokes around = compensated({square_ring(0.0, 100.0)}, {.tool_diameter = 3.0});
    ASSERT_EQ(around.size(), 1U);
    EXPECT_NEAR(draw_length(around), 412.0, 1e-5);
    const Strokes ring = compensated({circle_ring(50.0, 3600)}, {.tool_diameter = 3.0});
    EXPECT_NEAR(draw_length(ring), 323.58, 0.01);
    for (const Vec2& p : ring.at(0).points) {
        EXPECT_NEAR(p.norm(), 51.5, 1e-4);
    }
    EXPECT_NEAR(
        draw_length(compensated({square_ring(0.0, 100.0)}, {.side = CutterSide::inside})), 388.0, 1e-5);
    EXPECT_NEAR(
        draw_length(compensated({square_ring(0.0, 100.0)}, {.side = CutterSide::on_line})), 400.0, 1e-12);
    const Strokes rounded =
        compensated({square_ring(0.0, 100.0)}, {.tool_diameter = 3.0, .corners = Corners::round});
    EXPECT_NEAR(draw_length(rounded), 400.0 + 2.0 * pi * 1.5, 0.02);
}

// Clipper gives rings in its own order and begins them at their top.
TEST(Compensation, BeginsWhereTheDrawingDoesAndKeepsItsOrder) {
    Region shapes;
    for (const double x : {120.0, 40.0, 80.0, 0.0}) {
        shapes.push_back({{x, 0.0}, {x + 20.0, 0.0}, {x + 20.0, 20.0}, {x, 20.0}});
    }
    const Strokes paths = compensated(shapes, {.tool_diameter = 3.0});
    ASSERT_EQ(paths.size(), shapes.size());
    for (std::size_t n = 0; n < shapes.size(); ++n) {
        EXPECT_LT((paths[n].points.front() - shapes[n].front()).norm(), 1.5 * std::sqrt(2.0) + 1e-6) << n;
        EXPECT_EQ(paths[n].points.front(), paths[n].points.back());
    }
}

TEST(Compensation, HolesAreKeptAndThoseTooSmallHaveNoPath) {
    const Region plate = {square_ring(0.0, 100.0), square_ring(30.0, 70.0), square_ring(10.0, 12.0)};
    const Strokes paths = compensated(plate, {.tool_diameter = 3.0});
    ASSERT_EQ(paths.size(), 2U);
    EXPECT_NEAR(draw_length(paths), 412.0 + 4.0 * 37.0, 1e-5);
}

// A frame of 2 mm with a square of 10 mm in it, and a square of 20 mm with a hole of 2 mm.
TEST(Compensation, PartsThatTheToolDoesNotFitIntoAreCounted) {
    const Region drawing = {square_ring(0.0, 40.0),
                            square_ring(2.0, 38.0),
                            square_ring(10.0, 20.0),
                            square_ring(50.0, 70.0),
                            square_ring(55.0, 57.0)};
    const auto too_narrow = [&](CutterSide side, double diameter) {
        return count_unreachable_regions(drawing, {.tool_diameter = diameter, .side = side});
    };
    EXPECT_EQ(too_narrow(CutterSide::inside, 1.0), 0U);
    EXPECT_EQ(too_narrow(CutterSide::inside, 3.0), 1U); // the frame
    EXPECT_EQ(too_narrow(CutterSide::inside, 12.0),
              2U); // and the square of 10 mm; 13 mm are left of the other
    EXPECT_EQ(too_narrow(CutterSide::inside, 30.0), 3U);
    EXPECT_EQ(too_narrow(CutterSide::outside, 1.0), 0U);
    EXPECT_EQ(too_narrow(CutterSide::outside, 3.0), 1U);  // the hole of 2 mm
    EXPECT_EQ(too_narrow(CutterSide::outside, 30.0), 2U); // and the inside of the frame, around its square
    EXPECT_EQ(too_narrow(CutterSide::on_line, 30.0), 0U);
}

// No point of the path is nearer to the outline than the tool's radius, however the outline crosses itself.
TEST(Compensation, NothingIsCutTooFar) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> coordinate(0.0, 100.0);
    for (int trial = 0; trial < 100; ++trial) {
        Region region(1);
        for (int n = 0; n < 8; ++n) {
            region[0].emplace_back(coordinate(random), coordinate(random));
        }
        for (const auto side : {CutterSide::outside, CutterSide::inside}) {
            for (const Stroke& path : compensated(region, {.tool_diameter = 4.0, .side = side})) {
                EXPECT_EQ(path.points.front(), path.points.back());
                for (std::size_t n = 1; n < path.points.size(); ++n) {
                    const Vec2 middle = (path.points[n] + path.points[n - 1]) / 2.0;
                    EXPECT_GT(distance_to_region(region, path.points[n]), 2.0 - 1e-4) << trial;
                    EXPECT_GT(distance_to_region(region, middle), 2.0 - 1e-4) << trial;
                    EXPECT_EQ(contains(region, middle), side == CutterSide::inside) << trial;
                }
            }
        }
    }
}

TEST(Compensation, ContoursFillAPocket) {
    const Strokes contours = contour_hatch({square_ring(0.0, 20.0)}, 1.0, 2.0);
    ASSERT_EQ(contours.size(), 5U); // sides of 18, 14, 10, 6, 2
    EXPECT_NEAR(draw_length(contours), 4.0 * (18.0 + 14.0 + 10.0 + 6.0 + 2.0), 1e-5);
    EXPECT_NEAR(length(contours.front()), 72.0, 1e-5);
}

TEST(Compensation, RefusesWhatHasNoPath) {
    const millwright::test::WithoutTraps no_traps;
    const Region region = {square_ring(0.0, 10.0)};
    EXPECT_THROW(static_cast<void>(compensated(region, {.tool_diameter = 0.0})), Error);
    EXPECT_THROW(static_cast<void>(compensated({square_ring(0.0, 1e7)}, {})), Error);
    EXPECT_THROW(static_cast<void>(compensated({{{0.0, 0.0}, {std::nan(""), 0.0}, {1.0, 1.0}}}, {})), Error);
    EXPECT_THROW(static_cast<void>(contour_hatch(region, 1.0, 0.0)), Error);
    EXPECT_THROW(static_cast<void>(contour_hatch(region, 0.0, 1e-7)), Error);
    EXPECT_TRUE(compensated({}, {}).empty());
}

} // namespace
} // namespace millwright::plot
