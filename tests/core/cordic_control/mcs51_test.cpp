#include "core/cordic_control/mcs51.h"

#include "core/base/error.h"
#include "core/cordic_control/mcs51_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace millwright::cordic {
namespace {

using testing::HasSubstr;

constexpr std::uint8_t acc = 0xe0;
constexpr std::uint8_t psw = 0xd0;

/// The processor behind `steps` instructions of `code`.
Mcs51 executed(const std::vector<std::uint8_t>& code, int steps) {
    Mcs51 processor(code);
    for (int n = 0; n < steps; ++n) {
        processor.step();
    }
    return processor;
}

bool flag(const Mcs51& processor, int bit) {
    return (processor.sfr(psw) >> bit & 1) != 0;
}

// Every A, every operand, with and without carry: by what the flags mean.
TEST(Mcs51, AddsAndSubtractsWithItsFlags) {
    for (int a = 0; a < 256; a += 3) {
        for (int b = 0; b < 256; ++b) {
            for (const int c : {0, 1}) {
                const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
                const std::uint8_t carry = c == 1 ? 0xd3 : 0xc3; // SETB C, CLR C
                const Mcs51 sum = executed({carry, 0x74, byte(a), 0x34, byte(b)}, 3);
                EXPECT_EQ(sum.sfr(acc), byte(a + b + c));
                EXPECT_EQ(flag(sum, 7), a + b + c > 255);
                EXPECT_EQ(flag(sum, 6), (a & 15) + (b & 15) + c > 15);
                const int signed_sum = static_cast<std::int8_t>(a) + static_cast<std::int8_t>(b) + c;
                EXPECT_EQ(flag(sum, 2), signed_sum > 127 || signed_sum < -128);
                const Mcs51 rest = executed({carry, 0x74, byte(a), 0x94, byte(b)}, 3);
                EXPECT_EQ(rest.sfr(acc), byte(a - b - c));
                EXPECT_EQ(flag(rest, 7), a < b + c);
                EXPECT_EQ(flag(rest, 6), (a & 15) < (b & 15) + c);
                const int signed_rest = static_cast<std::int8_t>(a) - static_cast<std::int8_t>(b) - c;
                EXPECT_EQ(flag(rest, 2), signed_rest > 127 || signed_rest < -128);
            }
        }
    }
}

TEST(Mcs51, MultipliesDividesAndAdjusts) {
    const Mcs51 product = executed({0x74, 200, 0x75, 0xf0, 123, 0xa4}, 3); // MOV A; MOV B; MUL
    EXPECT_EQ(product.sfr(acc) + 256 * product.sfr(0xf0), 200 * 123);
    EXPECT_TRUE(flag(product, 2));
    EXPECT_EQ(product.clocks(), 12 * (1 + 2 + 4));
    const Mcs51 quotient = executed({0x74, 251, 0x75, 0xf0, 18, 0x84}, 3);
    EXPECT_EQ(quotient.sfr(acc), 13);
    EXPECT_EQ(quotient.sfr(0xf0), 17);
    EXPECT_TRUE(flag(executed({0x74, 251, 0x75, 0xf0, 0, 0x84}, 3), 2)) << "by 0";
    for (int a = 0; a < 100; ++a) { // sums of two decimal digits each
        for (int b = 0; b < 100; b += 7) {
            const auto packed = [](int n) { return static_cast<std::uint8_t>(n / 10 % 10 * 16 + n % 10); };
            const Mcs51 sum = executed({0x74, packed(a), 0x24, packed(b), 0xd4}, 3);
            ASSERT_EQ(sum.sfr(acc), packed(a + b)) << a << " + " << b;
            ASSERT_EQ(flag(sum, 7), a + b > 99) << a << " + " << b;
        }
    }
}

TEST(Mcs51, CallsReturnsAndLoops) {
    // LCALL 6; SJMP here; NOP; 6: MOV R7,#3; DJNZ R7,-2; RET
    const std::vector<std::uint8_t> code{0x12, 0, 6, 0x80, 0xfe, 0, 0x7f, 3, 0xdf, 0xfe, 0x22};
    const Mcs51 back = executed(code, 6);
    EXPECT_EQ(back.pc(), 3);
    EXPECT_EQ(back.internal(7), 0);
    EXPECT_EQ(back.sfr(0x81), 7) << "the stack pointer as after reset";
    EXPECT_EQ(back.clocks(), 12 * (2 + 1 + 3 * 2 + 2));
    EXPECT_EQ(executed(code, 20).pc(), 3);
}

TEST(Mcs51, TellsWhatIsNotBuiltIn) {
    const auto stop = [](const std::vector<std::uint8_t>& code) { return executed(code, 3).stop(); };
    EXPECT_EQ(stop({0xa5}), Mcs51Stop::reserved);
    EXPECT_EQ(stop({0xd2, 0xaf}), Mcs51Stop::interrupts);
    EXPECT_EQ(stop({0xd2, 0x8c}), Mcs51Stop::timer);
    EXPECT_EQ(stop({0xf5, 0x99}), Mcs51Stop::serial);
    EXPECT_EQ(stop({0x75, 0x87, 1}), Mcs51Stop::idle);
    EXPECT_EQ(stop({0xc2, 0xaf, 0x75, 0x89, 1}), Mcs51Stop::none) << "EA off, TMOD";
}

TEST(IntelHex, IsReadWithItsPlacesOfErrors) {
    EXPECT_EQ(read_intel_hex(":0300000002000BF0\r\n:010005007585\n:00000001FF\n", "a.ihx"),
              (std::vector<std::uint8_t>{2, 0, 0x0b, 0, 0, 0x75}));
    const auto fault = [](const char* text) {
        try {
            (void)read_intel_hex(text, "a.ihx");
        } catch (const Error& error) {
            return to_text(error.diagnostic());
        }
        return std::string();
    };
    EXPECT_THAT(fault(":0300000002000BF1\n:00000001FF\n"), HasSubstr("a.ihx:1:1: the checksum"));
    EXPECT_THAT(fault(":0300000002000BF0\nQ\n"), HasSubstr("a.ihx:2:1: a record of Intel HEX must start"));
    EXPECT_THAT(fault(":0300000002000B\n"), HasSubstr("does not match its length byte"));
    EXPECT_THAT(fault(":03000000020G0BF0\n"), HasSubstr("two hexadecimal digits"));
    EXPECT_THAT(fault(":020000040001F9\n"), HasSubstr("record type 04"));
    EXPECT_THAT(fault(":0300000002000BF0\n"), HasSubstr("ends without its end record"));
    EXPECT_THAT(fault(""), HasSubstr("ends without"));
}

TEST(Mcs51Line, MeasuresThePinAndRefusesProgramsThatDoNotMoveIt) {
    // CLR P1.0; SETB P1.0; NOP; NOP; CLR P1.0; SJMP here
    const Mcs51LineRun run =
        run_mcs51_line({0xc2, 0x90, 0xd2, 0x90, 0, 0, 0xc2, 0x90, 0x80, 0xfe}, {}, "a.ihx");
    EXPECT_EQ(run.clocks, 12 * 3);
    const auto fault = [](const std::vector<std::uint8_t>& code) {
        try {
            (void)run_mcs51_line(code, {}, "a.ihx");
        } catch (const Error& error) {
            return to_text(error.diagnostic());
        }
        return std::string();
    };
    EXPECT_THAT(fault({0xa5}), HasSubstr("a.ihx: the MCS-51 stopped at 0x0001: the byte 0xa5"));
    EXPECT_THAT(fault({0xc2, 0x90, 0x80, 0xfe}), HasSubstr("P1.0 did not go high"));
}

} // namespace
} // namespace millwright::cordic
