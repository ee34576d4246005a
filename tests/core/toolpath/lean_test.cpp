#include "core/toolpath/tool.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::toolpath {
namespace {

TEST(Lean, LeadsForwardAndTiltsToTheRight) {
    const Vec3 up = Vec3::UnitZ();
    const Vec3 north = Vec3::UnitY();
    const Vec3 east = Vec3::UnitX(); // right of who goes north
    const Vec3 lead = leaning_axis({.lead = 0.3}, up, north, 0.0);
    EXPECT_LT((lead - (std::cos(0.3) * up + std::sin(0.3) * north)).norm(), 1e-15);
    const Vec3 tilt = leaning_axis({.tilt = 0.3}, up, north, 0.0);
    EXPECT_LT((tilt - (std::cos(0.3) * up + std::sin(0.3) * east)).norm(), 1e-15);
    const Vec3 both = leaning_axis({.lead = 0.3, .tilt = -0.5}, up, north, 0.0);
    EXPECT_NEAR(both.dot(up), std::cos(0.3) * std::cos(0.5), 1e-15);
    EXPECT_NEAR(std::asin(both.dot(north)), 0.3, 1e-15);
    EXPECT_LT(both.dot(east), 0.0);
}

TEST(Lean, ChangesLinearlyAlongTheTrack) {
    const Lean lean{.lead = 0.1, .tilt = 0.2, .lead_change = 0.4, .tilt_change = -0.2};
    const Vec3 axis = leaning_axis(lean, Vec3::UnitZ(), Vec3::UnitX(), 0.25);
    EXPECT_NEAR(std::asin(axis.x()), 0.2, 1e-15);
    EXPECT_NEAR(std::atan2(-axis.y(), axis.z()), 0.15, 1e-15);
    EXPECT_FALSE(lean.upright());
    EXPECT_TRUE(Lean{}.upright());
}

} // namespace
} // namespace millwright::toolpath
