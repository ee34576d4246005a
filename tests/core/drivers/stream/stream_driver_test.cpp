#include "core/drivers/stream/stream_driver.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/job.h"
#include "core/links/file_link.h"
#include "core/links/tcp.h"
#include "tests/core/jobs/router.h"
#include "tests/core/links/reading.h"
#include "tests/support/jobs.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace millwright::drivers {
namespace {

using kinematics::AxisPositions;
using test::router;
using testing::HasSubstr;

struct Received {
    std::string heading;
    std::vector<AxisPositions> samples;
};

Received received(const std::string& text, int axes) {
    Received result;
    std::istringstream lines(text);
    std::getline(lines, result.heading);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        AxisPositions position = AxisPositions::Zero(axes);
        for (int n = 0; n < axes; ++n) {
            words >> position[n];
        }
        EXPECT_FALSE(words.fail()) << line;
        result.samples.push_back(position);
    }
    return result;
}

struct StreamDriverBench {
    test::ScratchFolder scratch;
    SteadyClock clock;
    std::shared_ptr<const kinematics::MachineModel> model = router();
    std::filesystem::path file = scratch / "stream.txt";

    std::unique_ptr<StreamDriver> driver(StreamOptions options) {
        return std::make_unique<StreamDriver>(
            std::make_unique<links::FileLink>(file), clock, model, AxisPositions::Zero(3), options);
    }
};

constexpr const char* open_square = "G21 G90 G94\nG1 X20 Y5 F3000\nX20 Y25\nX0 Y0\n";

void wait_for_end(const Driver& driver) {
    test::wait_until([&] { return driver.status().activity == Activity::none; });
}

/// No axis faster, and none with more acceleration, than the machine has; from one sample to the next.
void expect_within_limits(const Received& got, const kinematics::MachineModel& model, double period) {
    const double rounding = 1e-6;
    for (std::size_t k = 2; k < got.samples.size(); ++k) {
        for (int n = 0; n < model.axis_count(); ++n) {
            const double before = (got.samples[k - 1][n] - got.samples[k - 2][n]) / period;
            const double now = (got.samples[k][n] - got.samples[k - 1][n]) / period;
            EXPECT_LE(std::abs(now), model.axis(n).max_velocity + rounding / period);
            // a corner may take a step of 2 ms of acceleration
            const double step = model.axis(n).max_acceleration * (period + 0.002);
            EXPECT_LE(std::abs(now - before), step + 4.0 * rounding / period) << "sample " << k;
        }
    }
}

TEST(StreamDriver, SendsTheTrajectorySampleBySample) {
    StreamDriverBench bench;
    constexpr double period = 0.004;
    const auto driver = bench.driver({.period = period, .decimals = 7, .paced = false});
    driver->connect();
    program::Program program;
    program.machine = bench.model->name();
    for (const kinematics::MachineAxis& axis : bench.model->axes()) {
        program.axes.push_back({axis.letter, axis.kind});
    }
    program.start = AxisPositions::Zero(3);
    program::Block move;
    move.kind = program::BlockKind::feed;
    move.target = AxisPositions::Constant(3, 10.0);
    move.named = program::AxisSet::all(3);
    move.duration = 0.5;
    program.blocks = {move, move};
    program.blocks[1].kind = program::BlockKind::end;
    const auto trajectory =
        std::make_shared<const motion::Trajectory>(motion::plan(program, *bench.model, {}, {}));
    driver->start({std::make_shared<const program::Program>(program), trajectory, nullptr, {}});
    wait_for_end(*driver);
    driver->close();
    const Received got = received(read_file(bench.file), 3);
    EXPECT_EQ(got.heading, "# millwright-stream 1 period_s 0.004 X mm Y mm Z mm");
    ASSERT_GT(got.samples.size(), 100U);
    for (std::size_t k = 0; k < got.samples.size(); ++k) {
        const double time = static_cast<double>(k) * period;
        EXPECT_LT((got.samples[k] - trajectory->at(time).position).cwiseAbs().maxCoeff(), 1e-6) << k;
    }
    EXPECT_LT((got.samples.back() - move.target).norm(), 1e-6);
}

TEST(StreamDriver, SendsNothingWhileAProgramStopWaits) {
    StreamDriverBench bench;
    const jobs::Job job =
        jobs::planned_job("G21 G90\nG1 X10 F6000\nM0\nX20\nT4 M6\nX30\nM30\n", "part.ngc", bench.model);
    const auto driver = bench.driver({.period = 0.002, .decimals = 7, .paced = false});
    driver->connect();
    driver->start(test::work_of(job));
    const auto waits = [&](const std::string& why) {
        test::wait_until([&] { return driver->status().message == why; });
        const DriverStatus status = driver->status();
        EXPECT_EQ(status.message, why);
        EXPECT_EQ(status.state, DriverState::holding);
        return status;
    };
    const DriverStatus at_stop = waits("program stop at line 3: M0");
    EXPECT_EQ(at_stop.position, job.program->blocks[0].target);
    const std::int64_t sent = driver->samples();
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    EXPECT_LE(driver->samples(), sent + 1); // that of the place, if it was on its way
    driver->resume();
    (void)waits("change to tool 4 at line 5: M6");
    driver->resume();
    wait_for_end(*driver);
    EXPECT_EQ(driver->status().executed_blocks, job.program->block_count());
    driver->close();
    const Received got = received(read_file(bench.file), 3);
    expect_within_limits(got, *bench.model, 0.002);
    EXPECT_NEAR(got.samples.back()[0], 30.0, 1e-6);
}

TEST(StreamDriver, SendsNothingBeforeAPersonWantsAMotion) {
    StreamDriverBench bench;
    const auto driver = bench.driver({.period = 0.002, .decimals = 7, .paced = false});
    driver->connect();
    std::this_thread::sleep_for(std::chrono::milliseconds(50)); // many periods
    driver->close();
    EXPECT_EQ(driver->samples(), 0);
    EXPECT_EQ(read_file(bench.file), "# millwright-stream 1 period_s 0.002 X mm Y mm Z mm\n");
    driver->connect();
    Jog jog;
    jog.way = AxisPositions::Unit(3, 0) * 2.0;
    jog.speed = 10.0;
    driver->jog(jog);
    wait_for_end(*driver);
    driver->close();
    const Received got = received(read_file(bench.file), 3);
    EXPECT_EQ(got.samples.front(), AxisPositions::Zero(3).eval());
    EXPECT_EQ(std::ssize(got.samples), driver->samples());
    expect_within_limits(got, *bench.model, 0.002);
    EXPECT_NEAR(got.samples.back()[0], 2.0, 1e-3);
}

TEST(StreamDriver, HoldsAndResumesWithoutAJump) {
    StreamDriverBench bench;
    constexpr double period = 0.002;
    const auto driver = bench.driver({.period = period, .decimals = 7});
    driver->connect();
    (void)driver->command(open_square);
    for (const double x : {3.0, 12.0}) {
        test::wait_until([&] { return driver->status().position[0] > x; });
        driver->hold();
        test::wait_until([&] { return driver->status().velocity.norm() < 1e-9; });
        const std::int64_t sent = driver->samples();
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        EXPECT_LE(driver->samples(), sent + 1); // a machine that stands needs no samples
        driver->resume();
    }
    wait_for_end(*driver);
    driver->close();
    const Received got = received(read_file(bench.file), 3);
    expect_within_limits(got, *bench.model, period);
    EXPECT_LT(got.samples.back().norm(), 1e-6);
}

TEST(StreamDriver, KeepsItsPeriod) {
    StreamDriverBench bench;
    const auto driver = bench.driver({.period = 0.01});
    driver->connect();
    const double begin = bench.clock.now();
    (void)driver->command("G21 G91 G1 X20 F1200");
    wait_for_end(*driver);
    const double took = bench.clock.now() - begin;
    EXPECT_GT(took, 0.9); // 20 mm at 20 mm/s
    EXPECT_NEAR(static_cast<double>(driver->samples()), took / 0.01, 0.5 * took / 0.01);
    driver->close();
}

TEST(StreamDriver, BeginsWhereAPersonSaysThatTheMachineStands) {
    StreamDriverBench bench;
    const auto driver = bench.driver({.paced = false, .known = false});
    driver->connect();
    EXPECT_FALSE(driver->capabilities().reports.position);
    EXPECT_FALSE(driver->status().position_known);
    const AxisPositions there = Vec3(3.0, 4.0, 5.0);
    driver->stands_at(there);
    EXPECT_TRUE(driver->status().position_known);
    EXPECT_EQ(driver->status().position, there);
    EXPECT_EQ(driver->samples(), 0); // nothing moves to there
    (void)driver->command("G21 G90 G1 X13 F3000");
    wait_for_end(*driver);
    driver->close();
    const Received got = received(read_file(bench.file), 3);
    ASSERT_GT(got.samples.size(), 2U);
    EXPECT_EQ(got.samples.front(), there);
    EXPECT_NEAR((got.samples.back() - AxisPositions(Vec3(13.0, 4.0, 5.0))).norm(), 0.0, 1e-4);
}

TEST(StreamDriver, IsNotToldWhereItStandsWhileItMoves) {
    StreamDriverBench bench;
    const auto driver = bench.driver({});
    driver->connect();
    (void)driver->command("G21 G90 G1 X20 F600");
    EXPECT_THROW(driver->stands_at(AxisPositions{Vec3(3.0, 4.0, 5.0)}), Error);
    driver->close();
}

TEST(StreamDriver, EndsInAnAlarmWhenItsLinkBreaksAndGoesOnOnlyWhenAsked) {
    SteadyClock clock;
    auto server = std::make_unique<links::TcpServer>(0);
    server->open();
    const std::uint16_t port = server->port();
    StreamDriver driver(
        std::make_unique<links::TcpLink>("127.0.0.1", port), clock, router(), AxisPositions::Zero(3));
    driver.connect();
    (void)driver.command(open_square);
    std::string text;
    test::wait_until([&] {
        text += server->read();
        return std::ranges::count(text, '\n') > 10;
    });
    EXPECT_THAT(text, HasSubstr("# millwright-stream 1"));
    server.reset();
    test::wait_until([&] { return driver.status().state == DriverState::alarm; });
    EXPECT_THAT(driver.status().message, HasSubstr("the link was lost"));
    EXPECT_THROW((void)driver.command("G0 X0"), Error);
    EXPECT_THROW(driver.reset(), Error); // no machine is connected
    links::TcpServer again(port);
    again.open();
    driver.reset();
    EXPECT_EQ(driver.status().state, DriverState::idle);
    const std::int64_t sent = driver.samples();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_LE(driver.samples(), sent + 1);
    driver.close();
}

TEST(StreamDriver, RefusesPeriodsAndDecimalsThatAreNone) {
    const test::WithoutTraps no_traps;
    StreamDriverBench bench;
    EXPECT_THROW(bench.driver({.period = 0.0}), Error);
    EXPECT_THROW(bench.driver({.period = std::nan("")}), Error);
    EXPECT_THROW(bench.driver({.decimals = 10}), Error);
}

} // namespace
} // namespace millwright::drivers
