#include "core/base/error.h"
#include "core/base/units.h"
#include "core/plot_strokes/region.h"
#include "tests/core/plot_strokes/circle_ring.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace millwright::plot {
namespace {

using test::circle_ring;

// The hatch levels printed in the KMITL thesis of 2006: floor(63.5 k) plotter units.
TEST(Hatching, LevelsAreThoseOfTheThesis) {
    const Region letter = {{{37.725, 52.0}, {49.025, 52.0}, {49.025, 69.0}, {37.725, 69.0}}};
    const Strokes strokes = hatch(letter, {.pitch = 1.5875});
    const int printed[] = {2095, 2159, 2222, 2286, 2349, 2413, 2476, 2540, 2603, 2667, 2730};
    ASSERT_EQ(strokes.size(), std::size(printed));
    for (std::size_t n = 0; n < strokes.size(); ++n) {
        EXPECT_EQ(std::floor(strokes[n].points[0].y() / 0.025 + 1e-6), printed[n]);
        EXPECT_EQ(strokes[n].points[0].x() < strokes[n].points[1].x(), n % 2 == 0);
    }
}

TEST(Hatching, LengthTimesPitchIsTheAreaAtAnyAngle) {
    const Region ring = {circle_ring(30.0, 720), circle_ring(12.0, 360)};
    const double area = pi * (30.0 * 30.0 - 12.0 * 12.0);
    for (double deg = 0.0; deg < 180.0; deg += 15.0) {
        const Strokes strokes = hatch(ring, {.pitch = 0.05, .angle = from_degrees(deg)});
        EXPECT_NEAR(draw_length(strokes) * 0.05, area, 0.002 * area) << deg;
    }
    const Strokes cross = hatch(ring, {.pitch = 0.05, .cross = true});
    EXPECT_NEAR(draw_length(cross) * 0.05, 2.0 * area, 0.004 * area);
}

TEST(Hatching, EveryLineIsInsideTheRegion) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
    for (int trial = 0; trial < 50; ++trial) {
        Region region(2);
        for (Ring& ring : region) {
            for (int n = 0; n < 7; ++n) {
                ring.emplace_back(coordinate(random), coordinate(random));
            }
        }
        for (const Stroke& stroke : hatch(region, {.pitch = 1.3, .angle = 0.4 * trial})) {
            const Vec2 along = stroke.points[1] - stroke.points[0];
            for (const double t : {0.001, 0.5, 0.999}) {
                EXPECT_TRUE(contains(region, stroke.points[0] + t * along) || along.norm() < 1e-6);
            }
        }
    }
}

TEST(Hatching, RefusesAPitchThatIsNone) {
    const millwright::test::WithoutTraps no_traps;
    const Region square = {{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}};
    EXPECT_THROW(static_cast<void>(hatch(square, {.pitch = 0.0})), Error);
    EXPECT_THROW(static_cast<void>(hatch(square, {.pitch = std::numeric_limits<double>::quiet_NaN()})),
                 Error);
}

} // namespace
} // namespace millwright::plot
