#include "core/drivers/jitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace millwright::drivers {
namespace {

TEST(JitterMeter, TellsWhatSortingAllOfThemWould) {
    std::mt19937 random(7);
    std::lognormal_distribution<double> delay(-9.0, 1.0);
    JitterMeter meter;
    std::vector<double> all;
    for (int n = 0; n < 20'000; ++n) {
        all.push_back(delay(random));
        meter.add(all.back());
    }
    std::ranges::sort(all);
    const Jitter jitter = meter.jitter();
    EXPECT_EQ(jitter.count, 20'000);
    EXPECT_DOUBLE_EQ(jitter.least, all.front());
    EXPECT_DOUBLE_EQ(jitter.most, all.back());
    EXPECT_NEAR(jitter.mean, std::accumulate(all.begin(), all.end(), 0.0) / 20'000.0, 1e-12);
    EXPECT_NEAR(jitter.median, all[9'999], 0.01 * all[9'999]);
    EXPECT_NEAR(jitter.p95, all[18'999], 0.01 * all[18'999]);
    EXPECT_NEAR(jitter.p99, all[19'799], 0.01 * all[19'799]);
    std::int64_t below = 0;
    for (std::size_t n = 0; n < Jitter::bounds.size(); ++n) {
        below += jitter.histogram[n];
        EXPECT_EQ(below, std::ranges::upper_bound(all, Jitter::bounds[n]) - all.begin());
    }
    EXPECT_EQ(below + jitter.histogram.back(), 20'000);
}

TEST(JitterMeter, HasNoNumbersBeforeTheFirst) {
    const Jitter jitter = JitterMeter().jitter();
    EXPECT_EQ(jitter.count, 0);
    EXPECT_EQ(jitter.mean, 0.0);
}

TEST(JitterMeter, TakesTooEarlyForInTimeAndAnyDelay) {
    JitterMeter meter;
    meter.add(-1.0);
    meter.add(1e6);
    EXPECT_EQ(meter.jitter().least, 0.0);
    EXPECT_EQ(meter.jitter().most, 1e6);
    EXPECT_EQ(meter.jitter().histogram.back(), 1);
}

} // namespace
} // namespace millwright::drivers
