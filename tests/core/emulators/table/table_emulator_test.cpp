// Records over a pseudo-terminal, with the driver at one end and the table at the other.
#include "core/emulators/table/table_emulator.h"

#include "core/base/error.h"
#include "core/drivers/stream/stream_driver.h"
#include "core/emulators/emulator.h"
#include "core/links/pseudo_terminal.h"
#include "core/links/serial_link.h"
#include "tests/core/jobs/answered_records.h"
#include "tests/core/links/reading.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::emulators {
namespace {

using kinematics::AxisPositions;
using test::answered_records;
using testing::HasSubstr;

constexpr int decimals = 4;

struct TableEmulatorBench {
    explicit TableEmulatorBench(const drivers::RecordFormat& format, TableOptions options = {})
        : format_(format) {
        options.keep = true;
        std::vector<std::unique_ptr<links::Link>> links;
        links.push_back(std::make_unique<links::PseudoTerminal>(port.string()));
        links.back()->open();
        server = std::make_unique<EmulatorServer>(
            std::move(links), clock, std::make_unique<TableEmulator>(format, *model, options));
        driver = std::make_unique<drivers::StreamDriver>(
            links::make_link(port.string() + ",921600"), // 32 bytes in 2 ms
            clock,
            model,
            AxisPositions::Zero(3),
            drivers::StreamOptions{.period = 0.002, .decimals = decimals, .record = format_});
        driver->connect();
    }

    void wait_for_end() const {
        test::wait_until([&] { return driver->status().activity == drivers::Activity::none; });
    }

    /// Asks the table.
    template <class Ask> auto table(const Ask& ask) const {
        return server->with_emulator(
            [&](Emulator& emulator) { return ask(static_cast<const TableEmulator&>(emulator)); });
    }
    [[nodiscard]] std::int64_t records() const {
        return table([](const TableEmulator& now) { return now.records(); });
    }
    [[nodiscard]] std::int64_t bad_lines() const {
        return table([](const TableEmulator& now) { return now.bad_lines(); });
    }
    [[nodiscard]] double position(char letter) const {
        const auto axis = static_cast<std::size_t>(model->axis_index(letter));
        return table([&](const TableEmulator& now) { return now.position()[axis]; });
    }

    /// What became of the last lines.
    void run(const std::string& lines) {
        (void)driver->command(lines);
        wait_for_end();
    }

    drivers::RecordFormat format_;
    test::ScratchFolder scratch;
    std::filesystem::path port = scratch / "table";
    SteadyClock clock;
    std::shared_ptr<const kinematics::MachineModel> model =
        std::make_shared<const kinematics::MachineModel>(test::machine("router-xyz"));
    std::unique_ptr<EmulatorServer> server;
    std::unique_ptr<drivers::StreamDriver> driver;
};

/// Each step is one that the axes can make in a period, and the last position is where the program ends.
void expect_whole_way(const TableEmulatorBench& bench, double x, double y) {
    const auto positions = bench.table([](const TableEmulator& now) { return now.positions(); });
    const auto axis = [&](char letter) { return static_cast<std::size_t>(bench.model->axis_index(letter)); };
    ASSERT_FALSE(positions.empty());
    EXPECT_NEAR(positions.back()[axis('X')], x, 1e-4);
    EXPECT_NEAR(positions.back()[axis('Y')], y, 1e-4);
    std::vector<double> before(3, 0.0);
    for (const auto& position : positions) {
        for (std::size_t n = 0; n < 3; ++n) {
            EXPECT_LE(std::abs(position[n] - before[n]), 150.0 * 0.002 + 2e-4); // mm/s times the period
        }
        before = position;
    }
    EXPECT_EQ(bench.records(), bench.driver->samples());
    EXPECT_EQ(bench.bad_lines(), 0);
}

TEST(TableEmulator, ReceivesEveryRecordInOrder) {
    for (const bool relative : {false, true}) {
        TableEmulatorBench bench(answered_records(relative));
        bench.run("G21 G90 G94\nG1 X6 Y2 F3000\nX6 Y5\n");
        expect_whole_way(bench, 6.0, 5.0);
        EXPECT_GT(bench.records(), 50);
    }
}

TEST(TableEmulator, NeedsNoAnswersWhereNoneAreAsked) {
    drivers::RecordFormat format;
    format.pattern = "G X{X} Y{Y} Z{Z}";
    TableEmulatorBench bench(format);
    bench.run("G21 G90 G94\nG1 X3 F3000\n");
    // The driver is done when its machine is: the last record may still be on its way.
    test::wait_until([&] {
        constexpr double record = 5e-5; // mm, half of a record's last place
        return bench.records() == bench.driver->samples() && bench.position('X') > 3.0 - record;
    });
    expect_whole_way(bench, 3.0, 0.0);
}

TEST(TableEmulator, IsHeldAndGoesOnWithNothingLostOrDoubled) {
    TableEmulatorBench bench(answered_records(true));
    (void)bench.driver->command("G21 G90 G94\nG1 X20 F3000\n");
    test::wait_until([&] { return bench.driver->status().position[bench.model->axis_index('X')] > 3.0; });
    bench.driver->hold();
    test::wait_until([&] { return bench.driver->status().velocity.norm() < 1e-9; });
    bench.driver->resume();
    bench.wait_for_end();
    expect_whole_way(bench, 20.0, 0.0);
}

// A fault in the middle, looked at and reset: the rest is given from where the table stands.
TEST(TableEmulator, ThatRefusesARecordIsAnAlarmAndNothingMoreIsSent) {
    TableEmulatorBench bench(answered_records(false), {.refuses = 40});
    bench.run("G21 G90 G94\nG1 X20 F3000\n");
    EXPECT_EQ(bench.driver->status().state, drivers::DriverState::alarm);
    EXPECT_THAT(bench.driver->status().message, HasSubstr("the machine answered 'error' to record 40"));
    EXPECT_EQ(bench.records(), 39);
    EXPECT_THROW((void)bench.driver->command("G1 X1 F100"), Error);
    EXPECT_EQ(bench.records(), 39);
    // What is claimed is what was answered.
    const int x = bench.model->axis_index('X');
    EXPECT_NEAR(bench.driver->status().position[x], bench.position('X'), 1e-4);
    bench.driver->reset();
    bench.run("G21 G90 G94\nG1 X20 F3000\n");
    EXPECT_NEAR(bench.position('X'), 20.0, 1e-4);
}

TEST(TableEmulator, ThatFallsSilentIsAnAlarm) {
    TableEmulatorBench bench(answered_records(false), {.silent_from = 25});
    bench.run("G21 G90 G94\nG1 X20 F3000\n");
    EXPECT_EQ(bench.driver->status().state, drivers::DriverState::alarm);
    EXPECT_THAT(bench.driver->status().message, HasSubstr("no answer to record 25 within 5 s"));
    EXPECT_EQ(bench.records(), 25);
}

TEST(TableEmulator, StandsWithinOneRecordOfAnEmergencyStop) {
    TableEmulatorBench bench(answered_records(false));
    (void)bench.driver->command("G21 G90 G94\nG1 X100 F3000\n");
    test::wait_until([&] { return bench.records() > 30; });
    bench.driver->emergency_stop();
    const std::int64_t then = bench.driver->samples();
    test::wait_until([&] { return bench.driver->status().state == drivers::DriverState::alarm; });
    bench.driver->close();
    EXPECT_LE(bench.records(), then + 1);
}

} // namespace
} // namespace millwright::emulators
