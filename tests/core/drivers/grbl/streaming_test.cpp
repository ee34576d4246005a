// Short blocks as fast as a small machine takes them: the planner of the controller has to be kept full, or
// it brakes at the end of what it knows.
#include "tests/core/drivers/grbl/grbl_wire.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::drivers::grbl {
namespace {

using test::GrblWire;

constexpr int streamed_blocks = 3000;
constexpr double blocks_per_second = 1000.0;
constexpr int full = 15; // blocks that the planner holds

/// 0.1 mm each at 100 mm/s, which the planner's 15 blocks let a machine with this acceleration go.
std::string short_blocks() {
    std::string text = "G21G90G94\nG1F6000\n";
    for (int n = 1; n <= streamed_blocks; ++n) {
        text += fmt::format("X{:.1f}\n", 0.1 * n);
    }
    return text + "M30\n";
}

struct Measured {
    int least_planned = streamed_blocks;
    double rate = 0.0; ///< blocks per second, between the first and the last quarter
};

Measured stream(double delay) {
    links::FaultSpec faults;
    faults.delay = delay;
    GrblWire wire(faults, {}, {}, "$110=12000\n$120=9000\n");
    wire.start(short_blocks());
    Measured measured;
    while (wire.state() == DriverState::running) {
        wire.step(0.001);
        const int sent = wire.session.status().sent_blocks;
        const bool under_way =
            wire.grbl.planned_blocks() > 0 && sent > streamed_blocks / 10 && sent < streamed_blocks;
        if (under_way) {
            measured.least_planned = std::min(measured.least_planned, wire.grbl.planned_blocks());
        }
    }
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    const emulators::Truth truth = wire.grbl.truth();
    const auto executed = [&](int line) { return truth.lines[static_cast<std::size_t>(line)].executed; };
    constexpr int quarter = streamed_blocks / 4;
    measured.rate = 2 * quarter / (executed(3 * quarter) - executed(quarter));
    fmt::print("at least {} blocks planned, {:.1f} a second\n", measured.least_planned, measured.rate);
    return measured;
}

TEST(GrblStreaming, KeepsThePlannerFullAtAThousandBlocksASecond) {
    const Measured measured = stream(0.0);
    EXPECT_GE(measured.least_planned, 13);
    EXPECT_LE(measured.least_planned, full);
    EXPECT_NEAR(measured.rate, blocks_per_second, 0.01 * blocks_per_second);
}

TEST(GrblStreaming, BearsALinkThatTakesItsTime) {
    const Measured measured = stream(0.005); // s at most, each way
    EXPECT_GE(measured.least_planned, 8);
    EXPECT_LE(measured.least_planned, full);
    EXPECT_NEAR(measured.rate, blocks_per_second, 0.01 * blocks_per_second);
}

TEST(GrblStreaming, TellsALinkThatIsTooSlow) {
    const Measured measured = stream(0.2);
    EXPECT_LT(measured.least_planned, full);
    EXPECT_LT(measured.rate, 0.9 * blocks_per_second);
}

} // namespace
} // namespace millwright::drivers::grbl
