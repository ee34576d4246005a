// An emulated LinuxCNC in the Machine workspace, by mouse and keys: connected, homed, given a program, held,
// resumed, ended; moved by hand; stopped at the machine.
#include "core/base/files.h"
#include "core/jobs/job_log.h"
#include "tests/support/scratch_folder.h"
#include "tests/ui/person/at_machine.h"
#include "tests/ui/person/linuxcnc_bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::panels {
namespace {

using drivers::DriverState;
using jobs::JobEnd;
using test::LinuxCncBench;
using test::Person;
using testing::HasSubstr;

/// 60 mm to the right in 24 s, so that a slow person finds it on its way, then back.
constexpr const char* there_and_back = "G21 G90 G94 G17\n"
                                       "G0 X0 Y0\n"
                                       "G1 X60 F450\n"
                                       "G1 X0 F1500\n"
                                       "M2\n";
constexpr double far_end = 60.0;

class MachineLinuxCnc : public ::testing::Test {
protected:
    MachineLinuxCnc() = default;
    explicit MachineLinuxCnc(DriverState begins) : begin(begins) {}

    const test::ScratchFolder folder;
    const DriverState begin = DriverState::alarm; ///< as it comes: in its emergency stop
    LinuxCncBench linuxcnc{"router-xyz", begin == DriverState::idle};
    Person person{{1280, 800}, {}, folder / "jobs"};

    [[nodiscard]] actions::ConnectionView machine() { return person.app().look().connection; }
    [[nodiscard]] actions::JobView job() { return person.app().look().job; }
    [[nodiscard]] bool comes_to_rest() {
        return person.live_until([this] { return linuxcnc.rested_for() > 0.2; }, 60.0);
    }
    [[nodiscard]] bool becomes(DriverState state) {
        const bool reached = person.live_until([&] { return test::machine_is(person, state); }, 60.0);
        person.frames(3); // what the panels offer in it
        return reached;
    }

    void connect() {
        person.app().run("view.machine");
        person.frames(3);
        person.click("inspector/connection/driver");
        person.click("inspector/connection/driver/linuxcnc");
        person.frames(2);
        person.fill_in("inspector/connection/address", linuxcnc.address());
        person.click("inspector/connection/machine_connect");
        ASSERT_TRUE(person.live_until([this] { return machine().connected(); }))
            << (machine().failure ? machine().failure->message : "");
        ASSERT_TRUE(becomes(begin));
    }
    void switch_on() {
        connect();
        if (begin == DriverState::idle) {
            return;
        }
        person.click("inspector/connection/machine_reset");
        ASSERT_TRUE(becomes(DriverState::idle)) << machine().status.message;
        person.click("inspector/finding/machine_home");
        ASSERT_TRUE(becomes(DriverState::idle)) << machine().status.message;
        ASSERT_TRUE(takes_moves());
    }
    /// It is homed once it refuses no move any more; before, it may be on its way there.
    [[nodiscard]] bool takes_moves() {
        using State = drivers::CommandAnswer::State;
        constexpr int tries = 20;
        for (int n = 0; n < tries; ++n) {
            const int before = machine().status.answer.number;
            person.fill_in("lower/command", "G0 X0 Y0 Z0");
            (void)person.live_until([&] {
                const auto answer = machine().status.answer;
                return answer.number > before &&
                       (answer.state == State::done || answer.state == State::refused);
            });
            if (becomes(DriverState::idle) && machine().status.answer.state == State::done) {
                return true;
            }
        }
        return false;
    }
    void load_and_run() {
        write_file(folder / "part.ngc", there_and_back);
        person.open(folder / "part.ngc");
        person.app().run("view.machine");
        person.frames(3);
        test::press_run(person);
        ASSERT_TRUE(person.live_until([this] { return linuxcnc.position(0) > 2.0; }, 60.0))
            << (job().failure ? job().failure->message : "");
    }
    /// What the window shows is what the machine says, once both rest.
    void expect_position(Eigen::Index axis, double mm, double within = 1e-3) {
        EXPECT_TRUE(person.live_until(
            [&] { return std::abs(machine().status.position[axis] - linuxcnc.position(axis)) < 1e-3; }));
        EXPECT_NEAR(machine().status.position[axis], mm, within);
    }
};

/// Homed since before: homing takes this machine a quarter of a minute.
class HomedLinuxCnc : public MachineLinuxCnc {
protected:
    HomedLinuxCnc() : MachineLinuxCnc(DriverState::idle) {}
};

TEST_F(MachineLinuxCnc, IsUnlockedAndHomedBeforeItMoves) {
    connect();
    EXPECT_THAT(machine().status.message, HasSubstr("emergency stop"));
    EXPECT_NE(person.refusal("hand/jog/plus_X"), "");
    EXPECT_THAT(person.refusal("inspector/finding/machine_home"), HasSubstr("unlock it first"));
    person.keep("machine-linuxcnc-locked");
    person.click("inspector/connection/machine_reset");
    ASSERT_TRUE(becomes(DriverState::idle)) << machine().status.message;
    // Not homed: LinuxCNC's own words tell why nothing moves.
    person.fill_in("lower/command", "G0 X5");
    ASSERT_TRUE(person.live_until(
        [this] { return machine().status.answer.state == drivers::CommandAnswer::State::refused; }));
    EXPECT_THAT(machine().status.answer.text, HasSubstr("homed"));
    EXPECT_NEAR(linuxcnc.position(0), 0.0, 1e-9);
}

TEST_F(MachineLinuxCnc, RunsAProgramThatIsHeldResumedAndEnds) {
    switch_on();
    load_and_run();
    ASSERT_TRUE(becomes(DriverState::running));
    person.click("inspector/job/machine_hold");
    ASSERT_TRUE(becomes(DriverState::holding));
    ASSERT_TRUE(comes_to_rest());
    const double held_at = linuxcnc.position(0);
    person.frames(30);
    EXPECT_NEAR(linuxcnc.position(0), held_at, 1e-9);
    EXPECT_LT(held_at, far_end);
    EXPECT_TRUE(job().running);
    person.keep("machine-linuxcnc-held");

    person.click("inspector/overrides/feed_more");
    ASSERT_TRUE(person.live_until([this] { return machine().status.overrides.feed == 110; }));
    person.click("inspector/job/machine_resume");
    ASSERT_TRUE(person.live_until([this] { return job().outcome.has_value(); }, 60.0));
    EXPECT_EQ(job().outcome->end, JobEnd::done) << job().outcome->sentence;
    EXPECT_EQ(job().outcome->executed_blocks, 5);
    EXPECT_EQ(linuxcnc.runs(), 1);
    expect_position(0, 0.0);
    EXPECT_EQ(jobs::read_job_log(job().outcome->log_file).end(), JobEnd::done);
    person.frames(3);
    person.keep("machine-linuxcnc-done");
}

TEST_F(HomedLinuxCnc, StopsAProgramAndTellsWhatIsKnown) {
    switch_on();
    load_and_run();
    person.click("inspector/job/machine_stop");
    ASSERT_TRUE(person.live_until([this] { return job().outcome.has_value(); }, 60.0));
    EXPECT_EQ(job().outcome->end, JobEnd::stopped) << job().outcome->sentence;
    EXPECT_LT(job().outcome->executed_blocks, 5);
    EXPECT_FALSE(linuxcnc.moving());
    const double at = linuxcnc.position(0);
    person.frames(30);
    EXPECT_NEAR(linuxcnc.position(0), at, 1e-9);
}

TEST_F(HomedLinuxCnc, EndsAJobWhenSomebodyPressesTheStopAtTheMachine) {
    switch_on();
    load_and_run();
    linuxcnc.press_emergency_stop();
    ASSERT_TRUE(person.live_until([this] { return job().outcome.has_value(); }, 60.0));
    EXPECT_EQ(job().outcome->end, JobEnd::fault);
    EXPECT_THAT(job().outcome->sentence, HasSubstr("emergency stop"));
    ASSERT_TRUE(becomes(DriverState::alarm));
    EXPECT_NE(person.refusal("inspector/job/machine_run"), "");
    person.keep("machine-linuxcnc-fault");
    person.click("inspector/connection/machine_reset");
    ASSERT_TRUE(becomes(DriverState::idle)) << machine().status.message;
    EXPECT_FALSE(linuxcnc.moving()); // unlocked is not resumed
    EXPECT_EQ(linuxcnc.runs(), 1);
}

TEST_F(HomedLinuxCnc, StopsAtOnceByTheRedButton) {
    switch_on();
    load_and_run();
    person.click("emergency/machine_emergency_stop");
    ASSERT_TRUE(becomes(DriverState::alarm));
    ASSERT_TRUE(comes_to_rest());
    EXPECT_LT(linuxcnc.position(0), far_end);
}

TEST_F(HomedLinuxCnc, IsJoggedByButtonAndStepAndZeroed) {
    switch_on();
    person.hover(person.place("hand/jog/plus_Y").centre());
    person.hold_button(true);
    ASSERT_TRUE(person.hold_until([this] { return linuxcnc.position(1) > 0.2; }));
    person.hold_button(false);
    person.frames(2);
    ASSERT_TRUE(person.live_until([this] { return !linuxcnc.moving(); }));
    ASSERT_TRUE(becomes(DriverState::idle));
    const double rests = linuxcnc.position(1);
    person.frames(30);
    EXPECT_NEAR(linuxcnc.position(1), rests, 1e-9);
    expect_position(1, rests);

    person.click("hand/jog/step/10");
    person.click("hand/jog/minus_X");
    ASSERT_TRUE(person.live_until([this] { return linuxcnc.position(0) < -9.999 && !linuxcnc.moving(); }));
    ASSERT_TRUE(becomes(DriverState::idle));
    expect_position(0, -10.0);

    person.click("hand/position/zero_X");
    ASSERT_TRUE(person.live_until([this] { return std::abs(machine().status.work_position()[0]) < 1e-6; }));
    EXPECT_NEAR(machine().status.position[0], -10.0, 1e-3); // no axis moved
    EXPECT_NE(person.refusal("inspector/overrides/rapid_50"), "");
    EXPECT_NE(person.refusal("inspector/finding/probe"), "");
    person.keep("machine-linuxcnc-jogged");
}

TEST_F(MachineLinuxCnc, ShowsFiveAxesAndJogsThoseThatItCan) {
    LinuxCncBench five("ac-table");
    person.app().view_state().manual.choice = {"linuxcnc", five.address(), "XYZAC"};
    test::connect(person);
    person.frames(3);
    EXPECT_TRUE(person.sees("hand/position/axes/C"));
    EXPECT_THAT(person.refusal("hand/jog/plus_A"), HasSubstr("can only jog XYZ"));
    person.keep("machine-linuxcnc-five-axes");
}

} // namespace
} // namespace millwright::panels
