#include "core/cordic/angles.h"

#include <gtest/gtest.h>

#include <array>

namespace millwright::cordic {
namespace {

// From x - x^3/3 < atan x < x < atanh x, x^3/3 being far below half a unit.
TEST(ElementaryAngles, OfHalfAUnitRoundToTheSideOnWhichTheyLie) {
    for (int s = 20; s <= most_steps; ++s) {
        const int half = s - 1; // places
        EXPECT_EQ(nearest(wide_angle(CoordinateSystem::circular, s), angle_places - half), 0) << s;
        EXPECT_EQ(nearest(wide_angle(CoordinateSystem::hyperbolic, s), angle_places - half), 1) << s;
        EXPECT_EQ(nearest(wide_angle(CoordinateSystem::circular, s), angle_places - s), 1) << s;
    }
}

struct Gain {
    int steps;
    std::int64_t circular, hyperbolic;
};

// 1/k 2^62 to the nearest integer, by the decimal module of Python with 120 digits.
constexpr std::array<Gain, 9> gains{{{1, 3260954456333195553, 5325116328314171701},
                                     {2, 2916686334356757942, 5499756494980793145},
                                     {4, 2807750841902562267, 5554091957664413206},
                                     {9, 2800466991965380887, 5568583141526872315},
                                     {10, 2800461650513774536, 5568593762786701686},
                                     {16, 2800459870464141537, 5568597341237587637},
                                     {24, 2800459870029459587, 5568597344694975158},
                                     {29, 2800459870029452960, 5568597344695027863},
                                     {62, 2800459870029452954, 5568597344695027914}}};

TEST(InverseGain, IsExactToItsLastBit) {
    for (const Gain& gain : gains) {
        EXPECT_EQ(inverse_gain(classic_sequence(CoordinateSystem::circular, gain.steps)), gain.circular)
            << gain.steps;
        EXPECT_EQ(inverse_gain(classic_sequence(CoordinateSystem::hyperbolic, gain.steps)), gain.hyperbolic)
            << gain.steps;
    }
}

TEST(Wide, ProductsCarryThroughAllTheirDigits) {
    constexpr UInt128 most = ~UInt128{0};
    EXPECT_TRUE((product(most, most) == UInt256{most - 1, 1})); // (2^128 - 1)^2
    EXPECT_TRUE((product(most, UInt128{1} << 64) == UInt256{(UInt128{1} << 64) - 1, most << 64}));
    EXPECT_TRUE((product(3, 5) == UInt256{0, 15}));
}

} // namespace
} // namespace millwright::cordic
