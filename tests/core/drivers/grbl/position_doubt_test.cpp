// A Grbl that no longer knows where its machine stands, and says nothing of it.
#include "core/drivers/grbl/internal/position_doubt.h"

#include "core/base/error.h"
#include "core/drivers/grbl/codes.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/job_log.h"
#include "core/jobs/recovery.h"
#include "core/jobs/run_from_line.h"
#include "tests/core/drivers/grbl/wire_driver.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::drivers::grbl {
namespace {

using test::GrblWire;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double long_run = 1e5; // s

std::string zigzag_below_surface(int passes) {
    std::string text = "G21 G90 G94 G17\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F3000\n";
    for (int n = 1; n <= passes; ++n) {
        text += "X" + std::to_string(n % 2 == 0 ? 1 : 20) + " Y" + std::to_string(n) + "\n";
    }
    return text + "G0 Z5\nM30\n";
}

std::string doubt(const GrblWire& wire) {
    return wire.session.status().position_doubt;
}

/// Somebody has looked at the machine before.
void trust(GrblWire& wire) {
    ASSERT_THAT(doubt(wire), Not(IsEmpty()));
    wire.session.trust_position();
    ASSERT_THAT(doubt(wire), IsEmpty());
}

void unlock(GrblWire& wire) {
    wire.run_until([] { return false; }, 1.0); // its buffers are emptied by then
    wire.session.reset(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 10.0));
}

void type_lines(GrblWire& wire, const std::string& lines) {
    (void)wire.session.command(command_lines(lines), wire.now);
    wire.run_to_end();
}

TEST(GrblPositionDoubt, ArisesWhenTheControllerIsResetUnderAProgramAndOutlastsTheUnlocking) {
    GrblWire wire({.reset = 1500});
    trust(wire);
    wire.start(zigzag_below_surface(40));
    wire.run_to_end();
    ASSERT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(doubt(wire), HasSubstr("was reset"));
    unlock(wire);
    EXPECT_THAT(doubt(wire), HasSubstr("was reset"));
}

TEST(GrblPositionDoubt, ArisesWhereAnEmergencyStopCutsTheMotionOff) {
    GrblWire wire;
    trust(wire);
    wire.start(zigzag_below_surface(40));
    wire.run_until([&] { return wire.grbl.moving() && wire.grbl.position()[0] > 5.0; }, 20.0);
    wire.session.emergency_stop(wire.now);
    wire.run_to_end();
    EXPECT_THAT(doubt(wire), Not(IsEmpty()));
    unlock(wire);
    EXPECT_THAT(doubt(wire), Not(IsEmpty()));
}

TEST(GrblPositionDoubt, DoesNotAriseWhereTheMachineBraked) {
    GrblWire wire;
    trust(wire);
    wire.start(zigzag_below_surface(40));
    wire.run_until([&] { return wire.grbl.position()[0] > 5.0; }, 20.0);
    wire.session.stop(wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::stopped);
    EXPECT_THAT(doubt(wire), IsEmpty());
}

TEST(GrblPositionDoubt, ArisesOfAlarmsThatCutMotionOffAlone) {
    for (const int kept : {2, 4, 5}) {
        EXPECT_FALSE(grbl_alarm_loses_position(kept)) << kept;
    }
    for (const int lost : {1, 3, 6, 7, 8, 9, 99}) {
        EXPECT_TRUE(grbl_alarm_loses_position(lost)) << lost;
    }
}

TEST(GrblPositionDoubt, EndsWhenEveryAxisHasANewZero) {
    GrblWire wire;
    type_lines(wire, "G10 L20 P1 X0 Y0");
    EXPECT_THAT(doubt(wire), Not(IsEmpty()));
    type_lines(wire, "G92 Z+5.");
    EXPECT_THAT(doubt(wire), IsEmpty());
}

TEST(GrblPositionDoubt, IsNotEndedByARefusedZero) {
    GrblWire wire;
    type_lines(wire, "G10 L20 P77 X0 Y0 Z0");
    ASSERT_EQ(wire.session.status().answer.state, CommandAnswer::State::refused);
    EXPECT_THAT(doubt(wire), Not(IsEmpty()));
}

TEST(GrblPositionDoubt, EndsWithHoming) {
    GrblWire wire;
    test::store_settings(wire.grbl, "$22=1\n$25=3000\n");
    wire.run_until([] { return false; }, 0.5);
    EXPECT_THAT(doubt(wire), Not(IsEmpty()));
    wire.session.home(wire.now);
    wire.run_to_end();
    EXPECT_THAT(doubt(wire), IsEmpty());
}

TEST(GrblPositionDoubt, IsThereFromTheStartOfAControllerThatWasSwitchedOnOrIsLocked) {
    GrblWire wire;
    const auto connect_again = [&] {
        wire.session = GrblSession();
        wire.session.opened(wire.now);
        wire.run_until([&] { return wire.session.greeted(); }, 10.0);
    };
    type_lines(wire, "G0 X3 Y4");
    connect_again(); // it has been running all the time
    EXPECT_THAT(doubt(wire), IsEmpty());
    wire.grbl.power_cycle();
    wire.run_until([] { return false; }, 0.5);
    connect_again();
    const std::string since_then = "not confirmed since Grbl was at zero in all axes, as after switching on";
    EXPECT_EQ(doubt(wire), since_then);
    type_lines(wire, "G0 X3 Y4");
    EXPECT_EQ(doubt(wire), since_then) << "which is still true elsewhere";
    type_lines(wire, "$22=1");
    wire.grbl.power_cycle();
    (void)wire.grbl.take_output(); // before anybody listened
    connect_again();
    ASSERT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(doubt(wire), HasSubstr("locked"));
}

TEST(GrblPositionDoubt, OutlastsALinkThatIsMadeAgain) {
    GrblWire wire;
    trust(wire);
    type_lines(wire, "G0 X3");
    wire.grbl.raise_alarm();
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::alarm; }, 5.0));
    EXPECT_THAT(doubt(wire), HasSubstr("alarm 1"));
    wire.session.lost("somebody pulled it");
    wire.grbl.receive("\x18$X\n"); // somebody else unlocked it
    wire.session.opened(wire.now);
    wire.run_until([&] { return wire.state() == DriverState::idle; }, 10.0);
    EXPECT_THAT(doubt(wire), Not(IsEmpty()));
}

TEST(GrblPositionDoubt, KnowsWhichAxesALineZeroes) {
    EXPECT_EQ(axes_zeroed_by("G10L20P1X0Y0A0", "XYZ"), "XY");
    EXPECT_EQ(axes_zeroed_by("G92Z+1.5A0", "XYZA"), "ZA");
    for (const char* none : {"G92.1", "G10L2P1X0Y0Z0", "G0X0Y0Z0", "G10L20P1", "$X", "M92X1", ""}) {
        EXPECT_EQ(axes_zeroed_by(none, "XYZ"), "") << none;
    }
}

/// What a log and its reader say, and what a job that begins at a line needs.
TEST(GrblPositionDoubt, IsLoggedAndKeepsAJobFromBeginningAtALine) {
    const test::ScratchFolder scratch;
    GrblWire wire({.reset = 2500});
    test::WireClock clock(wire, wire.now + long_run);
    test::WireDriver driver(wire);
    jobs::Dispatcher dispatcher(driver, clock, scratch.path());
    trust(wire);
    const jobs::Job job = jobs::text_job(zigzag_below_surface(40), "zigzag.ngc");
    const jobs::JobOutcome outcome = dispatcher.run(job, {});
    ASSERT_EQ(outcome.end, jobs::JobEnd::fault);
    EXPECT_THAT(outcome.sentence, HasSubstr("The position may be lost (the controller was reset)"));
    EXPECT_EQ(wire.grbl.position()[0], 0.0);
    EXPECT_GT(outcome.position[1], 0.5); // the last that was known, not where Grbl counts from now

    const jobs::JobStory story = jobs::job_story(outcome.log_file);
    EXPECT_EQ(story.position_doubt, "the controller was reset");
    EXPECT_THAT(story.sentence, HasSubstr("home the machine, set its zero, or confirm the position"));
    EXPECT_NEAR(story.position[1], outcome.position[1], 1e-5);

    unlock(wire);
    jobs::RunFromSettings settings;
    settings.dialect = gcode::Dialect::grbl;
    const jobs::Job rest = jobs::job_from_line(job, 20, settings);
    const auto lines = wire.grbl.truth().lines.size();
    try {
        (void)dispatcher.run(rest, {});
        FAIL() << "it began at a line although the machine's position is unknown";
    } catch (const Error& error) {
        EXPECT_THAT(to_text(error.diagnostic()), HasSubstr("Line 20 could start at the wrong position"));
    }
    EXPECT_EQ(wire.grbl.truth().lines.size(), lines);
    driver.trust_position();
    EXPECT_EQ(dispatcher.run(rest, {}).end, jobs::JobEnd::done);
}

/// Stored offsets count from a position that is lost.
TEST(GrblPositionDoubt, KeepsWholeProgramsBackUntilAPersonConfirmsThePositionWhichTheLogRecords) {
    const test::ScratchFolder scratch;
    GrblWire wire({.reset = 2500});
    test::WireClock clock(wire, wire.now + long_run);
    test::WireDriver driver(wire);
    jobs::Dispatcher dispatcher(driver, clock, scratch.path());
    trust(wire);
    ASSERT_EQ(dispatcher.run(jobs::text_job(zigzag_below_surface(40), "zigzag.ngc"), {}).end,
              jobs::JobEnd::fault);
    unlock(wire);
    const jobs::Job next = jobs::text_job("G21 G90 G94\nG1 X5 F600\nM30\n", "next.ngc");
    const auto lines = wire.grbl.truth().lines.size();
    try {
        (void)dispatcher.run(next, {});
        FAIL() << "it began although the position is lost";
    } catch (const Error& error) {
        EXPECT_THAT(to_text(error.diagnostic()), HasSubstr("Stored work offsets may be wrong"));
    }
    EXPECT_EQ(wire.grbl.truth().lines.size(), lines);
    driver.trust_position();
    const jobs::JobOutcome outcome = dispatcher.run(next, {});
    EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
    EXPECT_EQ(jobs::read_job_log(outcome.log_file).start.position_confirmed, "the controller was reset");
}

TEST(GrblPositionDoubt, OfAControllerJustSwitchedOnMattersWhereItHasStoredOffsets) {
    const GrblWire wire;
    DriverStatus status = wire.session.status();
    ASSERT_THAT(status.position_doubt, Not(IsEmpty()));
    EXPECT_FALSE(status.position_lost);
    const StoredOffset park{"G28", kinematics::AxisPositions{Vec3(1.0, 0.0, 0.0)}};
    const StoredOffset fixture{"G55", kinematics::AxisPositions{Vec3(1.0, 0.0, 0.0)}};
    EXPECT_FALSE(needs_confirmation(status, {}));
    EXPECT_FALSE(needs_confirmation(status, {park}));
    EXPECT_TRUE(needs_confirmation(status, {park, fixture}));
    status.position_doubt.clear();
    EXPECT_FALSE(needs_confirmation(status, {fixture}));
}

} // namespace
} // namespace millwright::drivers::grbl
