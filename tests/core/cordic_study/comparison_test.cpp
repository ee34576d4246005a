#include "core/cordic_study/comparison.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace millwright::cordic
