#include "ui/viewport/internal/net_outline.h"

#include "core/grid/grid.h"
#include "tests/support/trim_loops.h"
#include "tests/ui/viewport/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace millwright::viewport {
namespace {

using geometry::Trim;
using grid::Grid;
using grid::NodeArray;

/// Every inner node moved by up to `most` of a cell.
NodeArray shaken(int rows, int columns, double most) {
    std::mt19937 random(42);
    std::uniform_real_distribution<double> off(-most, most);
    NodeArray array = Grid::uniform(rows, columns).array();
    for (int i = 1; i + 1 < rows; ++i) {
        for (int j = 1; j + 1 < columns; ++j) {
            array.at(i, j) += Vec2(off(random) / (rows - 1), off(random) / (columns - 1));
        }
    }
    return Grid(array).array(); // which has no folds
}

double distance_to(const Trim::Loop& loop, const Vec2& at) {
    double least = 1.0;
    for (std::size_t n = 0; n < loop.size(); ++n) {
        const Vec2& a = loop[n];
        const Vec2 way = loop[(n + 1) % loop.size()] - a;
        const double share = std::clamp((at - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (a + share * way - at).norm());
    }
    return least;
}

/// The farthest that the outline over the net runs from the one on the patch, looked at between its corners.
double farthest(const Trim& trim, const NodeArray& nodes, int fine) {
    const Trim on_net = trim_on_net(trim, nodes, fine);
    double most = 0.0;
    for (std::size_t loop = 0; loop < trim.loops.size(); ++loop) {
        const Trim::Loop& corners = on_net.loops.at(loop);
        for (std::size_t n = 0; n < corners.size(); ++n) {
            for (const double share : {0.0, 0.25, 0.5, 0.75}) {
                const Vec2& a = corners[n];
                const Vec2 at = a + share * (corners[(n + 1) % corners.size()] - a);
                most = std::max(most, distance_to(trim.loops[loop], place_on_net(nodes, at)));
            }
        }
    }
    return most;
}

const Trim with_holes{{test::rectangle(0.0, 0.0, 1.0, 1.0),
                       test::circle({0.4, 0.5}, 0.2, 48),
                       {{0.7, 0.2}, {0.95, 0.25}, {0.75, 0.9}}}};

TEST(NetOutline, RunsWhereItRunsOnThePatch) {
    constexpr int fine = 6;
    const double mesh_cell = 1.0 / (11 * fine); // of the uniform net
    EXPECT_LT(farthest(with_holes, Grid::uniform(12, 12).array(), fine), 1e-9);
    EXPECT_LT(farthest(with_holes, test::bent_grid(12).array(), fine), 0.1 * mesh_cell);
    EXPECT_LT(farthest(with_holes, shaken(12, 12, 0.3), fine), 0.1 * mesh_cell);
    EXPECT_LT(farthest(with_holes, shaken(5, 40, 0.3), fine), 0.1 / (4 * fine));
}

TEST(NetOutline, CornersStayCornersAndTheBorderTheBorder) {
    const NodeArray nodes = shaken(9, 7, 0.3);
    const Trim on_net = trim_on_net(with_holes, nodes, 4);
    for (const Vec2& corner : with_holes.loops[2]) {
        const auto same = [&](const Vec2& at) { return (place_on_net(nodes, at) - corner).norm() < 1e-9; };
        EXPECT_TRUE(std::ranges::any_of(on_net.loops[2], same)) << corner.transpose();
    }
    for (const Vec2& at : on_net.loops[0]) {
        EXPECT_TRUE((at.array() <= 0.0 || at.array() >= 1.0).any()) << at.transpose();
    }
}

TEST(NetOutline, EveryPlaceOfANetIsFoundAgain) {
    const NodeArray nodes = shaken(6, 8, 0.3);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(0.0, 1.0);
    for (int n = 0; n < 300; ++n) {
        const Vec2 at(anywhere(random), anywhere(random));
        const Vec2 uv = place_on_net(nodes, at);
        const Trim around{{{uv, uv + Vec2(1e-7, 0.0), uv + Vec2(0.0, 1e-7)}}};
        EXPECT_LT((trim_on_net(around, nodes, 1).loops[0][0] - at).norm(), 1e-9);
    }
}

} // namespace
} // namespace millwright::viewport
