#include "core/jobs/dispatcher.h"
#include "core/jobs/internal/position_estimate.h"
#include "core/jobs/job.h"
#include "tests/core/drivers/grbl/wire_driver.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace millwright::jobs {
namespace {

using internal::PathEstimate;

PathEstimate estimate_of(const std::string& text) {
    ProgramCheckSettings settings;
    settings.dialect = gcode::Dialect::grbl;
    settings.keep_path = true;
    return {check_program(text, "a.ngc", settings).path, Vec3::Zero()};
}

int line_at(PathEstimate& estimate, const Vec3& at, int first, int last) {
    return estimate.place_at(at, first, last).line;
}

TEST(PathEstimate, FindsTheLineOfAPosition) {
    PathEstimate estimate = estimate_of("G21 G90\nG0 Z5\nG0 X10\nG1 Y10 F600\nG2 X20 Y0 I0 J-10\nG1 X0\n");
    EXPECT_EQ(line_at(estimate, Vec3(0.0, 0.0, 2.0), 2, 6), 2);
    EXPECT_EQ(line_at(estimate, Vec3(10.0, 4.0, 5.0), 2, 6), 4);
    EXPECT_EQ(line_at(estimate, Vec3(10.0 + 10.0 * 0.8, 10.0 * 0.6, 5.0), 2, 6), 5); // on the arc
    EXPECT_EQ(line_at(estimate, Vec3(5.0, 0.0, 5.0), 2, 6), 6);
}

TEST(PathEstimate, NeverGoesBackAndNeverBeyondWhatWasSent) {
    PathEstimate estimate = estimate_of("G21 G90 F600\nG1 X10\nG1 X0\nG1 X10\nG1 Y5\n");
    EXPECT_EQ(line_at(estimate, Vec3(5.0, 0.0, 0.0), 2, 5), 2);
    EXPECT_EQ(line_at(estimate, Vec3(10.0, 3.0, 0.0), 2, 4), 2); // line 5 was not sent
    EXPECT_EQ(line_at(estimate, Vec3(5.0, 0.0, 0.0), 3, 5), 3);  // line 2 is executed for certain
    EXPECT_EQ(line_at(estimate, Vec3(10.0, 3.0, 0.0), 3, 5), 5);
    EXPECT_EQ(line_at(estimate, Vec3(5.0, 0.0, 0.0), 3, 5), 5);
}

TEST(PathEstimate, MovesInsideALine) {
    PathEstimate estimate = estimate_of("G21 G90 F600\nG1 X100\nG2 X120 Y20 I0 J20\nG1 Y30\n");
    EXPECT_DOUBLE_EQ(estimate.place_at(Vec3(25.0, 0.0, 0.0), 2, 4).fraction, 0.25);
    EXPECT_DOUBLE_EQ(estimate.place_at(Vec3(24.9, 0.0, 0.0), 2, 4).fraction, 0.25); // a rounded report
    EXPECT_DOUBLE_EQ(estimate.place_at(Vec3(75.0, 0.0, 0.0), 2, 4).fraction, 0.75);
    EXPECT_DOUBLE_EQ(estimate.place_at(Vec3(500.0, 0.0, 0.0), 2, 4).fraction, 0.75); // nowhere on it
    const double third = std::numbers::pi / 2.0; // of three quarters of a turn around 100, 20, clockwise
    const internal::PathPlace on_arc =
        estimate.place_at(Vec3(100.0 - 20.0 * std::sin(third), 20.0 - 20.0 * std::cos(third), 0.0), 2, 4);
    EXPECT_EQ(on_arc.line, 3);
    EXPECT_NEAR(on_arc.fraction, 1.0 / 3.0, 0.002);
    const internal::PathPlace proven = estimate.place_at(Vec3(500.0, 0.0, 0.0), 4, 4);
    EXPECT_EQ(proven.line, 4);
    EXPECT_DOUBLE_EQ(proven.fraction, 0.0);
}

/// It stood still for the whole of a line, however long.
TEST(PathEstimate, ShowsHowFarAJobIsOnALongLine) {
    const test::ScratchFolder scratch;
    test::GrblWire wire;
    test::WireClock clock(wire, wire.now + 1e5);
    test::WireDriver driver(wire, true);
    Dispatcher dispatcher(driver, clock, scratch.path());
    double last = 0.0;
    double longest_jump = 0.0;
    double before_half = 0.0, behind_half = 1.0;
    const auto listener = [&](const JobReport& report) {
        const double x = wire.grbl.position()[0];
        if (x > 1.0 && x < 99.0) {
            longest_jump = std::max(longest_jump, report.fraction() - last);
            EXPECT_GE(report.fraction(), last);
            EXPECT_LE(report.driver.executed_blocks, 1); // the line itself is not proven
            (x < 50.0 ? before_half : behind_half) = report.fraction();
        }
        last = report.fraction();
    };
    const Job job = text_job("G21 G90 F1200\nG1 X100\nG1 Y1\nM2\n", "long.ngc");
    EXPECT_EQ(dispatcher.run(job, {}, listener).end, JobEnd::done);
    EXPECT_NEAR(before_half, 1.5 / 4.0, 0.02); // two of four blocks begun
    EXPECT_NEAR(behind_half, 2.0 / 4.0, 0.02);
    EXPECT_LT(longest_jump, 0.05);
}

/// Of a Grbl that reports nothing of its planner, which proves 21 lines late what it has executed.
TEST(PathEstimate, ShowsWhereAJobIsBeforeThatIsProven) {
    const test::ScratchFolder scratch;
    test::GrblWire wire;
    test::WireClock clock(wire, wire.now + 1e5);
    test::WireDriver driver(wire, true);
    Dispatcher dispatcher(driver, clock, scratch.path());
    std::string text = "G21 G90 F1200\n";
    for (int n = 1; n <= 18; ++n) {
        text += "G1 X" + std::to_string(n % 2 == 0 ? 0 : 10) + " Y" + std::to_string(n) + "\n";
    }
    bool shown = false;
    const auto listener = [&](const JobReport& report) {
        const int at = static_cast<int>(wire.grbl.position()[1]); // Y tells the line
        if (at >= 8 && at <= 12) {
            shown = shown || report.line > 0;
            EXPECT_NEAR(report.line, at + 2, 2);
            EXPECT_LT(report.driver.executed_blocks, 5);
            EXPECT_NEAR(report.fraction(), at / 19.0, 0.15);
        }
    };
    EXPECT_EQ(dispatcher.run(text_job(text, "zigzag.ngc"), {}, listener).end, JobEnd::done);
    EXPECT_TRUE(shown);
}

} // namespace
} // namespace millwright::jobs
