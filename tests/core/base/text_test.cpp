#include "core/base/text.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/numbers.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace millwright {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(WideEncoding, IsKnownByMarkOrByZeroBytes) {
    using namespace std::string_literals;
    EXPECT_EQ(wide_encoding("\xFF\xFEG\0"s), "UTF-16");
    EXPECT_EQ(wide_encoding("\xFE\xFF\0G"s), "UTF-16");
    EXPECT_EQ(wide_encoding("G\0002\0"s), "UTF-16");
    EXPECT_EQ(wide_encoding("\0G\0002"s), "UTF-16");
    EXPECT_EQ(wide_encoding("\xFF\xFE\0\0G\0\0\0"s), "UTF-32");
    EXPECT_EQ(wide_encoding("\0\0\xFE\xFF\0\0\0G"s), "UTF-32");
    EXPECT_EQ(wide_encoding("G\0\0\0"s), "UTF-32");
    EXPECT_EQ(wide_encoding("\0\0\0G"s), "UTF-32");
    for (const std::string& text : {"G21"s, ""s, "\xEF\xBB\xBFG21"s, "\0\0\0\0"s, "G21\0"s, "G\0"s}) {
        EXPECT_EQ(wide_encoding(text), "");
    }
}

TEST(Fixed, HasTheDecimalsAskedForAndNoNegativeZero) {
    EXPECT_EQ(fixed(1.5, 3), "1.500");
    EXPECT_EQ(fixed(-0.0004, 3), "0.000");
    EXPECT_EQ(fixed(-0.0006, 3), "-0.001");
    EXPECT_EQ(fixed(-2.0, 0), "-2");
}

TEST(ByteOrderMark, IsSkippedOnceAtTheBeginning) {
    EXPECT_EQ(without_byte_order_mark("\xEF\xBB\xBFIP"), "IP");
    EXPECT_EQ(without_byte_order_mark("IP\xEF\xBB\xBF"), "IP\xEF\xBB\xBF");
    EXPECT_EQ(without_byte_order_mark("\xEF\xBB"), "\xEF\xBB");
    EXPECT_EQ(without_byte_order_mark(""), "");
}

TEST(WideEncoding, IsRecognisedByItsZeroBytesAndNotByZerosThatFillAFile) {
    using namespace std::string_literals;
    EXPECT_EQ(wide_encoding("\xFF\xFEG\0"s), "UTF-16");
    EXPECT_EQ(wide_encoding("\xFF\xFE\0\0G\0\0\0"s), "UTF-32");
    EXPECT_EQ(wide_encoding("G\0\x31\0\x31\x0E1\0"s), "UTF-16"); // with a letter of another script
    EXPECT_EQ(wide_encoding("\0G\0\x31\0\x32"s), "UTF-16");
    EXPECT_EQ(wide_encoding("\0\0\0G\0\0\0\x31"s), "UTF-32");
    EXPECT_EQ(wide_encoding("G0 X1\n"), "");
    EXPECT_EQ(wide_encoding("PU;\0"s), "");
    EXPECT_EQ(wide_encoding("IN;PU0,0;\0\0\0\0\0\0\0"s), "");
    EXPECT_EQ(wide_encoding("\0\0\0\0IN;PU0,0;"s), "");
    EXPECT_EQ(wide_encoding(""), "");
}

TEST(Shortest, ReadsBackAsTheSameNumber) {
    std::mt19937_64 random(1997);
    std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
    std::uniform_int_distribution<int> exponent(-300, 300);
    for (int n = 0; n < 1000; ++n) {
        const double value = std::ldexp(mantissa(random), exponent(random));
        EXPECT_EQ(std::stod(shortest(value)), value);
    }
}

TEST(Numbers, BecomeTextOnlyWhenFinite) {
    EXPECT_THROW((void)fixed(nan, 3), Defect);
    EXPECT_THROW((void)shortest(infinity), Defect);
}

TEST(ClockTime, RoundsUpToWholeSeconds) {
    EXPECT_EQ(clock_time(0.0), "00:00:00");
    EXPECT_EQ(clock_time(59.2), "00:01:00");
    EXPECT_EQ(clock_time(0.1 + 0.2 + 0.7), "00:00:01");
    EXPECT_EQ(clock_time(10.0 * (0.1 + 0.2)), "00:00:03"); // 3.0000000000000004
    EXPECT_EQ(clock_time(3725.0), "01:02:05");
}

TEST(Text, ShowsShortTimesInSeconds) {
    EXPECT_EQ(short_time(0.163), "0.16 s");
    EXPECT_EQ(short_time(59.2), "59.20 s");
    EXPECT_EQ(short_time(61.0), "00:01:01");
}

TEST(Text, CountsInThePluralExceptOfOne) {
    EXPECT_EQ(counted(0, "point"), "0 points");
    EXPECT_EQ(counted(1, "point"), "1 point");
    EXPECT_EQ(counted(2, "point"), "2 points");
    EXPECT_EQ(counted(1, "axis", "axes"), "1 axis");
    EXPECT_EQ(counted(3, "axis", "axes"), "3 axes");
}

TEST(ExactlyEqual, IsEqualityAndNothingElse) {
    EXPECT_TRUE(exactly_equal(0.0, -0.0));
    EXPECT_FALSE(exactly_equal(1.0, std::nextafter(1.0, 2.0)));
    EXPECT_FALSE(exactly_equal(nan, nan));
}

} // namespace
} // namespace millwright
