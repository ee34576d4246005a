// The controls of a connected machine, pressed one by one, and what its controller then does: homing,
// probing, overrides, spindle, coolant, offsets, settings, stop.
#include "core/base/files.h"
#include "tests/ui/person/at_machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace millwright::panels {
namespace {

using actions::Workspace;
using drivers::DriverState;
using jobs::JobEnd;
using test::GrblBench;
using test::Person;
using testing::Contains;
using testing::HasSubstr;

class MachineControls : public ::testing::Test {
protected:
    GrblBench grbl;
    Person person{{1280, 1400}}; // all of the inspector without scrolling

    void SetUp() override { test::connect(person, grbl); }

    [[nodiscard]] drivers::DriverStatus status() { return person.app().look().connection.status; }
    [[nodiscard]] bool is(DriverState state) { return test::machine_is(person, state); }
    [[nodiscard]] bool rests() {
        const bool idle = person.live_until([this] { return is(DriverState::idle); });
        person.frames(3); // what the panels offer then
        return idle;
    }
    /// Presses a button of a machine at rest.
    void press(const std::string& path) {
        ASSERT_TRUE(rests());
        ASSERT_EQ(person.refusal(path), "") << path;
        person.click(path);
    }
    [[nodiscard]] bool obeys(const std::string& line) {
        return person.live_until([&] {
            const auto lines = grbl.lines();
            return std::ranges::find(lines, line) != lines.end();
        });
    }
};

class MachineWithSwitches : public MachineControls {
protected:
    void SetUp() override {
        grbl.install_switches(); // before anybody listens, who would count its answers
        MachineControls::SetUp();
    }
};

TEST_F(MachineControls, DoNotHomeWhereTheControllerHasNoHoming) {
    ASSERT_TRUE(rests());
    EXPECT_THAT(person.refusal("inspector/finding/machine_home"), HasSubstr("($22=0)"));
}

TEST_F(MachineWithSwitches, IsHomed) {
    press("inspector/finding/machine_home");
    ASSERT_TRUE(person.live_until([this] { return status().activity == drivers::Activity::homing; }));
    EXPECT_TRUE(
        person.live_until([this] { return !person.refusal("inspector/job/machine_run").empty(); }, 2.0));
    ASSERT_TRUE(person.live_until([this] { return is(DriverState::idle) && !grbl.moving(); }, 120.0));
    const auto at = grbl.position();
    EXPECT_TRUE(person.live_until([&] { return std::abs(status().position[0] - at[0]) < 0.01; }));
}

TEST_F(MachineWithSwitches, AreNotMovedByAWordInThePaletteElsewhere) {
    ASSERT_TRUE(rests());
    person.app().run("view.design");
    person.frames(2);
    person.app().run("machine.home");
    person.press_key(render::Key::k, true);
    person.frames(2);
    person.type("home");
    person.frames(2);
    person.press_key(render::Key::enter);
    person.frames(30);
    EXPECT_NE(status().activity, drivers::Activity::homing);
    EXPECT_FALSE(grbl.moving());
}

TEST_F(MachineControls, ProbeThePartAndSayWhereItIs) {
    person.fill_in("inspector/finding/probe_speed", "600");
    press("inspector/finding/probe");
    ASSERT_TRUE(person.live_until([this] { return status().probe && status().probe->touched; }, 60.0));
    EXPECT_NEAR(status().probe->position[2], GrblBench::part_height, 0.05);
    ASSERT_TRUE(rests());
    EXPECT_TRUE(person.sees("inspector/finding/probed"));
    EXPECT_LE(grbl.position()[2], GrblBench::part_height); // it has braked behind the touch
    EXPECT_GT(grbl.position()[2], -19.0);                  // and not gone all the way
    person.keep("machine-probed");
}

TEST_F(MachineControls, ChangeFeedRapidAndSpindleByTheirOverrides) {
    press("inspector/overrides/feed_more");
    ASSERT_TRUE(person.live_until([this] { return status().overrides.feed == 110; }));
    press("inspector/overrides/feed_more");
    ASSERT_TRUE(person.live_until([this] { return status().overrides.feed == 120; }));
    press("inspector/overrides/feed_full");
    ASSERT_TRUE(person.live_until([this] { return status().overrides.feed == 100; }));
    for (const int percent : {50, 25, 50, 100}) { // up and down again
        press("inspector/overrides/rapid_" + std::to_string(percent));
        ASSERT_TRUE(person.live_until([&] { return status().overrides.rapid == percent; })) << percent;
    }
    press("inspector/overrides/spindle_less");
    ASSERT_TRUE(person.live_until([this] { return status().overrides.spindle == 90; }));
}

TEST_F(MachineControls, TurnSpindleAndCoolantOnAndOff) {
    person.fill_in("inspector/spindle/rpm", "900");
    press("inspector/spindle/clockwise");
    ASSERT_TRUE(person.live_until([this] { return status().spindle == gcode::SpindleTurning::clockwise; }));
    EXPECT_TRUE(person.live_until(
        [this] { return std::abs(status().spindle_rpm - 900.0) <= 1.0; })); // a later report
    press("inspector/spindle/counterclockwise");
    ASSERT_TRUE(
        person.live_until([this] { return status().spindle == gcode::SpindleTurning::counterclockwise; }));
    press("inspector/spindle/stop");
    ASSERT_TRUE(person.live_until([this] { return status().spindle == gcode::SpindleTurning::stopped; }));
    press("inspector/spindle/flood");
    ASSERT_TRUE(person.live_until([this] { return status().coolant.flood; }));
    press("inspector/spindle/flood");
    ASSERT_TRUE(person.live_until([this] { return !status().coolant.flood; }));
}

TEST_F(MachineControls, ChooseAWorkSystemAndMakeItsZeroHere) {
    person.fill_in("lower/command", "G1 X6 F1200");
    ASSERT_TRUE(person.live_until([this] { return std::abs(status().position[0] - 6.0) < 0.01; }));
    ASSERT_TRUE(rests());
    person.click("lower/tabs/offsets");
    press("lower/offsets/G55");
    ASSERT_TRUE(person.live_until([this] { return status().work_system == 2; }));
    press("hand/position/zero_X");
    ASSERT_TRUE(person.live_until([this] { return std::abs(status().work_position()[0]) < 1e-6; }));
    const auto g55 = [this] {
        const auto offsets = person.app().look().connection.offsets;
        return std::ranges::find(offsets, "G55", &drivers::StoredOffset::name)->value[0];
    };
    EXPECT_TRUE(person.live_until([&] { return std::abs(g55() - 6.0) < 1e-6; }));
    EXPECT_NEAR(grbl.position()[0], 6.0, 0.01); // no axis moved
}

TEST_F(MachineControls, ChangeASettingOfTheController) {
    person.click("lower/tabs/settings");
    person.frames(2);
    person.click("lower/settings/$1");
    ASSERT_TRUE(rests());
    person.fill_in("lower/value", "200");
    const auto value = [this] {
        const auto settings = person.app().look().connection.settings;
        return std::ranges::find(settings, "$1", &drivers::ControllerSetting::name)->value;
    };
    EXPECT_TRUE(person.live_until([&] { return std::abs(value() - 200.0) < 1e-9; }));
}

TEST_F(MachineControls, StopAMoveThatWasTypedWithoutAnAlarm) {
    person.fill_in("lower/command", "G1 X80 F150");
    ASSERT_TRUE(person.live_until([this] { return grbl.moving() && is(DriverState::running); }));
    person.frames(2);
    person.click("inspector/job/machine_stop");
    ASSERT_TRUE(person.live_until([this] { return !grbl.moving(); }));
    EXPECT_LT(grbl.position()[0], 79.0);
    ASSERT_TRUE(person.live_until([this] { return is(DriverState::idle) || is(DriverState::stopped); }));
    const double at = grbl.position()[0];
    person.frames(30);
    EXPECT_NEAR(grbl.position()[0], at, 1e-9);
}

TEST_F(MachineControls, SeeTheEmergencyStopInEachWorkspaceAndBehindEachQuestion) {
    for (const char* workspace :
         {"view.design", "view.grid", "view.toolpath", "view.program", "view.machine", "view.processor"}) {
        person.app().run(workspace);
        person.frames(3);
        EXPECT_EQ(person.refusal("emergency/machine_emergency_stop"), "") << workspace;
    }
    person.app().run("file.open");
    person.frames(3);
    person.click("emergency/machine_emergency_stop");
    ASSERT_TRUE(person.live_until([this] { return is(DriverState::alarm); }));
}

/// What the manual shows: a job over a pseudo-terminal that is paused, overridden, hit by an alarm, and gone
/// on with.
TEST_F(MachineControls, PauseOverrideAndRecoverAJobAfterAFault) {
    std::string text = "G21 G90 G94 G17\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\n";
    constexpr int first = 5; // line of X1
    for (int x = 1; x <= 30; ++x) {
        text += "G1 X" + std::to_string(x) + "\n";
    }
    write_file(person.folder() / "part.ngc", text + "G0 Z5\nM2\n");
    person.open(person.folder() / "part.ngc");
    person.app().run("view.machine");
    person.frames(3);
    test::press_run(person);
    ASSERT_TRUE(person.live_until([this] { return grbl.position()[0] > 2.0; }, 60.0));
    ASSERT_TRUE(person.click_when_offered("inspector/job/machine_hold"));
    ASSERT_TRUE(person.live_until([this] { return is(DriverState::holding) && !grbl.moving(); }));
    person.frames(3);
    person.click("inspector/overrides/feed_less");
    ASSERT_TRUE(person.live_until([this] { return status().overrides.feed == 90; }));
    ASSERT_TRUE(person.click_when_offered("inspector/job/machine_resume"));
    const double held = grbl.position()[0];
    ASSERT_TRUE(person.live_until([&] { return grbl.position()[0] > held + 2.0; }, 60.0));
    grbl.raise_alarm();
    ASSERT_TRUE(person.live_until([this] { return person.app().look().job.outcome.has_value(); }));
    const auto broken = *person.app().look().job.outcome;
    EXPECT_EQ(broken.end, JobEnd::fault) << broken.sentence;
    ASSERT_TRUE(person.live_until([this] { return is(DriverState::alarm); }));
    person.frames(20);
    EXPECT_FALSE(grbl.moving());
    EXPECT_NE(person.refusal("inspector/job/machine_run"), "");
    person.keep("machine-fault");

    // A person looks at it, unlocks it, and goes on a little before the line that is not certain.
    person.click("inspector/connection/machine_reset");
    ASSERT_TRUE(rests());
    EXPECT_FALSE(grbl.moving());
    person.click("inspector/job/begin/on");
    const int line = std::max(broken.executed_blocks, 12);
    person.fill_in("inspector/job/begin/line", std::to_string(line));
    person.wait_idle();
    EXPECT_THAT(person.refusal("inspector/job/machine_run"), HasSubstr("The position may be lost"));
    person.click("inspector/job/begin/trust");
    ASSERT_TRUE(person.live_until([this] { return person.refusal("inspector/job/machine_run").empty(); }));
    test::press_run(person);
    const auto outcome = [this] { return person.app().look().job.outcome; };
    ASSERT_TRUE(person.live_until([&] { return outcome() && outcome()->end != JobEnd::fault; }, 90.0))
        << test::conversation(person);
    EXPECT_EQ(outcome()->end, JobEnd::done) << outcome()->sentence;
    EXPECT_NEAR(grbl.position()[0], 30.0, 0.01);
    EXPECT_GT(line, first);
}

} // namespace
} // namespace millwright::panels
