#include "core/cordic/number_format.h"

#include "core/base/error.h"
#include "core/cordic/arithmetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace millwright::cordic {
namespace {

TEST(NumberFormat, NamesReadBackAsTheyWereWritten) {
    for (const char* name : {"f64", "f32", "q2.22", "q1.7", "q2.62", "q64.0", "q8.24"}) {
        EXPECT_EQ(to_text(parse_number_format(name)), name);
    }
    EXPECT_EQ(parse_number_format("q2.22").word(), 24);
}

TEST(NumberFormat, RefusesWhatIsNoneAndQuotesIt) {
    for (const char* text :
         {"", "q", "q2", "q2.", "q.22", "q2.22x", "q-2.22", "f16", "2.22", "q2,22", "q99999999999.1"}) {
        try {
            static_cast<void>(parse_number_format(text));
            ADD_FAILURE() << text << " was taken";
        } catch (const Error& error) {
            EXPECT_NE(error.diagnostic().message.find(text), std::string::npos);
        }
    }
    for (const char* text : {"q0.22", "q2.63", "q4.3", "q33.32"}) {
        EXPECT_THROW(static_cast<void>(parse_number_format(text)), Error) << text;
    }
}

TEST(RoundingNames, ReadBackAsTheyWereWritten) {
    for (const char* name : {"truncate", "toward-zero", "nearest", "nearest-even"}) {
        EXPECT_EQ(to_text(parse_rounding(name)), name);
    }
    EXPECT_THROW(static_cast<void>(parse_rounding("up")), Error);
}

// Every word of 8 bits and every shift against the library's own rounding.
TEST(ShiftedRight, RoundsEveryWordOfEightBitsAsItsModeSays) {
    for (std::int64_t value = -128; value <= 127; ++value) {
        for (int shift = 0; shift <= 9; ++shift) {
            const double exact = std::ldexp(static_cast<double>(value), -shift);
            const auto rounded = [&](Rounding mode) {
                return static_cast<double>(shifted_right(value, shift, mode));
            };
            EXPECT_EQ(rounded(Rounding::truncate), std::floor(exact));
            EXPECT_EQ(rounded(Rounding::toward_zero), std::trunc(exact) + 0.0);
            EXPECT_EQ(rounded(Rounding::nearest), std::floor(exact + 0.5));
            EXPECT_EQ(rounded(Rounding::nearest_even), std::nearbyint(exact) + 0.0);
        }
    }
}

TEST(FixedPoint, AddsEveryPairOfEightBitWordsOrSaysThatItOverflows) {
    const FixedArithmetic q(fixed_format(2, 6));
    for (std::int64_t a = -128; a <= 127; ++a) {
        for (std::int64_t b = -128; b <= 127; ++b) {
            bool overflow = false;
            EXPECT_EQ(q.sum(a, b, overflow), std::clamp<std::int64_t>(a + b, -128, 127));
            EXPECT_EQ(overflow, a + b < -128 || a + b > 127);
            overflow = false;
            EXPECT_EQ(q.difference(a, b, overflow), std::clamp<std::int64_t>(a - b, -128, 127));
            EXPECT_EQ(overflow, a - b < -128 || a - b > 127);
        }
    }
}

TEST(FixedPoint, HoldsTheWidestWordWithoutWrapping) {
    const FixedArithmetic q(fixed_format(2, 62));
    bool overflow = false;
    EXPECT_EQ(q.sum(INT64_MAX, 1, overflow), INT64_MAX);
    EXPECT_TRUE(overflow);
    overflow = false;
    EXPECT_EQ(q.negated(INT64_MIN, overflow), INT64_MAX);
    EXPECT_TRUE(overflow);
}

TEST(FixedPoint, TakesTheNearestNumberAndRefusesWhatIsTooLarge) {
    const FixedArithmetic q(fixed_format(2, 6));
    for (double value = -2.5; value <= 2.5; value += 0.001) {
        bool overflow = false;
        const auto number = q.from_double(value, overflow);
        const double whole = std::nearbyint(value * 64);
        EXPECT_EQ(overflow, whole < -128 || whole > 127) << value;
        EXPECT_EQ(static_cast<double>(number), std::clamp(whole, -128.0, 127.0) + 0.0) << value;
    }
    bool overflow = false;
    EXPECT_EQ(q.from_double(std::nan(""), overflow), 127);
    EXPECT_TRUE(overflow);
}

} // namespace
} // namespace millwright::cordic
