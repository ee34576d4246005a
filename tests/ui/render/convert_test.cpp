#include "ui/render/convert.h"

#include <gtest/gtest.h>

namespace millwright::render {
namespace {

TEST(Convert, KeepsAPointThereAndBack) {
    const Vec3 p(1.5, -2.25, 1e6);
    EXPECT_EQ(to_core(to_glm(p)), p);
}

TEST(Convert, GivesAFrameThatMovesPointsTheSameWay) {
    Frame frame = Frame::Identity();
    frame.translate(Vec3(3.0, -4.0, 5.0));
    frame.rotate(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -2.0) / 3.0));
    const Vec3 p(0.3, 7.0, -2.0);
    const glm::dvec4 moved = to_glm(frame) * glm::dvec4(to_glm(p), 1.0);
    EXPECT_LT((to_core(glm::dvec3(moved)) - frame * p).norm(), 1e-14);
}

TEST(Convert, GivesAnEmptyBoxForAnEmptyBox) {
    EXPECT_TRUE(is_empty(to_glm(Box3())));
    const Box3 box(Vec3(0.0, 1.0, 2.0), Vec3(3.0, 4.0, 5.0));
    EXPECT_EQ(to_glm(box).min, glm::dvec3(0.0, 1.0, 2.0));
    EXPECT_EQ(to_glm(box).max, glm::dvec3(3.0, 4.0, 5.0));
}

} // namespace
} // namespace millwright::render
