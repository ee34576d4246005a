#include "core/base/error.h"
#include "core/motion/trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace millwright::motion {
namespace {

/// Speeds that never jump, accelerations that do; a rest in between and one at the end.
std::vector<Phase> random_phases(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<Phase> phases;
    Phase now;
    const auto go_on = [&](double duration, double acceleration) {
        now.acceleration = acceleration;
        phases.push_back(now);
        now.way += (now.speed + 0.5 * acceleration * duration) * duration;
        now.speed = std::max(0.0, now.speed + acceleration * duration);
        now.time += duration;
    };
    for (int n = 0; n < 30; ++n) {
        go_on(0.1 * share(random), share(random));
        go_on(0.1 * share(random), 0.0);
        const double a = 1.0 + share(random);
        go_on(n % 10 == 9 ? now.speed / a : 0.5 * now.speed / a, -a);
        if (n % 10 == 9) {
            now.speed = 0.0;
            go_on(0.3, 0.0);
        }
    }
    phases.push_back({now.time, now.way, 0.0, 0.0});
    return phases;
}

double unfiltered_way(const std::vector<Phase>& phases, double time) {
    const Phase* now = &phases.front();
    for (const Phase& phase : phases) {
        now = phase.time <= time ? &phase : now;
    }
    const double dt = std::max(0.0, time - now->time);
    return now->way + (now->speed + 0.5 * now->acceleration * dt) * dt;
}

/// By Simpson's rule over many small steps.
double mean_way(const std::vector<Phase>& phases, double time, double window) {
    constexpr int steps = 2000;
    double sum = 0.0;
    for (int k = 0; k <= steps; ++k) {
        const double weight = k == 0 || k == steps ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
        sum += weight * unfiltered_way(phases, time - window + window * k / steps);
    }
    return sum / (3.0 * steps);
}

constexpr double window = 0.15;

TEST(Timing, IsTheMeanOfTheUnfilteredWay) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const std::vector<Phase> phases = random_phases(seed);
        const Timing timing(phases, window);
        for (int k = 0; k <= 100; ++k) {
            const double time = timing.end() * k / 100.0;
            EXPECT_NEAR(timing.at(time).way, mean_way(phases, time, window), 1e-8);
        }
    }
}

TEST(Timing, HasTheDerivativesOfItsWay) {
    const Timing timing(random_phases(7), window);
    constexpr double h = 1e-4;
    for (int k = 1; k < 1000; ++k) {
        const double time = timing.end() * k / 1000.0;
        const Motion before = timing.at(time - h);
        const Motion now = timing.at(time);
        const Motion after = timing.at(time + h);
        EXPECT_NEAR((after.way - before.way) / (2.0 * h), now.speed, 1e-6);
        EXPECT_NEAR((after.speed - before.speed) / (2.0 * h), now.acceleration, 1e-2);
        EXPECT_LE(std::abs(after.acceleration - before.acceleration), 2.0 * h * 2.0 * 2.0 / window + 1e-9);
    }
}

TEST(Timing, FindsTheTimeOfAWayAgain) {
    for (const double filter : {0.0, window}) {
        const Timing timing(random_phases(3), filter);
        for (int k = 1; k < 1000; ++k) {
            const double way = timing.phases().back().way * k / 1000.0;
            const double time = timing.time_of(way, 0.0, timing.end() + filter);
            EXPECT_NEAR(timing.at(time).way, way, 1e-13);
        }
    }
}

TEST(Timing, FindsThePhaseOfAnyTime) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int run = 0; run < 50; ++run) {
        std::vector<Phase> phases;
        Phase now;
        for (int n = 0; n < 60; ++n) {
            now.way = n;
            phases.push_back(now);
            now.time += share(random) < 0.3 ? 1e-9 * share(random) : std::pow(share(random), 6.0);
        }
        const Timing timing(phases, 0.0);
        for (int k = 0; k < 500; ++k) {
            const auto n = static_cast<std::size_t>(k) % phases.size();
            const double time = k % 2 == 0 ? phases[n].time : timing.end() * (1.2 * share(random) - 0.1);
            const auto last = std::ranges::upper_bound(phases, time, {}, &Phase::time);
            const double wanted = last == phases.begin() ? 0.0 : (last - 1)->way;
            ASSERT_EQ(timing.unfiltered_at(time).way, wanted);
        }
    }
}

TEST(Timing, RestsExactlyWhereItEnds) {
    const Timing timing(random_phases(2), window);
    const Motion end = timing.at(timing.end() + window);
    EXPECT_EQ(end.way, timing.phases().back().way);
    EXPECT_EQ(end.speed, 0.0);
    EXPECT_EQ(end.acceleration, 0.0);
    EXPECT_EQ(end.jerk, 0.0);
}

TEST(Timing, GoesOnFromItsHistoryAsIfNothingHadHappened) {
    const Timing whole(random_phases(4), window);
    const double cut = 0.37 * whole.end();
    std::vector<Phase> phases = whole.history(cut);
    const Phase now = phases.back();
    phases.back().acceleration = whole.unfiltered_at(cut).acceleration;
    for (Phase phase : whole.phases()) {
        phase.time -= cut;
        if (phase.time > now.time) {
            phases.push_back(phase);
        }
    }
    const Timing rest(phases, window);
    for (int k = 0; k <= 100; ++k) {
        const double time = rest.end() * k / 100.0;
        EXPECT_NEAR(rest.at(time).way, whole.at(cut + time).way, 1e-12);
        EXPECT_NEAR(rest.at(time).acceleration, whole.at(cut + time).acceleration, 1e-9);
    }
}

TEST(Timing, RefusesToBeEmpty) {
    EXPECT_THROW(Timing({}, 0.0), Defect);
}

} // namespace
} // namespace millwright::motion
