#include "core/cordic/comparison.h"

#include <gtest/gtest.h>

#include <vector>

namespace millwright::cordic {
namespace {

TEST(Comparison, HasTheNumbersOfTheThesis) {
    const LineTime mcs51 = line_time(mcs51_line_clocks, mcs51_clock_hz);
    EXPECT_DOUBLE_EQ(mcs51.seconds, 1.337e-3);
    EXPECT_EQ(static_cast<int>(mcs51.most_rpm), 44'876);
    const LineTime processor = line_time(74, 8e6);
    EXPECT_DOUBLE_EQ(processor.seconds, 9.25e-6);
    EXPECT_EQ(static_cast<int>(processor.most_rpm), 6'486'486);
    EXPECT_NEAR(100.0 * processor.reduction, 99.308, 5e-4);
    EXPECT_NEAR(processor.times_fewer, 144.5, 0.05);
}

TEST(Sewing, HasTheNumbersOfTheThesis) {
    const StitchTimes times = stitch_times({}, 1.337e-3);
    EXPECT_NEAR(times.period, 0.020, 1e-15);
    EXPECT_NEAR(times.window, 0.01333, 1e-5);
    EXPECT_NEAR(times.screw_rpm, 675.0, 1e-9);
    EXPECT_NEAR(100.0 * times.share, 6.68, 0.006);
    EXPECT_NEAR(100.0 * stitch_times({}, 9.25e-6).share, 0.046, 5e-4);
    EXPECT_TRUE(times.computed_in_time);
    EXPECT_TRUE(times.moved_in_time);
}

TEST(Sewing, SeesWhatComesTooLate) {
    Sewing fast;
    fast.needle_rpm = 50'000.0; // 1.2 ms a stitch: the MCS-51 is too slow, the processor is not
    fast.most_screw_rpm = 100'000.0;
    EXPECT_FALSE(stitch_times(fast, 1.337e-3).computed_in_time);
    EXPECT_TRUE(stitch_times(fast, 9.25e-6).computed_in_time);
    const std::vector<double> compute = {1e-3, 30e-3, 1e-3, 25e-3};
    const std::vector<double> lengths = {3.0, 3.0, 15.0, 3.0};
    const SewingRun run = sew({}, compute, lengths);
    EXPECT_EQ(run.stitches, 4);
    EXPECT_EQ(run.late_computations, 2);
    EXPECT_EQ(run.late_moves, 1); // 15 mm in 13.3 ms need 3375 turns a minute
    EXPECT_EQ(run.first_late, 1);
}

} // namespace
} // namespace millwright::cordic
