#include "core/program/number_format.h"

#include "core/base/error.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <limits>

namespace millwright::program {
namespace {

TEST(NumberFormat, WritesWhatItIsTold) {
    const NumberFormat plain{.decimals = 3};
    EXPECT_EQ(plain.text(1.5), "1.500");
    EXPECT_EQ(plain.text(-0.0004), "0.000");
    const NumberFormat signed_number{.decimals = 4, .plus = true};
    EXPECT_EQ(signed_number.text(2.0), "+2.0000");
    EXPECT_EQ(signed_number.text(-2.0), "-2.0000");
    EXPECT_EQ(signed_number.text(-1e-9), "+0.0000");
    const NumberFormat short_number{.decimals = 3, .leading_zero = false, .trailing_zeros = false};
    EXPECT_EQ(short_number.text(0.5), ".5");
    EXPECT_EQ(short_number.text(-0.25), "-.25");
    EXPECT_EQ(short_number.text(0.0), "0.");
    EXPECT_EQ(short_number.text(10.0), "10.");
    EXPECT_EQ(short_number.text(100.0), "100.");
    const NumberFormat whole{.decimals = 0, .point = false};
    EXPECT_EQ(whole.text(8000.4), "8000");
    EXPECT_EQ(whole.text(0.0), "0");
    EXPECT_EQ((NumberFormat{.decimals = 0}).text(7.0), "7.");
    EXPECT_EQ((NumberFormat{.decimals = 3, .trailing_zeros = false, .point = false}).text(8000.0), "8000");
}

TEST(NumberFormat, RoundsToWhatIsWritten) {
    const NumberFormat number{.decimals = 2};
    EXPECT_EQ(number.rounded(1.006), 1.01);
    EXPECT_EQ(number.rounded(-1.004), -1.0);
    EXPECT_EQ(number.digit(), 0.01);
}

TEST(NumberFormat, RefusesWhatIsNoNumber) {
    const test::WithoutTraps no_number;
    EXPECT_THROW((void)NumberFormat{}.text(std::numeric_limits<double>::quiet_NaN()), Defect);
}

} // namespace
} // namespace millwright::program
