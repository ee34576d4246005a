#include "core/cordic_study/calculator.h"

#include "core/base/error.h"
#include "tests/core/cordic/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace millwright::cordic {
namespace {

TEST(Calculator, RotatesByAnyAngleAndKnowsItsError) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1000.0, 1000.0);
    for (int n = 0; n < 2000; ++n) {
        const double deg = any(random);
        const Rotated found = rotate(binary64, thesis_sequence(), 3.0, 4.0, deg);
        const double x = 3.0 * std::cos(deg * degree) - 4.0 * std::sin(deg * degree);
        const double y = 4.0 * std::cos(deg * degree) + 3.0 * std::sin(deg * degree);
        EXPECT_LT(found.error, 5.0 * 6.4e-8);
        EXPECT_NEAR(std::hypot(found.x - x, found.y - y), found.error, 1e-11);
        EXPECT_EQ(found.clocks, 37);
    }
}

TEST(Calculator, TurnsByAFullCircleAsByNothing) {
    const Rotated none = rotate(binary64, thesis_sequence(), 1.0, 0.5, 0.0);
    const Rotated full = rotate(binary64, thesis_sequence(), 1.0, 0.5, -720.0);
    EXPECT_EQ(none.x, full.x);
    EXPECT_EQ(none.y, full.y);
}

TEST(Calculator, FindsLengthAndDirectionInEveryQuadrant) {
    for (const NumberFormat& format : {binary64, binary32, fixed_format(8, 24), fixed_format(8, 40)}) {
        for (int deg = -179; deg <= 180; ++deg) {
            const Polar found = polar(
                format, thesis_sequence(), 0.01 * std::cos(deg * degree), 0.01 * std::sin(deg * degree));
            const double close = 60.0 * resolution(format) / degree + 6.1e-8 / degree;
            EXPECT_NEAR(std::remainder(found.angle_deg - deg, 360.0), 0.0, close * 100)
                << to_text(format) << ' ' << deg;
            EXPECT_NEAR(found.length, 0.01, 2e-8 + 60.0 * resolution(format))
                << to_text(format) << ' ' << deg;
        }
    }
}

// Subnormal numbers have lost digits; what is shifted out of them must not cost direction.
TEST(Calculator, FindsDirectionsOfTheSmallestNumbers) {
    for (const double size : {4e-320, 3e-310, 1e-300}) {
        const Polar found = polar(binary64, thesis_sequence(), -size, 2.0 * size);
        EXPECT_NEAR(found.angle_deg, 180.0 - std::atan(2.0) / degree, 0.01 + 6e-8 / degree);
        EXPECT_NEAR(found.length / size, std::sqrt(5.0), 1e-3);
    }
    const Polar narrow = polar(binary32, thesis_sequence(), 1e-40, 1e-40);
    EXPECT_NEAR(narrow.angle_deg, 45.0, 1e-4);
}

TEST(Calculator, RefusesWhatDoesNotFit) {
    EXPECT_THROW(static_cast<void>(rotate(fixed_format(2, 22), thesis_sequence(), 2.5, 0.0, 10.0)), Error);
    EXPECT_THROW(static_cast<void>(rotate(fixed_format(2, 22), thesis_sequence(), 1.9, 0.0, 10.0)), Error);
    EXPECT_THROW(static_cast<void>(
                     rotate(binary64, thesis_sequence(), 1.0, 0.0, std::numeric_limits<double>::infinity())),
                 Error);
    EXPECT_THROW(static_cast<void>(rotate(binary32, thesis_sequence(), 1e300, 0.0, 1.0)), Error);
    EXPECT_THROW(static_cast<void>(polar(binary64, thesis_sequence(), 0.0, 0.0)), Error);
    EXPECT_THROW(static_cast<void>(polar(fixed_format(2, 14), thesis_sequence(), 1e-9, 0.0)), Error);
    EXPECT_THROW(static_cast<void>(polar(fixed_format(2, 30), thesis_sequence(), 1.5, 1.5)), Error);
    EXPECT_NEAR(polar(fixed_format(2, 30), thesis_sequence(), 1.2, 1.5).length, std::hypot(1.2, 1.5), 1e-7);
    for (const int steps : {1, 2, 3}) { // they reach 45, 71.6 and 85.6 degrees of the 90 that folding leaves
        const Sequence few = classic_sequence(CoordinateSystem::circular, steps);
        EXPECT_THROW(static_cast<void>(polar(binary64, few, -1.0, 0.0)), Error) << steps;
        EXPECT_NO_THROW(static_cast<void>(polar(binary64, few, 1.0, 0.1))) << steps;
    }
}

// A decimal input goes into the widest words to their last place: binary64 would be 2^-53 beside it.
TEST(Calculator, LosesNoDigitOfWideWords) {
    const NumberFormat widest = fixed_format(2, 62, Rounding::nearest);
    const Sequence steps = classic_sequence(CoordinateSystem::circular, 62);
    for (const char* deg : {"30.1", "-200.7", "359.9", "12.3456789012345678901"}) {
        const Rotated found =
            rotate(widest, steps, Decimal::parse("0.7"), Decimal::parse("-0.1"), Decimal::parse(deg));
        EXPECT_LT(found.error, 64 * resolution(widest)) << deg << ": a rounding in each step";
    }
    const Rotated still = rotate(widest, steps, Decimal::parse("0.1"), 0.0, 0.0);
    EXPECT_NEAR(
        static_cast<double>(static_cast<std::int64_t>(still.words[0]) - 461168601842738790), 0.0, 64.0);
}

TEST(Calculator, RefusesAVectorThatTheFormatTakesForNone) {
    const Sequence sequence = thesis_sequence();
    const NumberFormat format = fixed_format(2, 22);
    EXPECT_THROW((void)rotate(format, sequence, Decimal::parse("1e-8"), 0.0, 30.0), Error);
    EXPECT_THROW((void)rotate(binary32, sequence, 0.0, Decimal::parse("-1e-60"), 30.0), Error);
    EXPECT_THROW((void)polar(format, sequence, 0.0, Decimal::parse("1e-8")), Error);
    EXPECT_NEAR(rotate(format, sequence, 1.0, Decimal::parse("1e-8"), 30.0).error, 0.0, 1e-5) << "one part";
    EXPECT_EQ(rotate(format, sequence, 0.0, 0.0, 30.0).error, 0.0) << "0 is 0";
    EXPECT_NO_THROW((void)rotate(format, sequence, 0.0, Decimal::parse("3e-7"), 30.0));
}

TEST(Calculator, GivesWordsOfAsManyBitsAsTheFormatHas) {
    for (const int fraction_bits : {6, 22, 30, 62}) {
        const NumberFormat format = fixed_format(2, fraction_bits);
        const Rotated found = rotate(format, thesis_sequence(), -0.5, -0.5, 10.0);
        for (const Word word : found.words) {
            EXPECT_EQ(lowest_bits(word, format.word()), word) << fraction_bits;
        }
        EXPECT_EQ(found.words[0] >> (format.word() - 1), 1U) << "negative";
    }
}

TEST(Calculator, FindsNoDirectionBeyondHalfATurn) {
    for (const NumberFormat& format : {binary64, binary32, fixed_format(8, 8), fixed_format(8, 24)}) {
        for (const double y : {0.0, -0.0}) {
            const Polar found = polar(format, thesis_sequence(), -3.0, y);
            EXPECT_LE(std::abs(found.angle_deg), 180.0) << to_text(format);
            EXPECT_LT(found.angle_error_deg, 2.0) << to_text(format);
        }
    }
}

} // namespace
} // namespace millwright::cordic
