#include "core/cordic/vcd.h"

#include "core/cordic/assembler.h"
#include "tests/core/cordic/waves.h"

#include <gtest/gtest.h>

#include <vector>

namespace millwright::cordic {
namespace {

TEST(Vcd, SaysTheSameAsTheStatesItWasMadeFrom) {
    const auto [image, lines, errors, warnings] =
        assemble("mov Vmax, 0.5\nmov Amax, 0.5\nmov XI, 6\nmov YJ, 8\ng01\nhlt", "a.asm");
    ASSERT_TRUE(errors.empty());
    Processor processor({.publishing = Publishing::bus, .wait_states = 1}, image);
    VcdWriter writer(image.format, 8e6);
    std::vector<ProcessorState> states;
    while (processor.state().stop == Stop::none) {
        processor.clock();
        states.push_back(processor.state());
        writer.add(processor.state());
    }
    const test::Waves waves = test::read_waves(writer.take());
    constexpr std::int64_t period = 125'000; // ps at 8 MHz
    for (std::size_t n = 0; n < states.size(); ++n) {
        const auto time = static_cast<std::int64_t>(n) * period;
        EXPECT_EQ(waves.at("clk", time), 1U);
        EXPECT_EQ(waves.at("clk", time + period / 2), 0U);
        EXPECT_EQ(waves.at("ALE", time), states[n].bus.pins.ale ? 1U : 0U);
        EXPECT_EQ(waves.at("PSEN_n", time), states[n].bus.pins.psen ? 0U : 1U);
        EXPECT_EQ(waves.at("WR_n", time), states[n].bus.pins.wr ? 0U : 1U);
        EXPECT_EQ(waves.at("RD_n", time), 1U);
        EXPECT_EQ(waves.at("A", time), states[n].bus.pins.address);
        EXPECT_EQ(waves.at("AD", time), states[n].bus.pins.data);
        EXPECT_EQ(waves.at("x", time), states[n].path.x);
        EXPECT_EQ(waves.at("Vx", time), states[n].registers[static_cast<std::size_t>(Register::Vx)]);
        EXPECT_EQ(waves.at("PC", time), states[n].registers[static_cast<std::size_t>(Register::PC)]);
    }
    EXPECT_EQ(waves.at("running", static_cast<std::int64_t>(states.size()) * period), 0U);
}

/// What chooses and starts the patterns of the waveform ROM (thesis, section 2.6).
TEST(Vcd, ShowsCeOverEachBusCycleAndRwAtZeroOverWritesAlone) {
    const auto [image, lines, errors, warnings] =
        assemble("mov XI, 6\nst XI, 0x8000\nld YJ, 0x8000\nhlt", "a.asm");
    ASSERT_TRUE(errors.empty());
    constexpr int wait_states = 2;
    Processor processor({.wait_states = wait_states}, image);
    VcdWriter writer(image.format, 8e6);
    std::int64_t clocks = 0;
    while (processor.state().stop == Stop::none) {
        processor.clock();
        writer.add(processor.state());
        ++clocks;
    }
    const test::Waves waves = test::read_waves(writer.take());
    constexpr std::int64_t period = 125'000; // ps at 8 MHz
    int reads = 0, writes = 0, left = 0;
    bool writing = false;
    for (std::int64_t n = 0; n < clocks; ++n) {
        const auto now = [&](const char* signal) { return waves.at(signal, n * period) == 1U; };
        if (now("ALE")) { // the address, then the strobe with its wait states
            EXPECT_EQ(left, 0) << "a cycle ended before the next began";
            left = 2 + wait_states;
            writing = waves.at("WR_n", (n + 1) * period) == 0U;
            ++(writing ? writes : reads);
        }
        EXPECT_EQ(now("CE"), left > 0) << "clock " << n;
        EXPECT_EQ(now("RW"), left == 0 || !writing) << "clock " << n;
        left -= left > 0 ? 1 : 0;
    }
    EXPECT_EQ(writes, 4) << "a word of four bytes";
    EXPECT_GT(reads, 8) << "the program, and as many bytes back";
}

} // namespace
} // namespace millwright::cordic
