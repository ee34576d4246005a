#include "core/cordic_control/stitch_timing.h"

#include "core/cordic/assembler.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace millwright::cordic {
namespace {

TEST(StitchTiming, HasTheNumbersOfTheThesis) {
    const StitchTimes times = stitch_times({}, 1.337e-3);
    EXPECT_NEAR(times.period, 0.020, 1e-15);
    EXPECT_NEAR(times.window, 0.01333, 1e-5);
    EXPECT_NEAR(times.screw_rpm, 675.0, 1e-9);
    EXPECT_NEAR(100.0 * times.share, 6.68, 0.006);
    EXPECT_NEAR(100.0 * stitch_times({}, 9.25e-6).share, 0.046, 5e-4);
    EXPECT_TRUE(times.computed_in_time);
    EXPECT_TRUE(times.moved_in_time);
}

TEST(StitchTiming, SeesWhatComesTooLate) {
    StitchSettings fast;
    fast.needle_rpm = 50'000.0; // 1.2 ms a stitch: the MCS-51 is too slow, the processor is not
    fast.most_screw_rpm = 100'000.0;
    EXPECT_FALSE(stitch_times(fast, 1.337e-3).computed_in_time);
    EXPECT_TRUE(stitch_times(fast, 9.25e-6).computed_in_time);
    const std::vector<Stitch> stitches{{1e-3, 3.0}, {30e-3, 3.0}, {1e-3, 15.0}, {25e-3, 3.0}};
    const StitchTiming run = time_stitches({}, stitches);
    EXPECT_EQ(run.stitches, 4);
    EXPECT_EQ(run.late_computations, 2);
    EXPECT_EQ(run.late_moves, 1); // 15 mm in 13.3 ms need 3375 turns per minute
    EXPECT_EQ(run.late, (std::vector<std::size_t>{1, 2, 3}));
}

// Two lines behind their four and one MOVs: a triangle's sides of 4 and 3 mm.
TEST(StitchTiming, TakesEachSetPointOfARunAsAStitch) {
    const Assembled made =
        assemble("MOV Vmax, 50\nMOV Amax, 500\nMOV XI, 4\nMOV YJ, 0\nG01\nMOV YJ, 3\nG01\nHLT\n", "seam.asm");
    ASSERT_TRUE(made.errors.empty());
    Processor processor({}, made.image);
    processor.run(10'000);
    const std::vector<Stitch> stitches = stitches_of(processor, 1e6, {4.0, 0.0});
    ASSERT_EQ(stitches.size(), 2U);
    EXPECT_EQ(stitches[0].length, 0.0); // the feed was there
    EXPECT_EQ(stitches[1].length, 3.0);
    EXPECT_EQ(stitches_of(processor, 1e6)[0].length, 4.0);
    const double clocks = 3.0 + 15.0 + 82.0; // from one set-point to the next: fetches are within 15 and 82
    EXPECT_NEAR(stitches[1].compute_seconds, clocks * 1e-6, 4e-6);
}

} // namespace
} // namespace millwright::cordic
