#include "core/geometry/net_editing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::geometry {
namespace {

/// z is the same on both sides; `turn`: rows run along y, and backwards.
ControlNet symmetric_net(int rows, int columns, bool turn) {
    ControlNet net = ControlNet::sized(rows, columns);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const double a = i - 0.5 * (rows - 1), b = j - 0.5 * (columns - 1);
            const double x = turn ? b : a, y = turn ? -a : b;
            net.point(i, j) = Vec3(x, y, std::cos(x) * std::cosh(y));
        }
    }
    return net;
}

/// Whether each control point has an equal one across the plane of the axis.
bool is_symmetric(const ControlNet& net, int axis) {
    for (const Vec3& point : net.points) {
        Vec3 mirrored = point;
        mirrored[axis] = -mirrored[axis];
        bool found = false;
        for (const Vec3& other : net.points) {
            found = found || (other - mirrored).norm() < 1e-12;
        }
        if (!found) {
            return false;
        }
    }
    return true;
}

TEST(NetSymmetry, StaysWhateverIsMoved) {
    for (const bool turn : {false, true}) {
        for (const auto& [rows, columns] : {std::pair{4, 4}, {5, 4}, {3, 5}}) {
            const NetSymmetry both{true, true};
            for (int i = 0; i < rows; ++i) {
                for (int j = 0; j < columns; ++j) {
                    ControlNet net = symmetric_net(rows, columns, turn);
                    const Vec2 leads = side_of(net, both, {i, j});
                    const Vec3 way(0.3, -0.2, 0.5), before = net.point(i, j);
                    for (const NetPlace& place : images(symmetric_net(rows, columns, turn), both, {i, j})) {
                        const Vec2 side = side_of(symmetric_net(rows, columns, turn), both, place);
                        net.point(place.i, place.j) += share_of_way(side, leads).cwiseProduct(way);
                    }
                    EXPECT_TRUE(is_symmetric(net, 0)) << i << " " << j << " turn " << turn;
                    EXPECT_TRUE(is_symmetric(net, 1)) << i << " " << j << " turn " << turn;
                    EXPECT_NEAR(net.point(i, j).z(), before.z() + way.z(), 1e-15);
                }
            }
        }
    }
}

TEST(NetSymmetry, ImagesAreEachOnce) {
    const ControlNet net = symmetric_net(3, 4, false);
    EXPECT_EQ(images(net, {}, {0, 0}), (std::vector<NetPlace>{{0, 0}}));
    EXPECT_EQ(images(net, {true, false}, {0, 1}), (std::vector<NetPlace>{{0, 1}, {2, 1}}));
    EXPECT_EQ(images(net, {false, true}, {0, 1}), (std::vector<NetPlace>{{0, 1}, {0, 2}}));
    EXPECT_EQ(images(net, {true, true}, {0, 0}), (std::vector<NetPlace>{{0, 0}, {0, 3}, {2, 0}, {2, 3}}));
    EXPECT_EQ(images(net, {true, true}, {1, 0}), (std::vector<NetPlace>{{1, 0}, {1, 3}}))
        << "in the middle of x";
}

TEST(NetSymmetry, WithoutItEachPointTakesTheWholeWay) {
    const ControlNet net = symmetric_net(4, 4, false);
    EXPECT_EQ(share_of_way(side_of(net, {}, {0, 0}), side_of(net, {}, {3, 3})), Vec3(1.0, 1.0, 1.0));
}

} // namespace
} // namespace millwright::geometry
