#include "core/cordic/decimal.h"

#include "core/base/error.h"
#include "core/cordic/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace millwright::cordic {
namespace {

std::int64_t fixed(const char* text, int integer_bits, int fraction_bits) {
    bool overflow = false;
    const std::int64_t number =
        Decimal::parse(text).to_fixed(fixed_format(integer_bits, fraction_bits), overflow);
    EXPECT_FALSE(overflow) << text;
    return number;
}

// The numbers are the products with powers of two of 80-digit arithmetic, rounded.
TEST(Decimal, BecomesTheNearestWordHoweverWide) {
    EXPECT_EQ(fixed("0.1", 2, 62), 461168601842738790);
    EXPECT_EQ(fixed("-1.99999999999999999999", 2, 62), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(fixed("0.3", 4, 60), 345876451382054093);
    EXPECT_EQ(fixed("1234567.000000000000001", 24, 40), 1357420771768532992);
    EXPECT_EQ(fixed("12345670000000000000001e-16", 24, 40), 1357420771768532992);
    EXPECT_EQ(fixed("+.5e1", 8, 8), 5 * 256);
    EXPECT_EQ(fixed("-0", 8, 8), 0);
    EXPECT_EQ(fixed("0.0e999999999999", 8, 8), 0);
}

TEST(Decimal, RoundsHalvesToEven) {
    EXPECT_EQ(fixed("0.5", 8, 0), 0);
    EXPECT_EQ(fixed("1.5", 8, 0), 2);
    EXPECT_EQ(fixed("-2.5", 8, 0), -2);
    EXPECT_EQ(fixed("2.50000000000000000000000000000001", 8, 0), 3);
}

TEST(Decimal, SaysWhatDoesNotFit) {
    for (const char* text :
         {"128", "-128.6", "127.6", "1e300", "-99999999999999999999999999999999999999999999"}) {
        bool overflow = false;
        (void)Decimal::parse(text).to_fixed(fixed_format(8, 0), overflow);
        EXPECT_TRUE(overflow) << text;
    }
    EXPECT_EQ(fixed("-128", 8, 0), -128);
    EXPECT_EQ(fixed("127.4", 8, 0), 127);
}

TEST(Decimal, OfABinary64HasAllItsDigits) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(-1.9, 1.9);
    for (int n = 0; n < 200; ++n) {
        const double value = any(random);
        bool overflow = false;
        const std::int64_t word = Decimal(value).to_fixed(fixed_format(2, 62), overflow);
        EXPECT_EQ(std::ldexp(static_cast<long double>(word), -62), static_cast<long double>(value));
    }
    bool overflow = false;
    EXPECT_EQ(Decimal(std::numeric_limits<double>::denorm_min()).to_fixed(fixed_format(2, 62), overflow), 0);
    EXPECT_FALSE(overflow);
}

// Against 80-digit arithmetic: within one unit of the widest word.
TEST(Decimal, BecomesRadiansToTheLastPlace) {
    struct Case {
        const char* degrees;
        int quarter_turns;
        std::int64_t rest;
    };
    for (const Case& c : {Case{"30.1", 0, 2422722063201348862},
                          Case{"-30.1", 0, -2422722063201348862},
                          Case{"44.99999999999999999", 0, 3622009729038561420},
                          Case{"1e-15", 0, 80},
                          Case{"123456789.123456789123456789", 2, 734338872281512785},
                          Case{"-0.00000000000000000123", 0, 0}}) {
        const Decimal::Turn turn = Decimal::parse(c.degrees).as_degrees();
        EXPECT_EQ(turn.quarter_turns, c.quarter_turns) << c.degrees;
        const auto rest = static_cast<std::int64_t>(nearest(turn.rest, angle_places - 62));
        EXPECT_LE(std::abs(rest - c.rest), 1) << c.degrees;
    }
}

TEST(Decimal, RefusesWhatIsNoNumber) {
    for (const char* text : {"", "-", "1,5", "1e", "0x10", "nan", "inf", "1e999", "5 ", "+-3"}) {
        EXPECT_THROW((void)Decimal::parse(text), Error) << text;
    }
}

} // namespace
} // namespace millwright::cordic
