#include "core/pmac/driver/internal/steady_speed.h"

#include <gtest/gtest.h>

#include <random>

namespace millwright::pmac::internal {
namespace {

constexpr double poll = 0.02; // s

TEST(SteadySpeed, HardlySwingsWithTheMomentAtWhichAnAnswerIsRead) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> late(0.0, 0.008); // s
    SteadySpeed speed;
    for (int n = 0; n < 500; ++n) {
        const double at = n * poll;
        speed.see(500.0 * at, at + late(random));
        if (at > 2.0 * SteadySpeed::window) {
            EXPECT_NEAR(speed.counts_per_s(), 500.0, 50.0) << at;
        }
    }
}

TEST(SteadySpeed, FollowsAChangeWithinTwoWindowsAndStandsAtOnce) {
    SteadySpeed speed;
    double counts = 0.0;
    int n = 0;
    const auto run = [&](double counts_per_s, double seconds) {
        for (const int end = n + static_cast<int>(seconds / poll + 0.5); n < end; ++n) {
            counts += counts_per_s * poll;
            speed.see(counts, n * poll);
        }
    };
    run(500.0, 1.0);
    EXPECT_NEAR(speed.counts_per_s(), 500.0, 1e-9);
    run(-100.0, 2.0 * SteadySpeed::window + poll);
    EXPECT_NEAR(speed.counts_per_s(), -100.0, 1e-9);
    speed.stand(counts, n * poll);
    EXPECT_EQ(speed.counts_per_s(), 0.0);
}

} // namespace
} // namespace millwright::pmac::internal
