#include "core/pmac_service/scale_calibration.h"

#include "core/base/error.h"
#include "tests/support/reason.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace millwright::pmac {
namespace {

using test::reason;
using ::testing::HasSubstr;

// C1.
TEST(ScaleCalibrationC1, FindsTheScaleOfTheThesisAgain) {
    const auto readings = parse_scale_readings(
        "# motor counts angle\n2, 0, -3\n2; 2220\t7\n2 4440 17.0 # on the wall\n1 1200 10\n\n1 0 0\n",
        "a.csv");
    const auto fits = fit_scales(readings);
    ASSERT_EQ(fits.size(), 2U);
    EXPECT_EQ(fits[0].motor, 1);
    EXPECT_NEAR(fits[0].counts_per_degree, 120.0, 1e-9);
    EXPECT_EQ(fits[0].readings, 2);
    EXPECT_EQ(fits[1].motor, 2);
    EXPECT_NEAR(fits[1].counts_per_degree, 222.0, 1e-9);
    EXPECT_NEAR(fits[1].counts_at_zero, 666.0, 1e-9);
    EXPECT_NEAR(fits[1].rms, 0.0, 1e-12);
}

// No other line leaves smaller squares: the definition, tried around the answer.
TEST(ScaleCalibrationC1, LeavesTheSmallestSquares) {
    std::mt19937 random(4);
    std::normal_distribution<double> noise(0.0, 0.5);
    std::vector<ScaleReading> readings;
    for (int n = 0; n < 40; ++n) {
        readings.push_back({3, 375.0 * n - 4000.0, n * 2.5 + 3.0 + noise(random), n + 1});
    }
    const ScaleFit fit = fit_scales(readings).front();
    const auto squares = [&](double scale, double zero) {
        double sum = 0.0;
        for (const ScaleReading& reading : readings) {
            sum += std::pow(reading.angle - (reading.counts - zero) / scale, 2.0);
        }
        return sum;
    };
    const double best = squares(fit.counts_per_degree, fit.counts_at_zero);
    EXPECT_NEAR(fit.rms, std::sqrt(best / 40.0), 1e-12);
    for (const double off : {-0.1, 0.1}) {
        EXPECT_GT(squares(fit.counts_per_degree + off, fit.counts_at_zero), best);
        EXPECT_GT(squares(fit.counts_per_degree, fit.counts_at_zero + 10.0 * off), best);
    }
    EXPECT_NEAR(fit.counts_per_degree, 150.0, 4.0 * fit.counts_per_degree_error);
    EXPECT_LT(fit.counts_per_degree_error, 1.0);
}

TEST(ScaleCalibrationC1, AByteOrderMarkIsSkipped) {
    EXPECT_EQ(parse_scale_readings("\xEF\xBB\xBF"
                                   "1 0 0\n1 1200 10\n",
                                   "a")
                  .size(),
              2U);
}

TEST(ScaleCalibrationC1, NamesTheReadingThatIsFarthestOff) {
    const ScaleFit fit =
        fit_scales(parse_scale_readings("1 0 0\n1 1200 10\n1 2400 24\n1 3600 30\n1 4800 40\n", "a")).front();
    EXPECT_EQ(fit.worst_line, 3);
    EXPECT_GT(fit.worst, 2.0);
}

TEST(ScaleCalibrationC1, AMotorAgainstItsJointHasANegativeScale) {
    EXPECT_NEAR(
        fit_scales(parse_scale_readings("4 0 0\n4 1500 -10\n", "a")).front().counts_per_degree, -150.0, 1e-9);
}

TEST(ScaleCalibrationC1, SaysWhatIsWrongAndWhere) {
    const auto why = [](std::string_view text) {
        return reason([&] { (void)fit_scales(parse_scale_readings(text, "a.csv")); });
    };
    EXPECT_THAT(why("1 0 0\n1 x 3\n"), HasSubstr("a.csv:2:3: the motor position in counts"));
    EXPECT_THAT(why("9 0 0\n"), HasSubstr("a.csv:1:1: a motor number must be from 1 to 8"));
    EXPECT_THAT(why("1.5 0 0\n"), HasSubstr("a.csv:1:1"));
    EXPECT_THAT(why("1 0\n"), HasSubstr("a.csv:1:4: the measured angle"));
    EXPECT_THAT(why("1 0 nan\n"), HasSubstr("the measured angle"));
    EXPECT_THAT(why("1 0 1 2\n"), HasSubstr("a.csv:1:7: the line has extra text"));
    EXPECT_THAT(why("1 0 0\n"), HasSubstr("motor 1: at least two readings"));
    EXPECT_THAT(why("1 0 5\n1 10 5\n"), HasSubstr("motor 1: at least two readings"));
}

} // namespace
} // namespace millwright::pmac
