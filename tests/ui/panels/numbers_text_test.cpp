#include "ui/panels/numbers_text.h"

#include "core/base/units.h"

#include <gtest/gtest.h>

#include <limits>

namespace millwright::panels {
namespace {

TEST(NumbersText, ShowsTheDigitsThatMatter) {
    EXPECT_EQ(length_text(15.8601), "15.860");
    EXPECT_EQ(length_text(0.04567), "0.0457");
    EXPECT_EQ(angle_text(pi / 8.0), "22.50");
    EXPECT_EQ(length_text(std::numeric_limits<double>::infinity()), "-");
}

TEST(NumbersText, ADeviationThatIsSmallIsNotToldAsNone) {
    EXPECT_EQ(deviation_text(1.25), "1.2500");
    EXPECT_EQ(deviation_text(0.0092), "0.0092");
    EXPECT_EQ(deviation_text(0.0000213), "0.000021");
    EXPECT_EQ(deviation_text(-0.0000213), "-0.000021");
    EXPECT_EQ(deviation_text(0.0), "0.0000");
    EXPECT_EQ(deviation_text(1e-14), "0.0000");
    EXPECT_EQ(deviation_text(std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(NumbersText, NamesAChangeWithItsSign) {
    EXPECT_EQ(change_text(2.0, 1.0), "-50.0 %");
    EXPECT_EQ(change_text(2.0, 3.0), "+50.0 %");
    EXPECT_EQ(change_text(0.0, 3.0), "-");
}

TEST(NumbersText, ADateHasTheFormOfTheStandardAndNoDateIsADash) {
    EXPECT_EQ(date_time_text(1'000'000'000).substr(0, 8), "2001-09-"); // the 8th or 9th, by the time zone
    EXPECT_EQ(date_time_text(1'000'000'000).size(), 16U);
    EXPECT_EQ(date_time_text(0), "-");
}

} // namespace
} // namespace millwright::panels
