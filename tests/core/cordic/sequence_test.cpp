#include "core/cordic/sequence.h"

#include "core/cordic/angles.h"
#include "tests/core/cordic/golden.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

namespace millwright::cordic {
namespace {

using enum CoordinateSystem;

// Recomputed from table 3.3 with 50 digits; they show that the table is read without a misprint.
TEST(ThesisSequence, HasTheGainsCorrectionsAndRangesOfHighPrecision) {
    constexpr double close = 1e-12;
    EXPECT_NEAR(gain(thesis_sequence(circular)), 1.27544518598050299, close);
    EXPECT_NEAR(gain(thesis_sequence(hyperbolic)), 0.753126104724598985, close);
    EXPECT_EQ(gain(thesis_sequence(linear)), 1.0);
    EXPECT_NEAR(correction(thesis_sequence(circular)), 0.784039962994691197, close);
    EXPECT_NEAR(correction(thesis_sequence(hyperbolic)), 1.32779885129881577, close);
    EXPECT_EQ(correction(thesis_sequence(linear)), 1.0);
    EXPECT_NEAR(convergence_range(thesis_sequence(circular)), 1.70857018578320988, close);
    EXPECT_NEAR(convergence_range(thesis_sequence(linear)), 1.76574701070785522, close);
    EXPECT_NEAR(convergence_range(thesis_sequence(hyperbolic)), 1.83745609184498476, close);
}

TEST(ThesisSequence, ConvergesBecauseNoAngleExceedsThoseThatFollow) {
    for (const CoordinateSystem m : {circular, linear, hyperbolic}) {
        const Sequence sequence = thesis_sequence(m);
        const auto angle = [&](int i) {
            return to_floating<double>(wide_angle(m, sequence.shifts[static_cast<std::size_t>(i)]));
        };
        const double last = angle(sequence.step_count - 1);
        double following = last;
        for (int i = sequence.step_count - 2; i >= 0; --i) {
            following += angle(i + 1);
            EXPECT_LE(angle(i), following + 1e-5 * last) << "step " << i;
        }
    }
}

TEST(ClassicSequence, CountsShiftsAndRepeatsWhatTheHyperbolicOneNeeds) {
    const Sequence plain = classic_sequence(circular, 32);
    EXPECT_EQ(plain.shifts[0], 0);
    EXPECT_EQ(plain.shifts[31], 31);
    EXPECT_EQ(plain.clock_count(), 33);
    const Sequence repeated = classic_sequence(hyperbolic, 20);
    EXPECT_EQ(repeated.shifts[0], 1);
    EXPECT_EQ(repeated.shifts[3], 4);
    EXPECT_EQ(repeated.shifts[4], 4);
    EXPECT_EQ(repeated.shifts[13], 13);
    EXPECT_EQ(repeated.shifts[14], 13);
    EXPECT_EQ(repeated.shifts[15], 14);
}

TEST(ClassicSequence, MultipliesByTheInverseOfItsGain) {
    for (const CoordinateSystem m : {circular, hyperbolic}) {
        for (const int count : {1, 2, 5, 16, 24, 40, most_steps}) {
            const Sequence sequence = classic_sequence(m, count);
            EXPECT_NEAR(gain(sequence) * correction(sequence), 1.0, 1e-15) << count << " steps";
        }
    }
}

TEST(ElementaryAngles, AreThoseOfHighPrecisionToTheLastBit) {
    int s = 0;
    for (const auto& [binary64, binary32] : golden::circular_angles) {
        ++s;
        EXPECT_EQ(to_floating<double>(wide_angle(circular, s)), binary64) << "shift " << s;
        EXPECT_EQ(std::bit_cast<std::uint32_t>(to_floating<float>(wide_angle(circular, s))), binary32)
            << "shift " << s;
    }
    s = 0;
    for (const double binary64 : golden::hyperbolic_angles) {
        ++s;
        EXPECT_EQ(to_floating<double>(wide_angle(hyperbolic, s)), binary64) << "shift " << s;
    }
    EXPECT_EQ(to_floating<double>(wide_angle(circular, 0)), 0x1.921fb54442d18p-1);
}

TEST(ElementaryAngles, AgreeWithTheMathematicsLibraryAtEveryShift) {
    for (int s = 0; s <= most_steps; ++s) {
        const double tangent = std::ldexp(1.0, -s);
        const double circle = std::atan(tangent);
        EXPECT_NEAR(to_floating<double>(wide_angle(circular, s)), circle, 1e-15 * circle);
        EXPECT_EQ(to_floating<double>(wide_angle(linear, s)), tangent);
        if (s > 0) {
            const double hyperbola = std::atanh(tangent);
            EXPECT_NEAR(to_floating<double>(wide_angle(hyperbolic, s)), hyperbola, 1e-15 * hyperbola);
        }
    }
}

} // namespace
} // namespace millwright::cordic
