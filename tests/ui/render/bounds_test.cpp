#include "ui/render/bounds.h"

#include <gtest/gtest.h>

namespace millwright::render {
namespace {

TEST(Bounds, AreEmptyUntilAPointIsAdded) {
    EXPECT_TRUE(is_empty(Bounds{}));
    EXPECT_FALSE(is_empty(united(Bounds{}, glm::dvec3(1.0, 2.0, 3.0))));
}

TEST(Bounds, AreNotChangedByAnEmptyBox) {
    const Bounds box = {.min = {1.0, 2.0, 3.0}, .max = {4.0, 5.0, 6.0}};
    EXPECT_EQ(united(box, Bounds{}).min, box.min);
    EXPECT_EQ(united(Bounds{}, box).max, box.max);
}

TEST(Bounds, ReachOverBothBoxes) {
    const Bounds both =
        united(Bounds{.min = {0.0, -1.0, 2.0}, .max = {1.0, 0.0, 3.0}}, glm::dvec3(5.0, -3.0, 2.5));
    EXPECT_EQ(both.min, glm::dvec3(0.0, -3.0, 2.0));
    EXPECT_EQ(both.max, glm::dvec3(5.0, 0.0, 3.0));
    EXPECT_EQ(center(both), glm::dvec3(2.5, -1.5, 2.5));
}

TEST(Bounds, HaveEightDifferentCorners) {
    const auto all = corners(Bounds{.min = glm::dvec3(0.0), .max = {1.0, 2.0, 3.0}});
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& corner : all) {
        sum += corner;
    }
    EXPECT_EQ(sum, glm::dvec3(4.0, 8.0, 12.0)); // each bound is used four times
    EXPECT_EQ(all.front(), glm::dvec3(0.0));
    EXPECT_EQ(all.back(), glm::dvec3(1.0, 2.0, 3.0));
}

} // namespace
} // namespace millwright::render
