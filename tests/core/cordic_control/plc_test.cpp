#include "core/cordic_control/plc.h"

#include "core/cordic_control/plc_assembler.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace millwright::cordic {
namespace {

constexpr std::int64_t ms = 1000; // us

Plc logic(const std::string& text) {
    PlcProgram program = assemble_plc(text, "logic.plc");
    EXPECT_TRUE(program.errors.empty()) << program.errors[0].message;
    return Plc(std::move(program));
}

PlcBit bit(const char* name) {
    const auto found = plc_bit(name);
    EXPECT_TRUE(found.has_value()) << name;
    return found.value_or(0);
}

TEST(PlcBits, HaveNamesThatReadBack) {
    for (PlcBit n = 0; n < plc_bit_count; ++n) {
        EXPECT_EQ(plc_bit(plc_name(n)), n) << plc_name(n);
    }
    EXPECT_EQ(plc_bit("i31"), bit("I31"));
    for (const char* none : {"", "I", "I32", "Q-1", "U99", "U200", "X1", "I1 ", "HOLDS"}) {
        EXPECT_FALSE(plc_bit(none).has_value()) << none;
    }
}

// Every expression of three bits against the same written in C++.
TEST(PlcLogic, ComputesWhatItsInstructionsSay) {
    for (int n = 0; n < 8; ++n) {
        const bool a = (n & 1) != 0;
        const bool b = (n & 2) != 0;
        const bool c = (n & 4) != 0;
        Plc plc = logic("LD I0\nAND I1\nORN I2\nST Q0\n"
                        "LDN I0\nANDN I1\nXOR I2\nSTN Q1\n"
                        "LD I0\nAND( I1\nOR I2\n)\nST Q2\n"
                        "LD I0\nOR( I1\nAND( I2\nOR I0\n)\n)\nNOT\nST Q3\n");
        plc.set(bit("I0"), a);
        plc.set(bit("I1"), b);
        plc.set(bit("I2"), c);
        plc.scan(0);
        EXPECT_EQ(plc.get(bit("Q0")), (a && b) || !c) << n;
        EXPECT_EQ(plc.get(bit("Q1")), !((!a && !b) != c)) << n;
        EXPECT_EQ(plc.get(bit("Q2")), a && (b || c)) << n;
        EXPECT_EQ(plc.get(bit("Q3")), !(a || (b && (c || a)))) << n;
    }
}

TEST(PlcLogic, SetsAndResetsWhatStays) {
    Plc plc = logic("LD I0\nS Q0\nLD I1\nR Q0\n");
    plc.set(bit("I0"), true);
    plc.scan(0);
    plc.set(bit("I0"), false);
    plc.scan(ms);
    EXPECT_TRUE(plc.get(bit("Q0")));
    plc.set(bit("I1"), true);
    plc.scan(2 * ms);
    EXPECT_FALSE(plc.get(bit("Q0")));
}

/// Q0 in each millisecond, I0 being true from 10 to 30 and from 40 to 43.
std::string seen(const std::string& timer) {
    Plc plc = logic("LD I0\n" + timer + "\nST Q0\n");
    std::string trace;
    bool before = false;
    for (int n = 0; n < 80; ++n) {
        plc.set(bit("I0"), (n >= 10 && n < 30) || (n >= 40 && n < 43));
        plc.scan(n * ms);
        const bool now = plc.get(bit("Q0"));
        trace += now == before ? "" : std::to_string(n) + (now ? "+ " : "- ");
        before = now;
    }
    return trace;
}

TEST(PlcTimers, DelayAndPulseAsIec61131Says) {
    EXPECT_EQ(seen("TON T0, 5"), "15+ 30- "); // the second is too short
    EXPECT_EQ(seen("TOF T0, 5"), "10+ 35- 40+ 48- ");
    EXPECT_EQ(seen("TP T0, 5"), "10+ 15- 40+ 45- ");
    EXPECT_EQ(seen("TP T0, 25"), "10+ 35- 40+ 65- "); // longer than its input
    EXPECT_EQ(seen("TON T0, 0.5"), "11+ 30- 41+ 43- ");
}

TEST(PlcCounters, CountWhatRisesUntilTheyAreReset) {
    Plc plc = logic("LD I0\nCTU C0, 3\nST Q0\nLD I1\nR C0\n");
    const auto pulse = [&] {
        plc.set(bit("I0"), true);
        plc.scan(0);
        const bool done = plc.get(bit("Q0"));
        plc.scan(0);
        plc.set(bit("I0"), false);
        plc.scan(0);
        return done;
    };
    EXPECT_FALSE(pulse());
    EXPECT_FALSE(pulse());
    EXPECT_TRUE(pulse());
    plc.set(bit("I1"), true);
    plc.scan(0);
    plc.set(bit("I1"), false);
    plc.scan(0);
    EXPECT_FALSE(plc.get(bit("Q0")));
    EXPECT_FALSE(pulse());
}

} // namespace
} // namespace millwright::cordic
