#include "core/cordic_machine/cordic_driver.h"

#include "core/base/error.h"
#include "core/cordic_machine/cordic_motion.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/job_log.h"
#include "tests/core/links/reading.h"
#include "tests/support/jobs.h"
#include "tests/support/machines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::cordic_machine {
namespace {

using kinematics::AxisPositions;
using testing::HasSubstr;

struct CordicDriverBench {
    explicit CordicDriverBench(const char* machine_name = "router-xyz")
        : model(std::make_shared<const kinematics::MachineModel>(test::machine(machine_name))),
          driver(AxisPositions::Zero(model->axis_count()), {}, clock, model),
          dispatcher(driver, clock, folder.path() / "logs") {}

    test::TemporaryFolder folder;
    test::ManualClock clock;
    std::shared_ptr<const kinematics::MachineModel> model;
    CordicDriver driver;
    jobs::Dispatcher dispatcher;

    [[nodiscard]] std::string refusal_of(const std::string& text) {
        try {
            (void)dispatcher.run(jobs::text_job(text, "part.ngc"), {});
        } catch (const Error& error) {
            return to_text(error.diagnostic());
        }
        return {};
    }
};

constexpr const char* straight_and_arc_part = "G21 G90 F1200\n"
                                              "S8000 M3\n"
                                              "G0 X10 Y10\n"
                                              "(an arc)\n"
                                              "G3 X5 Y5 I-5 J0\n"
                                              "G1 Z-2\n"
                                              "G4 P0.5\n"
                                              "G2 X5 Y5 Z-4 I3 J0\n"
                                              "M5\n"
                                              "M2\n";

TEST(CordicDriver, RunsAJobFromItsTextToTheEndWithArcsAndTheThirdAxis) {
    CordicDriverBench bench;
    const jobs::Job job = jobs::text_job(straight_and_arc_part, "part.ngc");
    double farthest = 0.0; // of the arc about (5, 10) while it is being executed
    double turning = 0.0;
    int before = 0;
    const jobs::JobOutcome outcome = bench.dispatcher.run(job, {}, [&](const jobs::JobReport& report) {
        const drivers::DriverStatus& now = report.driver;
        EXPECT_GE(now.executed_blocks, before);
        before = now.executed_blocks;
        turning = std::max(turning, now.spindle_rpm);
        if (now.state == drivers::DriverState::running && now.block == 4) {
            const double radius = std::hypot(now.position[0] - 5.0, now.position[1] - 10.0);
            farthest = std::max(farthest, std::abs(radius - 5.0));
        }
    });
    EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
    EXPECT_EQ(outcome.executed_blocks, job.block_count());
    EXPECT_NEAR(outcome.position[0], 5.0, 1e-6);
    EXPECT_NEAR(outcome.position[1], 5.0, 1e-6);
    EXPECT_NEAR(outcome.position[2], -4.0, 1e-6);
    EXPECT_GT(farthest, 0.0);
    EXPECT_LT(farthest, 0.001 + 1e-4); // the tolerance of chords, and what binary32 rounds
    EXPECT_EQ(turning, 8000.0);
    const cordic::RunReport report = bench.driver.report();
    EXPECT_EQ(report.stop, cordic::Stop::halted);
    EXPECT_GT(report.published, 100);
    EXPECT_LT(report.position_error, 1e-4);
    EXPECT_EQ(jobs::read_job_log(outcome.log_file).start.driver, "cordic");
}

TEST(CordicDriver, GoesToMachinePositionsWhereTheOriginIsKnown) {
    const std::string retracts = "G21 G90 F1200\nG0 X10 Y10 Z-5\nG53 G0 Z0\nM2\n";
    CordicDriverBench bench;
    EXPECT_THAT(bench.refusal_of(retracts), HasSubstr("program:3:1: G53 moves to a machine position"));
    EXPECT_EQ(bench.driver.status().position, AxisPositions::Zero(3));
    CordicDriverOptions options;
    options.origin = gcode::WorkOrigin(Vec3(5.0, 0.0, -20.0));
    CordicDriver placed(AxisPositions::Zero(3), {}, bench.clock, bench.model, options);
    jobs::Dispatcher dispatcher(placed, bench.clock, bench.folder.path() / "logs");
    const jobs::JobOutcome outcome = dispatcher.run(jobs::text_job(retracts, "part.ngc"), {});
    EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
    EXPECT_NEAR(outcome.position[bench.model->axis_index('X')], 15.0, 1e-6);
    EXPECT_NEAR(outcome.position[bench.model->axis_index('Z')], 0.0, 1e-6);
}

TEST(CordicDriver, TellsOfSetPointsThatCameLate) {
    CordicDriverBench bench;
    (void)bench.dispatcher.run(jobs::text_job(straight_and_arc_part, "part.ngc"), {});
    EXPECT_TRUE(bench.driver.report().late.empty());
    EXPECT_EQ(bench.driver.remark(), "");
    CordicDriverOptions slow;
    slow.clock_hz = 1e4;
    CordicDriver driver(AxisPositions::Zero(3), {}, bench.clock, bench.model, slow);
    jobs::Dispatcher dispatcher(driver, bench.clock, bench.folder.path() / "slow");
    EXPECT_EQ(dispatcher.run(jobs::text_job(straight_and_arc_part, "part.ngc"), {}).end, jobs::JobEnd::done);
    EXPECT_GT(driver.report().late.size(), 10U);
    EXPECT_THAT(driver.remark(), HasSubstr("set-points took longer to compute at 0.01 MHz than the motion"));
}

TEST(CordicDriver, TellsWhatOfTheLastProgramItDoesOtherwise) {
    CordicDriverBench bench;
    (void)bench.dispatcher.run(jobs::text_job("G21 F600\nG61.1\nG1 X1\nM2\n", "part.ngc"), {});
    const auto warnings = bench.driver.warnings();
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0].place.line, 2);
    EXPECT_THAT(warnings[0].message, HasSubstr("does not stop at corners"));
    (void)bench.dispatcher.run(jobs::text_job("G21 F600\nG1 X2\nM2\n", "next.ngc"), {});
    EXPECT_TRUE(bench.driver.warnings().empty());
}

TEST(CordicDriver, RefusesWhatIsOutsideItsSubsetWithLineAndColumnAndDoesNotMove) {
    CordicDriverBench bench;
    EXPECT_THAT(bench.refusal_of("G21 G0 X1\nG38.2 X5 F100\nM2\n"),
                HasSubstr("program:2:1: the CORDIC processor cannot probe"));
    EXPECT_THAT(bench.refusal_of("G21\nM64 P1\nM2\n"), HasSubstr("program:2:1: the CORDIC"));
    EXPECT_EQ(bench.driver.status().position, AxisPositions::Zero(3));
    EXPECT_EQ(bench.driver.status().state, drivers::DriverState::idle);
}

TEST(CordicDriver, RefusesFiveAxisPrograms) {
    CordicDriverBench bench("rotary-tilt-gui");
    const std::string refusal = bench.refusal_of("G21 G0 X1\nG1 X2 A5 F100\nM2\n");
    EXPECT_THAT(refusal, HasSubstr("program:2:7: the CORDIC processor has no axis A (use only X, Y and Z)"));
    EXPECT_EQ(bench.driver.status().executed_blocks, 0);
}

TEST(CordicDriver, CountsBlocksOfLoopsOnlyWhenNothingOfThemIsLeft) {
    CordicDriverBench bench;
    const jobs::Job job =
        jobs::text_job("G21 F6000\no1 repeat [3]\nG1 X5\nG1 X0\no1 endrepeat\nG1 Y5\nM2\n", "loop.ngc");
    int at_second_turn = -1;
    const jobs::JobOutcome outcome = bench.dispatcher.run(job, {}, [&](const jobs::JobReport& report) {
        if (report.driver.state == drivers::DriverState::running && report.driver.block == 3 &&
            at_second_turn < 0) {
            at_second_turn = report.driver.executed_blocks;
        }
    });
    EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
    EXPECT_EQ(outcome.executed_blocks, 7);
    EXPECT_EQ(at_second_turn, 2); // G1 X5 is done once, and comes again
}

TEST(CordicDriver, HoldsAndStopsLikeAnyMachine) {
    CordicDriverBench bench;
    bench.driver.connect();
    const jobs::Job job = jobs::text_job(straight_and_arc_part, "part.ngc");
    bench.driver.start({nullptr, nullptr, job.listing, {}});
    bench.driver.stop();
    test::wait_until([&] { return bench.driver.status().activity == drivers::Activity::none; });
    EXPECT_LE(bench.driver.status().executed_blocks, job.block_count());
    bench.driver.emergency_stop();
    EXPECT_EQ(bench.driver.status().state, drivers::DriverState::alarm);
    EXPECT_THROW(bench.driver.start({nullptr, nullptr, job.listing, {}}), Error);
}

TEST(CordicDriver, RefusesAProgramThatDoesNotEnd) {
    test::ManualClock clock;
    const auto model = std::make_shared<const kinematics::MachineModel>(test::machine("router-xyz"));
    CordicDriverOptions options;
    options.most_clocks = 1000;
    CordicDriver driver(AxisPositions::Zero(3), {}, clock, model, options);
    driver.connect();
    const jobs::Job job = jobs::text_job(straight_and_arc_part, "part.ngc");
    EXPECT_THROW(driver.start({nullptr, nullptr, job.listing, {}}), Error);
    EXPECT_EQ(driver.status().state, drivers::DriverState::idle);
}

} // namespace
} // namespace millwright::cordic_machine
