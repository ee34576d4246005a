#include "core/toolpath/internal/move_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::toolpath {
namespace {

double largest_closest(const std::vector<Look>& looks) {
    return std::ranges::max(looks, {}, &Look::closest).closest;
}

TEST(MoveLooks, OfAMoveThatIsStraightOverLevelGroundAreThree) {
    const auto nothing = [](double t) { return Look{.t = t}; };
    EXPECT_EQ(looks_until_known({}, {.t = 1.0}, 2, {}, nothing).size(), 3U);
}

/// One that is 0 at the ends and in the middle, and no wider than a tenth of the move.
TEST(MoveLooks, FindAPeakThatTheBendAllows) {
    constexpr double width = 0.02, height = 0.5;
    const auto peak = [&](double t) {
        const double x = (t - 0.37) / width;
        return Look{.t = t, .closest = height * std::exp(-x * x)};
    };
    const LookBend bend{.closest = 2.0 * height / (width * width)};
    const auto looks = looks_until_known(peak(0.0), peak(1.0), 2, bend, peak);
    EXPECT_NEAR(largest_closest(looks), height, closest_tolerance(height));
    EXPECT_LT(looks.size(), 60U);
    EXPECT_TRUE(std::ranges::is_sorted(looks, {}, &Look::t));
    const auto without = looks_until_known(peak(0.0), peak(1.0), 2, {}, peak);
    EXPECT_LT(largest_closest(without), 0.1 * height); // the bend it was that found it
}

TEST(MoveLooks, FindAKinkBySlopesAlone) {
    const auto kink = [](double t) { return Look{.t = t, .closest = 1.0 - std::abs(t - 0.61803)}; };
    const auto looks = looks_until_known(kink(0.0), kink(1.0), 2, {}, kink);
    EXPECT_NEAR(largest_closest(looks), 1.0, closest_tolerance(1.0));
}

TEST(MoveLooks, EndWhereAnAxisJumps) {
    const auto jump = [](double t) { return Look{.t = t, .axis = t < 1.0 / 3.0 ? 0.1 : 0.2}; };
    const auto looks = looks_until_known(jump(0.0), jump(1.0), 2, {}, jump);
    EXPECT_LT(looks.size(), 200U);
}

} // namespace
} // namespace millwright::toolpath
