// The virtual machine moved by hand: jogs, homing, single lines. "Stands within 100 ms": it begins to brake
// at once, so that it stands after v / a.
#include "core/base/error.h"
#include "core/drivers/mdi_lines.h"
#include "core/drivers/virtual_machine/internal/virtual_axes.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "tests/core/jobs/router.h"
#include "tests/support/jobs.h"
#include "tests/support/machines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::drivers {
namespace {

using gcode::SpindleTurning;
using internal::VirtualAxes;
using kinematics::AxisKind;
using kinematics::AxisPositions;
using test::router;
using testing::HasSubstr;

struct HandMovedAxesBench {
    std::shared_ptr<const kinematics::MachineModel> model = router();
    VirtualAxes axes{middle(*model), model};

    HandMovedAxesBench() { axes.connect(); }

    static AxisPositions middle(const kinematics::MachineModel& model) {
        AxisPositions position = AxisPositions::Zero(model.axis_count());
        for (int n = 0; n < model.axis_count(); ++n) {
            position[n] = 0.5 * (model.axis(n).min + model.axis(n).max);
        }
        return position;
    }
    [[nodiscard]] AxisPositions here() const { return axes.status().position; }
    [[nodiscard]] DriverState state() const { return axes.status().state; }
    void settle() { axes.advance(1000.0); }

    CommandAnswer execute(const std::string& lines) {
        (void)axes.command(lines);
        settle();
        return axes.status().answer;
    }
};

Jog along(const HandMovedAxesBench& bench, int axis, double way, double speed, double dead_man = 0.0) {
    Jog jog{AxisPositions::Zero(bench.model->axis_count()), speed, dead_man};
    jog.way[axis] = way;
    return jog;
}

TEST(VirtualJog, GoesExactlyAsFarAsItSaysOneAfterTheOther) {
    HandMovedAxesBench bench;
    const AxisPositions start = bench.here();
    bench.axes.jog(along(bench, 0, 5.0, 20.0));
    bench.axes.jog(along(bench, 1, -3.0, 20.0));
    EXPECT_EQ(bench.axes.status().activity, Activity::jog);
    bench.settle();
    EXPECT_EQ(bench.state(), DriverState::idle);
    EXPECT_NEAR(bench.here()[0] - start[0], 5.0, 1e-9);
    EXPECT_NEAR(bench.here()[1] - start[1], -3.0, 1e-9);
}

TEST(VirtualJog, KeepsItsSpeedWhileItIsRenewed) {
    HandMovedAxesBench bench;
    const Jog jog = along(bench, 0, 4.0, 20.0, 0.2);
    bench.axes.jog(jog);
    bench.axes.advance(0.15);
    for (int n = 0; n < 20; ++n) {
        bench.axes.jog(jog);
        bench.axes.advance(0.05);
        EXPECT_NEAR(bench.axes.status().velocity[0], 20.0, 1e-6);
    }
}

TEST(VirtualJog, StandsAfterTheTimeOfBraking) {
    for (const double speed : {5.0, 40.0}) {
        HandMovedAxesBench bench;
        bench.axes.jog(along(bench, 0, 500.0, speed, 0.2));
        bench.axes.advance(1.0);
        bench.axes.stop_jog();
        bench.axes.advance(speed / bench.model->axis(0).max_acceleration + 1e-6);
        EXPECT_FALSE(bench.axes.moving());
        EXPECT_EQ(bench.state(), DriverState::idle);
    }
}

TEST(VirtualJog, TurnsRound) {
    HandMovedAxesBench bench;
    const double start = bench.here()[0];
    bench.axes.jog(along(bench, 0, 500.0, 20.0, 0.2));
    bench.axes.advance(0.5);
    bench.axes.jog(along(bench, 0, -30.0, 20.0, 0.2));
    bench.settle();
    EXPECT_LT(bench.here()[0], start);
}

TEST(VirtualJog, EndsAtTheLimitsOfTheAxes) {
    HandMovedAxesBench bench;
    const double limit = bench.model->axis(0).max;
    bench.axes.jog(along(bench, 0, 1e5, 1000.0));
    bench.settle();
    EXPECT_NEAR(bench.here()[0], limit, 1e-9);
    EXPECT_LE(bench.here()[0], limit);
    EXPECT_THROW(bench.axes.jog(along(bench, 0, 1.0, 10.0)), Error);
    bench.axes.jog(along(bench, 0, -1.0, 10.0));
    bench.settle();
    EXPECT_NEAR(bench.here()[0], limit - 1.0, 1e-9);
}

TEST(VirtualJog, EndsByHoldStopAndEmergencyStop) {
    HandMovedAxesBench bench;
    bench.axes.jog(along(bench, 0, 100.0, 20.0));
    bench.axes.advance(0.5);
    bench.axes.hold();
    bench.settle();
    EXPECT_EQ(bench.state(), DriverState::idle);
    bench.axes.jog(along(bench, 0, 100.0, 20.0));
    bench.axes.jog(along(bench, 1, 100.0, 20.0));
    bench.axes.advance(0.5);
    const double y = bench.here()[1];
    bench.axes.stop();
    bench.settle();
    EXPECT_EQ(bench.state(), DriverState::stopped);
    EXPECT_EQ(bench.here()[1], y);
    bench.axes.jog(along(bench, 0, -100.0, 20.0));
    bench.axes.advance(0.5);
    bench.axes.emergency_stop("a test");
    const AxisPositions there = bench.here();
    bench.settle();
    EXPECT_EQ(bench.here(), there);
    EXPECT_THROW(bench.axes.jog(along(bench, 0, 1.0, 1.0)), Error);
}

TEST(VirtualJog, NeverLeavesTheLimitsNorGoesOnWhateverTheHandDoes) {
    for (unsigned seed = 1; seed <= 300; ++seed) {
        std::mt19937 random(seed);
        const auto pick = [&random](int count) {
            return static_cast<int>(random() % static_cast<unsigned>(count));
        };
        HandMovedAxesBench bench;
        for (int n = 0; n < 40; ++n) {
            try {
                switch (pick(8)) {
                case 0:
                    bench.axes.stop_jog();
                    break;
                case 1:
                    bench.axes.hold();
                    break;
                case 2:
                    bench.axes.stop();
                    break;
                default:
                    bench.axes.jog(along(
                        bench, pick(3), 300.0 * (pick(3) - 1) + 0.5, 1.0 + 40.0 * pick(4), 0.2 * pick(2)));
                    break;
                }
            } catch (const Error&) {
                // at a limit, or while it brakes
            }
            bench.axes.advance(0.1 * pick(20));
            for (int axis = 0; axis < bench.model->axis_count(); ++axis) {
                EXPECT_GE(bench.here()[axis], bench.model->axis(axis).min - 1e-9) << seed;
                EXPECT_LE(bench.here()[axis], bench.model->axis(axis).max + 1e-9) << seed;
            }
        }
        bench.axes.stop_jog();
        bench.axes.advance(0.1 + 121.0 / bench.model->axis(0).max_acceleration);
        EXPECT_FALSE(bench.axes.moving()) << seed;
    }
}

TEST(VirtualHoming, GoesToZeroAlsoAfterAnAlarm) {
    HandMovedAxesBench bench;
    bench.axes.emergency_stop("a test");
    bench.axes.home();
    bench.settle();
    EXPECT_EQ(bench.state(), DriverState::idle);
    for (int n = 0; n < bench.model->axis_count(); ++n) {
        EXPECT_NEAR(
            bench.here()[n], std::clamp(0.0, bench.model->axis(n).min, bench.model->axis(n).max), 1e-9);
    }
}

TEST(VirtualCommand, IsReadWithTheModesThatTheLinesBeforeLeft) {
    HandMovedAxesBench bench;
    bench.axes.home();
    bench.settle();
    const AxisPositions start = bench.here();
    EXPECT_EQ(bench.execute("G91 G1 X10 F600").state, CommandAnswer::State::done);
    EXPECT_NEAR(bench.here()[0], start[0] + 10.0, 1e-9);
    EXPECT_EQ(bench.execute("X10").state, CommandAnswer::State::done);
    EXPECT_NEAR(bench.here()[0], start[0] + 20.0, 1e-9);
    EXPECT_EQ(bench.execute("G20\nG90 G0 X1").state, CommandAnswer::State::done);
    EXPECT_NEAR(bench.here()[0], 25.4, 1e-9);
    EXPECT_THAT(bench.axes.status().modes, HasSubstr("G20"));
}

TEST(VirtualCommand, IsRefusedWithPlaceAndReasonAndChangesNothing) {
    HandMovedAxesBench bench;
    const AxisPositions start = bench.here();
    for (const char* lines : {"G1 X1", "G0 Q", "G2 X1", "G0 X99999", "o100 sub", "G55\nG0 X99999"}) {
        const CommandAnswer answer = bench.execute(lines);
        EXPECT_EQ(answer.state, CommandAnswer::State::refused) << lines;
        EXPECT_FALSE(answer.text.empty());
        EXPECT_EQ(bench.here(), start);
        EXPECT_EQ(bench.state(), DriverState::idle);
        EXPECT_EQ(bench.axes.status().work_system, 1);
    }
    EXPECT_THAT(bench.execute("G0 X0\nG0 X99999").text, HasSubstr("axis X would move to"));
}

TEST(VirtualCommand, SetsWorkOffsetsAndUsesThem) {
    HandMovedAxesBench bench;
    const AxisPositions start = bench.here();
    (void)bench.execute("G55");
    (void)bench.execute(set_work_position({'X', AxisKind::linear}, 2.0));
    DriverStatus status = bench.axes.status();
    EXPECT_EQ(status.work_system, 2);
    EXPECT_NEAR(status.work_position()[0], 2.0, 1e-9);
    EXPECT_EQ(status.position, start);
    EXPECT_NEAR(bench.axes.stored_offsets()[1].value[0], start[0] - 2.0, 1e-9);
    EXPECT_NEAR(bench.axes.stored_offsets()[0].value[0], 0.0, 1e-9);
    (void)bench.execute("G0 X12");
    EXPECT_NEAR(bench.here()[0], start[0] + 10.0, 1e-9);
    (void)bench.execute("G92 X0");
    EXPECT_NEAR(bench.axes.status().work_position()[0], 0.0, 1e-9);
    (void)bench.execute("G0 X1");
    EXPECT_NEAR(bench.here()[0], start[0] + 11.0, 1e-9);
}

TEST(VirtualCommand, SwitchesSpindleAndCoolant) {
    HandMovedAxesBench bench;
    (void)bench.execute(start_spindle(900.0, false) + "\n" + set_coolant(false, true));
    EXPECT_EQ(bench.axes.status().spindle, SpindleTurning::counterclockwise);
    EXPECT_EQ(bench.axes.status().spindle_rpm, 900.0);
    EXPECT_TRUE(bench.axes.status().coolant.flood);
    (void)bench.execute(stop_spindle() + "\n" + set_coolant(false, false));
    EXPECT_EQ(bench.axes.status().spindle, SpindleTurning::stopped);
    EXPECT_FALSE(bench.axes.status().coolant.flood);
}

TEST(VirtualCommand, CanBeStopped) {
    HandMovedAxesBench bench;
    (void)bench.axes.command("G91 G1 X50 F600");
    EXPECT_EQ(bench.axes.status().activity, Activity::command);
    bench.axes.advance(1.0);
    bench.axes.stop();
    bench.settle();
    EXPECT_EQ(bench.axes.status().answer.state, CommandAnswer::State::refused);
    EXPECT_EQ(bench.state(), DriverState::stopped);
}

TEST(VirtualMachineByHand, StopsAJogWhoseHandIsDeadToTheMillisecond) {
    const auto model = router();
    for (const double factor : {1.0, 20.0, VirtualSpeed::unlimited}) {
        test::ManualClock clock;
        VirtualMachine machine(HandMovedAxesBench::middle(*model), {factor}, clock, model);
        machine.connect();
        const AxisPositions start = machine.status().position;
        Jog jog{AxisPositions::Zero(model->axis_count()), 20.0, 0.2};
        jog.way[0] = 500.0;
        machine.jog(jog);
        clock.wait(5.0);
        const double a = model->axis(0).max_acceleration;
        // up to speed and on for 0.2 s, and braking
        EXPECT_NEAR(machine.status().position[0] - start[0], 20.0 * 0.2, 20.0 * 20.0 / a + 1e-6);
        EXPECT_LE(machine.status().position[0] - start[0], 20.0 * 0.2 + 1e-9);
        EXPECT_EQ(machine.status().state, DriverState::idle);
    }
}

TEST(VirtualMachineByHand, RefusesWhatItCannotDoWithoutAModel) {
    test::ManualClock clock;
    VirtualMachine machine(AxisPositions::Zero(3), {}, clock);
    machine.connect();
    EXPECT_FALSE(machine.capabilities().manual.jog);
    EXPECT_THROW(machine.jog({AxisPositions::Ones(3), 1.0, 0.0}), Error);
    EXPECT_THROW((void)machine.command("G0 X1"), Error);
    EXPECT_THROW(machine.home(), Error);
}

} // namespace
} // namespace millwright::drivers
