#include "core/jobs/internal/path_estimate.h"

#include "core/jobs/dispatcher.h"
#include "core/jobs/job.h"
#include "tests/core/drivers/grbl/wire_driver.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::jobs {
namespace {

using internal::PathEstimate;

PathEstimate estimate_of(const std::string& text) {
    SurveySettings settings;
    settings.dialect = gcode::Dialect::grbl;
    settings.keep_path = true;
    return {survey(text, "a.ngc", settings).path, Vec3::Zero()};
}

TEST(PathEstimate, FindsTheLineOfAPosition) {
    PathEstimate estimate = estimate_of("G21 G90\nG0 Z5\nG0 X10\nG1 Y10 F600\nG2 X20 Y0 I0 J-10\nG1 X0\n");
    EXPECT_EQ(estimate.line_at(Vec3(0.0, 0.0, 2.0), 2, 6), 2);
    EXPECT_EQ(estimate.line_at(Vec3(10.0, 4.0, 5.0), 2, 6), 4);
    EXPECT_EQ(estimate.line_at(Vec3(10.0 + 10.0 * 0.8, 10.0 * 0.6, 5.0), 2, 6), 5); // on the arc
    EXPECT_EQ(estimate.line_at(Vec3(5.0, 0.0, 5.0), 2, 6), 6);
}

TEST(PathEstimate, NeverGoesBackAndNeverBeyondWhatWasSent) {
    PathEstimate estimate = estimate_of("G21 G90 F600\nG1 X10\nG1 X0\nG1 X10\nG1 Y5\n");
    EXPECT_EQ(estimate.line_at(Vec3(5.0, 0.0, 0.0), 2, 5), 2);
    EXPECT_EQ(estimate.line_at(Vec3(10.0, 3.0, 0.0), 2, 4), 2); // line 5 was not sent
    EXPECT_EQ(estimate.line_at(Vec3(5.0, 0.0, 0.0), 3, 5), 3);  // line 2 is executed for certain
    EXPECT_EQ(estimate.line_at(Vec3(10.0, 3.0, 0.0), 3, 5), 5);
    EXPECT_EQ(estimate.line_at(Vec3(5.0, 0.0, 0.0), 3, 5), 5);
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
