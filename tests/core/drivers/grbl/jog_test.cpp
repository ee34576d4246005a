// Jogs on an emulated Grbl. "Stands within 100 ms" means: from the moment when the hand lets go, the window
// loses the focus or the link breaks, to the moment when the emulated machine moves no more, there are at
// most 0.1 s and the time v / a that braking takes at its acceleration a, where v is the greatest speed that
// it still comes to (it may be speeding up, and Grbl has prepared the next 50 ms).
#include "core/base/error.h"
#include "core/drivers/grbl/internal/grbl_session.h"
#include "tests/core/drivers/grbl/grbl_wire.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::drivers::grbl {
namespace {

using test::GrblWire;

constexpr double promise = 0.1; // s
constexpr double tick = 0.001;  // s, of the wire

Jog jog(double x, double y, double speed, double dead_man = 0.0) {
    Jog jog;
    jog.way = kinematics::AxisPositions::Zero(3);
    jog.way[0] = x;
    jog.way[1] = y;
    jog.speed = speed;
    jog.dead_man = dead_man;
    return jog;
}

std::string accelerations(double a) {
    return fmt::format("$120={0}\n$121={0}\n$122={0}\n$110=9000\n$111=9000\n", a);
}

/// A session that has read the settings of a controller with acceleration `a`.
struct GrblJogBench {
    explicit GrblJogBench(double a, const links::FaultSpec& faults = {})
        : acceleration(a), wire(faults, {}, {}, accelerations(a)) {
        wire.session.opened(wire.now);
        wire.run_until([this] { return wire.session.greeted(); }, 10.0);
    }

    double acceleration;
    GrblWire wire;

    void step_for(double seconds) {
        for (const double end = wire.now + seconds; wire.now < end;) {
            wire.step(tick);
        }
    }
    [[nodiscard]] double speed() {
        const auto before = wire.grbl.position();
        wire.step(tick);
        const auto after = wire.grbl.position();
        return std::hypot(after[0] - before[0], after[1] - before[1], after[2] - before[2]) / tick;
    }
    /// s from now until the machine moves no more, for good, without the time of braking.
    double time_before_braking() {
        const double begin = wire.grbl.time();
        double greatest = speed();
        for (const double end = wire.now + 2.0; wire.now < end;) {
            greatest = std::max(greatest, speed());
        }
        step_for(5.0);
        EXPECT_FALSE(wire.grbl.moving());
        return std::max(0.0, wire.grbl.truth().last_motion - begin - greatest / acceleration);
    }
    /// Holds a key down: the jog is renewed every 50 ms.
    void hold_key(double seconds, const Jog& wanted) {
        for (const double end = wire.now + seconds; wire.now < end;) {
            wire.session.jog(wanted, wire.now);
            step_for(0.05);
        }
    }
};

TEST(GrblJog, GoesExactlyAsFarAsItSays) {
    GrblJogBench bench(200.0);
    bench.wire.session.jog(jog(5.0, 0.0, 20.0), bench.wire.now);
    EXPECT_EQ(bench.wire.session.status().activity, Activity::jog);
    bench.wire.session.jog(jog(0.0, -1.2345, 20.0), bench.wire.now);
    bench.wire.run_to_end();
    EXPECT_EQ(bench.wire.state(), DriverState::idle);
    EXPECT_NEAR(bench.wire.grbl.position()[0], 5.0, 1e-9);
    EXPECT_NEAR(bench.wire.grbl.position()[1], -1.2345, 0.003); // a step is 0.004 mm
}

TEST(GrblJog, ReachesTheSpeedThatIsAskedFor) {
    for (const double speed : {5.0, 25.0, 50.0}) {
        GrblJogBench bench(500.0);
        bench.hold_key(1.0, jog(200.0, 0.0, speed, 0.2));
        EXPECT_NEAR(bench.speed(), speed, 0.05 * speed);
    }
}

TEST(GrblJog, StandsWithin100MillisecondsOfItsRelease) {
    for (const double a : {100.0, 500.0, 3000.0}) {
        for (const double v : {2.0, 25.0, 120.0}) {
            GrblJogBench bench(a);
            bench.hold_key(1.5, jog(150.0, 100.0, v, 0.2));
            bench.wire.session.stop_jog(bench.wire.now);
            EXPECT_LT(bench.time_before_braking(), promise) << "a " << a << " v " << v;
            EXPECT_EQ(bench.wire.state(), DriverState::idle);
        }
    }
}

TEST(GrblJog, StandsWithin100MillisecondsOfALinkThatBreaksOrFallsSilent) {
    for (const bool silent : {false, true}) {
        for (const double a : {100.0, 500.0, 3000.0}) {
            for (const double v : {2.0, 25.0, 120.0}) {
                GrblJogBench bench(a);
                bench.hold_key(1.5, jog(150.0, 100.0, v, 0.2));
                silent ? bench.wire.go_deaf() : bench.wire.cut();
                EXPECT_LT(bench.time_before_braking(), promise) << "a " << a << " v " << v;
                EXPECT_EQ(bench.wire.state(), DriverState::alarm);
            }
        }
    }
}

TEST(GrblJog, StandsWithin100MillisecondsOfADeadHand) {
    GrblJogBench bench(500.0);
    constexpr double dead_man = 0.2;
    bench.wire.session.jog(jog(150.0, 0.0, 50.0, dead_man), bench.wire.now);
    EXPECT_LT(bench.time_before_braking(), dead_man + promise);
    EXPECT_EQ(bench.wire.state(), DriverState::idle);
}

TEST(GrblJog, TurnsRoundWhereTheHandWantsIt) {
    GrblJogBench bench(500.0);
    bench.hold_key(1.0, jog(150.0, 0.0, 25.0, 0.2));
    bench.hold_key(2.0, jog(-150.0, 0.0, 25.0, 0.2));
    bench.wire.session.stop_jog(bench.wire.now);
    (void)bench.time_before_braking();
    EXPECT_LT(bench.wire.grbl.position()[0], 0.0);
    EXPECT_EQ(bench.wire.grbl.position()[1], 0.0);
}

TEST(GrblJog, EndsAtTheTravelWithTheReason) {
    GrblWire wire({}, {}, {}, "$22=1\n$20=1\n$25=3000\n");
    wire.session.home(wire.now);
    wire.run_to_end();
    wire.session.jog(jog(-500.0, 0.0, 100.0), wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_NE(wire.session.status().message.find("error 15"), std::string::npos);
    EXPECT_GT(wire.grbl.position()[0], -200.001);
    EXPECT_LT(wire.grbl.position()[0], -190.0);
}

/// A hand that presses and releases keys at random, a window that loses its focus, a link that breaks.
TEST(GrblJog, NeverLeavesTheMachineMovingWhateverTheHandDoes) {
    constexpr int runs = 1000;
    double longest = 0.0;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        std::mt19937_64 random(seed);
        const auto pick = [&random](int count) {
            return static_cast<int>(random() % static_cast<unsigned>(count));
        };
        const double a = 200.0 * (1 + pick(5));
        GrblJogBench bench(a, {.delay = 0.001 * pick(10), .seed = seed});
        bool broken = false;
        for (int n = 0; n < 12 && !broken; ++n) {
            const Jog wanted = jog(
                20.0 * (pick(3) - 1), 7.0 * (1 + pick(9)), 5.0 + 10.0 * pick(6), pick(4) == 0 ? 0.0 : 0.15);
            switch (pick(8)) {
            case 0:
                bench.wire.session.hold(bench.wire.now);
                break;
            case 1:
                bench.wire.session.stop(bench.wire.now);
                break;
            case 2:
                broken = pick(4) == 0;
                pick(2) == 0 && broken ? bench.wire.go_deaf() : (broken ? bench.wire.cut() : void());
                break;
            default:
                try {
                    bench.wire.session.jog(wanted, bench.wire.now);
                } catch (const Error&) {
                    // not while it brakes
                }
                break;
            }
            bench.step_for(0.02 * pick(20));
        }
        bench.wire.session.stop_jog(bench.wire.now);
        const double rest = bench.time_before_braking();
        longest = std::max(longest, rest);
        EXPECT_LT(rest, promise) << "seed " << seed;
    }
    fmt::print("the slowest braked after {:.0f} ms\n", longest * 1e3);
}

} // namespace
} // namespace millwright::drivers::grbl
