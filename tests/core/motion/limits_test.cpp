// No axis ever exceeds a limit: random programs of 3 and 5 axes, in all path modes, looked at in a million
// places and more. The judges know the planner's results only: what it says about velocity, acceleration and
// jerk, and, sharing nothing with it, the differences of the positions alone.
#include "core/motion/hold.h"
#include "core/motion/planner.h"
#include "tests/support/motions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace millwright::motion {
namespace {

using kinematics::MachineModel;
using program::PathMode;

/// The greatest use of any limit, as a share of it.
struct Use {
    double velocity = 0.0, acceleration = 0.0, jerk = 0.0;
    int samples = 0;

    void add(double& use, double value, double limit) { use = std::max(use, std::abs(value) / limit); }
};

template <class Motion>
void add_samples(
    Use& use, const Motion& motion, double duration, const MachineModel& machine, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> when(0.0, duration);
    for (int k = 0; k < count; ++k) {
        const Sample sample = motion.at(when(random));
        for (int n = 0; n < machine.axis_count(); ++n) {
            use.add(use.velocity, sample.velocity[n], machine.axis(n).max_velocity);
            use.add(use.acceleration, sample.acceleration[n], machine.axis(n).max_acceleration);
            use.add(use.jerk, sample.jerk[n], machine.axis(n).max_jerk);
        }
    }
    use.samples += count;
}

/// By differences of positions `h` apart: means of the derivatives, which therefore keep the same limits.
template <class Motion>
void add_differences(
    Use& use, const Motion& motion, double duration, const MachineModel& machine, int count, double h) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> when(0.0, std::max(0.0, duration - 3.0 * h));
    for (int k = 0; k < count; ++k) {
        const double t = when(random);
        const auto p0 = motion.at(t).position;
        const auto p1 = motion.at(t + h).position;
        const auto p2 = motion.at(t + 2.0 * h).position;
        const auto p3 = motion.at(t + 3.0 * h).position;
        for (int n = 0; n < machine.axis_count(); ++n) {
            const auto& axis = machine.axis(n);
            use.add(use.velocity, (p1[n] - p0[n]) / h, axis.max_velocity);
            use.add(use.acceleration, (p2[n] - 2.0 * p1[n] + p0[n]) / (h * h), axis.max_acceleration);
            use.add(use.jerk, (p3[n] - 3.0 * p2[n] + 3.0 * p1[n] - p0[n]) / (h * h * h), axis.max_jerk);
        }
    }
    use.samples += count;
}

constexpr double most_by_formula = 1.0 + 1e-9;
constexpr double most_by_differences = 1.0 + 1e-4; // rounding of positions over h^3
constexpr double difference_step = 0.002;          // s, of the differences

void expect_kept(const Use& use, double bound) {
    EXPECT_LE(use.velocity, bound);
    EXPECT_LE(use.acceleration, bound);
    EXPECT_LE(use.jerk, bound);
}

/// Of the greatest jerk all is used; with a soft one the blocks are too short for the other limits.
void expect_used(const Use& use, double jerk_rate) {
    constexpr double soft = 10.0;
    EXPECT_GT(use.jerk, 0.99);
    EXPECT_GT(use.velocity, jerk_rate > soft ? 0.99 : 0.5);
    EXPECT_GT(use.acceleration, jerk_rate > soft ? 0.99 : 0.3);
}

struct Kind {
    std::string machine;    ///< a shipped one, or one of these with another number of rotary axes
    double jerk_rate = 0.0; ///< 1/s: jerk a unit of acceleration
    PathMode mode = PathMode::continuous;
    double tolerance = 0.0;
};

MachineModel machine_of(const Kind& kind) {
    const bool one_rotary = kind.machine == "XYZA";
    const bool three_rotary = kind.machine == "XYZABC";
    if (!one_rotary && !three_rotary) {
        return test::with_jerk(test::machine(kind.machine), kind.jerk_rate);
    }
    kinematics::MachineDescription description = test::machine("ac-table").description();
    kinematics::MachineAxis other = description.table.back(); // C
    description.bodies.clear();
    if (one_rotary) {
        description.table.pop_back();
    } else {
        other.letter = 'B';
        other.direction = Vec3::UnitY();
        other.point = Vec3(5.0, 0.0, 40.0);
        description.head.push_back(other);
    }
    return test::with_jerk(MachineModel(std::move(description)), kind.jerk_rate);
}

Trajectory random_planned(const Kind& kind, const MachineModel& machine, unsigned seed) {
    PlannerSettings settings;
    settings.path = {kind.mode, kind.tolerance};
    return plan(test::random_program(machine, 150, seed), machine, settings, {});
}

// motion has AxisLimits, too.
namespace kept_limits {

class AxisLimits : public testing::TestWithParam<Kind> {};

TEST_P(AxisLimits, HoldAtEveryMoment) {
    Use said;
    Use seen;
    const MachineModel machine = machine_of(GetParam());
    for (unsigned seed = 1; seed <= 15; ++seed) {
        const Trajectory trajectory = random_planned(GetParam(), machine, seed);
        add_samples(said, trajectory, trajectory.duration(), machine, 10'000, seed);
        add_differences(seen, trajectory, trajectory.duration(), machine, 2'000, difference_step);
    }
    expect_kept(said, most_by_formula);
    expect_kept(seen, most_by_differences);
    expect_used(said, GetParam().jerk_rate);
}

/// A run at the machine: holds, resumes and overrides at any moment, also before the last one is done.
struct Ride {
    std::vector<Trajectory> parts;
    std::vector<double> starts; ///< of the parts; each lasts to the next one's start
    double end = 0.0;

    [[nodiscard]] Sample at(double time) const {
        const auto after = std::ranges::upper_bound(starts, time);
        const auto n = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - starts.begin() - 1, 0));
        return parts[n].at(time - starts[n]);
    }
};

Ride random_ride(const Trajectory& trajectory, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    Ride ride{{trajectory}, {0.0}, 0.0};
    for (int k = 0; k < 12; ++k) {
        const Trajectory now = ride.parts.back();
        // Often soon again, while the filter still sees what was before.
        const double time = now.duration() * (k % 3 == 0 ? 0.2 : 0.01) * share(random);
        ride.starts.push_back(ride.starts.back() + time);
        const Override rates{0.1 + 1.9 * share(random), 0.25 + 0.75 * share(random)};
        ride.parts.push_back(k % 3 == 1   ? brake(now, time)
                             : k % 3 == 2 ? go_on_for(k, now, time, rates)
                                          : go_on(now, time, rates));
    }
    const Trajectory last = go_on(ride.parts.back(), ride.parts.back().duration(), {});
    ride.starts.push_back(ride.starts.back() + ride.parts.back().duration());
    ride.parts.push_back(last);
    ride.end = ride.starts.back() + last.duration();
    return ride;
}

TEST_P(AxisLimits, HoldWhileFeedsAreChangedAndMotionsHeld) {
    Use said;
    Use seen;
    const MachineModel machine = machine_of(GetParam());
    for (unsigned seed = 1; seed <= 15; ++seed) {
        const Trajectory trajectory = random_planned(GetParam(), machine, seed);
        const Ride ride = random_ride(trajectory, seed);
        add_samples(said, ride, ride.end, machine, 10'000, seed);
        add_differences(seen, ride, ride.end, machine, 2'000, difference_step);
        EXPECT_EQ(ride.at(ride.end).position, trajectory.at(trajectory.duration()).position);
    }
    expect_kept(said, most_by_formula);
    expect_kept(seen, most_by_differences);
}

std::string name_of(const testing::TestParamInfo<Kind>& kind) {
    return "Case" + std::to_string(kind.index);
}

INSTANTIATE_TEST_SUITE_P(Planner,
                         AxisLimits,
                         testing::Values(Kind{"router-xyz", 20.0, PathMode::continuous, 0.1},
                                         Kind{"router-xyz", 100.0, PathMode::continuous, 0.001},
                                         Kind{"ac-table", 5.0, PathMode::continuous, 0.01},
                                         Kind{"ac-table", 50.0, PathMode::continuous, 1.0},
                                         Kind{"rotary-tilt-listing", 20.0, PathMode::continuous, 0.1},
                                         Kind{"XYZA", 20.0, PathMode::continuous, 0.1},
                                         Kind{"XYZABC", 20.0, PathMode::continuous, 0.1},
                                         Kind{"rotary-tilt-listing", 20.0, PathMode::exact_stop, 0.0}),
                         name_of);

} // namespace kept_limits

} // namespace
} // namespace millwright::motion
