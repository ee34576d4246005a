#include "core/grid/weight.h"

#include "core/base/error.h"
#include "tests/support/grid_arrays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace millwright::grid {
namespace {

double value_at(const Weight& weight, const Vec2& p) {
    double w = 0.0;
    weight.values({&p, 1}, {&w, 1});
    return w;
}

Vec2 gradient_at(const Weight& weight, const Vec2& p) {
    Vec2 g = Vec2::Zero();
    weight.gradients({&p, 1}, {&g, 1});
    return g;
}

// T16.
TEST(Weight, W1IsLargeOnTheCircleOfRadius5About10And10) {
    const WeightPtr w = weight_w1();
    EXPECT_DOUBLE_EQ(value_at(*w, {13.0, 14.0}), 1.01);
    EXPECT_DOUBLE_EQ(value_at(*w, {10.0, 10.0}), std::exp(-25.0) + 0.01);
    EXPECT_DOUBLE_EQ(value_at(*w, {16.0, 10.0}), std::exp(-11.0) + 0.01);
}

TEST(Weight, W2WithRadiusSquared25IsW1) {
    EXPECT_EQ(value_at(*weight_w2(25), {13.3, 8.1}), value_at(*weight_w1(), {13.3, 8.1}));
    EXPECT_DOUBLE_EQ(value_at(*weight_w2(36), {16.0, 10.0}), 1.01);
}

TEST(Weight, W3IsAQuarterCircleAtTheFarCorner) {
    EXPECT_DOUBLE_EQ(value_at(*weight_w3(30, 40), {27.0, 36.0}), 1.01);
}

TEST(Weight, W4ChangesItsSign) {
    EXPECT_DOUBLE_EQ(value_at(*weight_w4(), {6.25, 6.25}), 0.001);
    EXPECT_DOUBLE_EQ(value_at(*weight_w4(), {18.75, 6.25}), -0.001);
    EXPECT_EQ(count_not_positive(*weight_w4(), square_grid(25)), 25 * 25 - 2 * 12 * 12);
    EXPECT_EQ(count_not_positive(*weight_w1(), square_grid(25)), 0);
}

TEST(Weight, W5GrowsWithTheDistanceFromTheOrigin) {
    EXPECT_DOUBLE_EQ(value_at(*weight_w5(1.0), {1.0, 2.0}), std::exp(5.0));
    EXPECT_DOUBLE_EQ(value_at(*weight_w5(2.0), {2.0, 4.0}), std::exp(5.0));
    EXPECT_THROW((void)weight_w5(0.0), Defect);
}

TEST(Weight, GradientsAreTheDifferencesOfValues) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(0.0, 24.0);
    constexpr double h = 1e-6;
    for (const WeightPtr& w :
         {weight_w1(), weight_w3(25, 25), weight_w4(), weight_w5(24.0), constant_weight(2.0)}) {
        for (int n = 0; n < 200; ++n) {
            const Vec2 p(anywhere(random), anywhere(random));
            const Vec2 found = gradient_at(*w, p);
            const double w_x = (value_at(*w, p + Vec2(h, 0.0)) - value_at(*w, p - Vec2(h, 0.0))) / (2.0 * h);
            const double w_y = (value_at(*w, p + Vec2(0.0, h)) - value_at(*w, p - Vec2(0.0, h))) / (2.0 * h);
            EXPECT_NEAR(found.x(), w_x, 1e-4 * (1.0 + found.norm()));
            EXPECT_NEAR(found.y(), w_y, 1e-4 * (1.0 + found.norm()));
        }
    }
}

TEST(WeightAtNodes, IsTheWeightOfEachNode) {
    const NodeArray nodes = displaced_square_grid(40, 0.5);
    const WeightPtr weight = weight_w1();
    const std::vector<double> w = weight_at_nodes(*weight, nodes);
    for (std::size_t k = 0; k < w.size(); ++k) {
        ASSERT_EQ(w[k], value_at(*weight, nodes.nodes[k]));
    }
}

} // namespace
} // namespace millwright::grid
