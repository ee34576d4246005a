#include "core/geometry/internal/homogeneous_point.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace millwright::geometry {
namespace {

BezierPatch random_bicubic(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-50.0, 50.0), weight(0.3, 3.0);
    ControlNet net = ControlNet::sized(4, 4);
    for (std::size_t n = 0; n < net.points.size(); ++n) {
        net.points[n] = {coordinate(random), coordinate(random), coordinate(random)};
        net.weights[n] = weight(random);
    }
    return BezierPatch(net);
}

template <int Order> void expect_the_same_bits(const BezierPatch& patch, double u, double v) {
    Basis bu, bv;
    fill<Order>(bu, 3, u);
    fill<Order>(bv, 3, v);
    const HomogeneousPoint any = sum_of_any_degree<Order>(patch.homogeneous(), 4, 4, bu, bv);
    const HomogeneousPoint written_out =
        bicubic_sum<Order>(patch.homogeneous(), cubic_basis(u), cubic_basis(v));
    EXPECT_EQ(std::memcmp(&any, &written_out, sizeof any), 0) << Order << " at " << u << ", " << v;
}

TEST(HomogeneousPoint, OfABicubicPatchIsTheSameBitsAsOfAnyDegree) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> parameter(-0.2, 1.2);
    for (int round = 0; round < 500; ++round) {
        const BezierPatch patch = random_bicubic(random);
        const double u = round % 10 == 0 ? 0.0 : parameter(random);
        const double v = round % 10 == 1 ? 1.0 : parameter(random);
        expect_the_same_bits<0>(patch, u, v);
        expect_the_same_bits<1>(patch, u, v);
        expect_the_same_bits<2>(patch, u, v);
    }
}

} // namespace
} // namespace millwright::geometry
