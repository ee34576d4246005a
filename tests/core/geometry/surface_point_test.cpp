#include "core/geometry/surface_point.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace millwright::geometry {
namespace {

ControlNet random_net_of_any_size(std::mt19937& random, bool rational) {
    std::uniform_int_distribution<int> size(2, 9);
    std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
    std::uniform_real_distribution<double> weight(0.3, 3.0);
    ControlNet net = ControlNet::sized(size(random), size(random));
    for (std::size_t n = 0; n < net.points.size(); ++n) {
        net.points[n] = {coordinate(random), coordinate(random), coordinate(random)};
        net.weights[n] = rational ? weight(random) : 1.0;
    }
    return net;
}

bool same_bits(const Vec3& a, const Vec3& b) {
    return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

TEST(SurfacePoint, IsTheSameBitsAsTheDerivatives) {
    std::mt19937 random(64);
    std::uniform_real_distribution<double> parameter(-0.2, 1.2);
    for (int round = 0; round < 200; ++round) {
        const BezierPatch patch(random_net_of_any_size(random, round % 2 == 1));
        for (int k = 0; k < 20; ++k) {
            const double u = k == 0 ? 0.0 : parameter(random);
            const double v = k == 1 ? 1.0 : parameter(random);
            const SurfacePoint point = point_of(patch, u, v);
            ASSERT_TRUE(same_bits(point.position, patch.derivatives(u, v).position)) << round;
            ASSERT_TRUE(same_bits(point.position, patch.position(u, v))) << round;
            const std::optional<Vec3> normal = patch.unit_normal(patch.derivatives(u, v));
            ASSERT_TRUE(point.normal && normal) << round;
            ASSERT_TRUE(same_bits(*point.normal, *normal)) << round;
        }
    }
}

} // namespace
} // namespace millwright::geometry
