#include "core/base/units.h"
#include "core/plot/carving/internal/carving_outlines.h"
#include "core/plot/carving/internal/segment_tree.h"
#include "tests/core/plot/carving/carving_shapes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <vector>

namespace millwright::plot::internal {
namespace {

const ToolTip right_angled{TipKind::v, 20.0, from_degrees(90.0)}; // as wide as twice its depth

CutPath plunge_to(double x, double y, double z) {
    return {{.at = {x, y, 5.0}}, {.at = {x, y, z}, .speed = 1.0, .move = CutMove::plunge}};
}

const Region square{box_ring({0, 0}, {10, 10})};

TEST(PathDeviation, IsTheRoomThatTheBitLacks) {
    EXPECT_NEAR(path_deviation(plunge_to(5, 5, -5), square, right_angled), 0.0, 1e-12);
    EXPECT_NEAR(path_deviation(plunge_to(5, 5, -3), square, right_angled), -2.0, 1e-12);
    EXPECT_NEAR(path_deviation(plunge_to(1, 5, -3), square, right_angled), 2.0, 1e-12);
}

// Distances without a side took a cut 3 mm outside for one with room.
TEST(PathDeviation, OutsideOfTheRegionIsTheWholeWayBack) {
    EXPECT_NEAR(path_deviation(plunge_to(13, 5, -1), square, right_angled), 4.0, 1e-12);
    const Region with_hole{box_ring({0, 0}, {30, 30}), {{10, 10}, {10, 20}, {20, 20}, {20, 10}}};
    EXPECT_NEAR(path_deviation(plunge_to(15, 15, -1), with_hole, right_angled), 6.0, 1e-12);
    EXPECT_NEAR(path_deviation(plunge_to(5, 15, -1), with_hole, right_angled), -4.0, 1e-12);
}

TEST(PathDeviation, LooksBetweenThePlacesOfThePath) {
    CutPath across = plunge_to(5, 1, -1);
    across.push_back({.at = {5, 9, -1}, .speed = 1.0, .move = CutMove::cut});
    const Region gap{box_ring({0, 0}, {10, 10}), {{3, 4.5}, {3, 5.5}, {7, 5.5}, {7, 4.5}}};
    EXPECT_NEAR(path_deviation(across, gap, right_angled), 1.5, 1e-12);
}

TEST(PathDeviation, IsZeroWhereNothingIsCut) {
    EXPECT_EQ(path_deviation(plunge_to(5, 5, 0), square, right_angled), 0.0);
    EXPECT_EQ(path_deviation({}, square, right_angled), 0.0);
}

TEST(SegmentTree, SurroundsWhatTheEvenOddRuleSays) {
    const Region star = random_star(7, 40);
    std::vector<Segment2> segments;
    for (const Ring& ring : star) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            segments.push_back({ring[n], ring[(n + 1) % ring.size()]});
        }
    }
    const SegmentTree tree(segments);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> anywhere(-22.0, 22.0);
    int inside = 0;
    for (int n = 0; n < 2000; ++n) {
        const Vec2 place(anywhere(random),
                         n % 10 == 0 ? star[0][static_cast<std::size_t>(n % 40)].y() : anywhere(random));
        ASSERT_EQ(tree.surrounds(place), contains(star, place)) << place.transpose();
        inside += tree.surrounds(place) ? 1 : 0;
    }
    EXPECT_GT(inside, 300);
}

} // namespace
} // namespace millwright::plot::internal
