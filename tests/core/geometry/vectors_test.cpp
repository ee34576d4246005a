#include "core/geometry/vectors.h"

#include <gtest/gtest.h>

#include <random>

namespace millwright {
namespace {

TEST(FrameAlongK8, ItsThirdColumnIsTheToolAxisAndItIsARotation) {
    std::mt19937 random(1996);
    std::uniform_real_distribution<double> part(-1.0, 1.0);
    for (int n = 0; n < 1000; ++n) {
        const Vec3 axis = Vec3(part(random), part(random), part(random)).normalized();
        const Mat3 frame = frame_along(axis);
        EXPECT_LT((frame.col(2) - axis).norm(), 1e-12);
        EXPECT_LT((frame.transpose() * frame - Mat3::Identity()).norm(), 1e-12);
        EXPECT_NEAR(frame.determinant(), 1.0, 1e-12);
    }
    for (const Vec3& axis : {Vec3(0.0, 0.0, 1.0), Vec3(0.0, 0.0, -1.0), Vec3(1.0, 0.0, 0.0)}) {
        EXPECT_LT((frame_along(axis).col(2) - axis).norm(), 1e-12);
        EXPECT_NEAR(frame_along(axis).determinant(), 1.0, 1e-12);
    }
}

} // namespace
} // namespace millwright
