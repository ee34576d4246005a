#include "core/cordic/assembler.h"

#include "core/cordic/disassembler.h"
#include "core/cordic/processor.h"
#include "tests/core/cordic/wrong_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace millwright::cordic {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Assembler, TurnsTextIntoTheDocumentedBytes) {
    const auto [image, lines, errors, warnings] = assemble("        .format q8.24\n"
                                                           "start:  mov XI, -1.5     ; a comment\n"
                                                           "        Mov n, 50\n"
                                                           "        mov Dz, 0x00010203\n"
                                                           "        G02\n"
                                                           "        MOV PC, start\n"
                                                           "        hlt\n",
                                                           "a.asm");
    EXPECT_TRUE(errors.empty());
    EXPECT_EQ(image.format, fixed_format(8, 24));
    EXPECT_THAT(image.code,
                ElementsAre(0x10,
                            0x00,
                            0x00,
                            0x80,
                            0xfe, // -1.5
                            0x15,
                            50,
                            0,
                            0,
                            0, // 50
                            0x14,
                            0x03,
                            0x02,
                            0x01,
                            0x00, //
                            0x22, //
                            0x1c,
                            0x00,
                            0x00,
                            0x00,
                            0x00, // start
                            0x01));
}

TEST(Assembler, UsesEightBytesForWideFormats) {
    const auto [image, lines, errors, warnings] = assemble(".format f64\nmov Vmax, 1", "a.asm");
    EXPECT_TRUE(errors.empty());
    EXPECT_THAT(image.code, ElementsAre(0x12, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f));
}

TEST(Assembler, NamesLineAndColumnOfEveryMistake) {
    for (const WrongText& wrong : {
             WrongText{"g00\n  g05", 2, 3, "\"g05\" is not an instruction"},
             WrongText{"mov Q, 1", 1, 5, "\"Q\" is not a register"},
             WrongText{"mov", 1, 4, "a register is missing"},
             WrongText{"mov XI 1", 1, 8, "a comma is missing"},
             WrongText{"mov XI,", 1, 8, "a number is missing"},
             WrongText{"mov XI, one", 1, 9, "\"one\" is not a number"},
             WrongText{"mov XI, nan", 1, 9, "\"nan\" is not a number"},
             WrongText{"mov XI, 1e400", 1, 9, "is not a number"},
             WrongText{".format q8.8\nmov XI, 200", 2, 9, "200 does not fit into q8.8"},
             WrongText{"mov N, -1", 1, 8, "\"-1\" is not a whole number"},
             WrongText{"mov N, 1.5", 1, 8, "\"1.5\" is not a whole number"},
             WrongText{"mov PC, 65536", 1, 9, "not a whole number from 0 to 65535"},
             WrongText{"mov XI, 0x123456789", 1, 9, "not a hexadecimal number of 4 bytes"},
             WrongText{"mov PC, 0x1000A", 1, 9, "\"0x1000A\" is not a whole number from 0 to 65535"},
             WrongText{".format f64\nmov N, 0x100000001", 2, 8, "not a whole number from 0 to 4294967295"},
             WrongText{".format f64\nmov P, 0x100000001", 2, 8, "not a whole number from 0 to 4294967295"},
             WrongText{"mov XI, +-1", 1, 9, "\"+-1\" is not a number"},
             WrongText{"ld Vz, 0x8000", 1, 4, "Vz is a computed register and cannot be loaded"},
             WrongText{"ld XI, 70000", 1, 8, "\"70000\" is not an address from 0 to 65535"},
             WrongText{"mov XI, 0x7fc00000", 1, 9, "\"0x7fc00000\" is not a number in f32"},
             WrongText{".format q8.8\nmov XI, 0x8000", 2, 9, "\"0x8000\" is not a number in q8.8"},
             WrongText{"mov Vmax, -5", 1, 11, "Vmax must be above 0"},
             WrongText{"mov Amax, 0", 1, 11, "Amax must be above 0"},
             WrongText{"ld XI, 0xbffe", 1, 8, "4 bytes at \"0xbffe\" cross the border between two memories"},
             WrongText{"st XI, 0xbffd", 1, 8, "cross the border between two memories"},
             WrongText{"ld XI, 0xfffd", 1, 8, "4 bytes at \"0xfffd\" are not all on the bus"},
             WrongText{"st XI, 0x7fff", 1, 8, "are not all in the RAM or the motion controller's port"},
             WrongText{"a: st XI, a", 1, 11, "\"a\" is not an address"},
             WrongText{"ld XI, away", 1, 8, "label away is not defined"},
             WrongText{"mov PC, away", 1, 9, "label away is not defined"},
             WrongText{"a: nop\na: nop", 2, 1, "label a is already defined"},
             WrongText{"g01 g02", 1, 5, "unexpected \"g02\""},
             WrongText{"nop\n.format f64", 2, 9, ".format must come before"},
             WrongText{".format f63", 1, 9, "\"f63\" is not a number format"},
             WrongText{".byte 256", 1, 7, ".byte needs a number from 0 to 255"},
             WrongText{"a: PAGE\n.page\n mov PC, a", 3, 10, "label a is in another page"},
         }) {
        const auto errors = assemble(wrong.text, "wrong.asm").errors;
        ASSERT_EQ(errors.size(), 1U) << wrong.text;
        EXPECT_EQ(errors[0].place.line, wrong.line) << wrong.text;
        EXPECT_EQ(errors[0].place.column, wrong.column) << wrong.text;
        EXPECT_THAT(errors[0].message, HasSubstr(wrong.message)) << wrong.text;
    }
}

TEST(Assembler, PassesOverTheMarkInFrontOfUtf8) {
    const Assembled made = assemble("\xef\xbb\xbfhlt\n", "mark.asm");
    EXPECT_TRUE(made.errors.empty());
    EXPECT_EQ(made.image.code.size(), 1U);
    EXPECT_EQ(made.lines.front().column, 1);
}

TEST(Assembler, RefusesAnInstructionAcrossTheEndOfAPage) {
    std::string text;
    for (int n = 0; n < rom_size - 4; ++n) {
        text += "nop\n";
    }
    const auto errors = assemble(text + "  mov N, 1\n", "wrong.asm").errors;
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_EQ(errors[0].place.line, rom_size - 3);
    EXPECT_EQ(errors[0].place.column, 3);
    EXPECT_THAT(errors[0].message, HasSubstr("crosses the end of a program ROM page"));
    EXPECT_TRUE(assemble(text + "PAGE\n.page\nmov N, 1\n", "right.asm").errors.empty());
}

TEST(Assembler, TellsTheLineOfEachInstruction) {
    const Assembled made = assemble("nop\n\n  mov N, 1\nPAGE\n.page\nstart: hlt\n", "a.asm");
    EXPECT_EQ(line_at(made.lines, 0).line, 1);
    EXPECT_EQ(line_at(made.lines, 1).line, 3);
    EXPECT_EQ(line_at(made.lines, 1).column, 3);
    EXPECT_EQ(line_at(made.lines, 5).line, 3); // in the middle of it
    EXPECT_EQ(line_at(made.lines, code_address(1, 0)).line, 6);
    EXPECT_EQ(line_at({}, 7).line, 0);
}

TEST(Disassembler, GivesTextThatAssemblesToTheSameBytes) {
    std::mt19937 random(3);
    for (const NumberFormat& format :
         {binary64, binary32, fixed_format(2, 22), fixed_format(8, 24), fixed_format(4, 60)}) {
        for (int n = 0; n < 200; ++n) {
            Image image{.format = format};
            for (int byte = 0; byte < 60; ++byte) {
                const auto any = static_cast<std::uint8_t>(random());
                image.code.push_back(random() % 2 == 0 ? any
                                                       : static_cast<std::uint8_t>(
                                                             (random() % 3 == 0 ? 0x80 : 0x10) + any % 20));
            }
            const std::string text = disassemble(image);
            const auto [again, lines, errors, warnings] = assemble(text, "again.asm");
            ASSERT_TRUE(errors.empty()) << errors[0].message << '\n' << text;
            EXPECT_EQ(again, image) << text;
        }
    }
}

TEST(Disassembler, NamesTheArithmeticThatAnImageIsMadeFor) {
    const MadeFor settings{24, Rounding::toward_zero, SignOfZero::zero, ArcSense::thesis};
    const Image image{fixed_format(8, 24), {0x01}, settings};
    const Assembled again = assemble(disassemble(image), "again.asm");
    EXPECT_TRUE(again.errors.empty());
    EXPECT_EQ(again.image, image);
    const Assembled plain = assemble("HLT\n", "plain.asm", binary64, settings);
    EXPECT_EQ(plain.image.made_for, settings) << "where the text names nothing else";
}

TEST(Assembler, RefusesNumbersThatTheFormatTakesForNone) {
    const Assembled made = assemble(".format q8.24\nMOV XI, 0\nMOV YJ, -1e-8\nMOV Dz, 6e-8\n", "a.asm");
    ASSERT_EQ(made.errors.size(), 1U);
    EXPECT_EQ(made.errors[0].place.line, 3);
    EXPECT_EQ(made.errors[0].place.column, 9);
    EXPECT_THAT(made.errors[0].message, HasSubstr("-1e-8 is below the resolution of q8.24"));
}

/// The lines that the assembler warns of, behind those that load Vmax and Amax.
std::vector<int> idle_lines(const std::string& text) {
    const Assembled made = assemble("MOV Vmax, 1\nMOV Amax, 1\n" + text, "a.asm");
    EXPECT_TRUE(made.errors.empty());
    std::vector<int> lines;
    for (const Diagnostic& warning : made.warnings) {
        EXPECT_GT(warning.place.column, 0);
        lines.push_back(warning.place.line - 2);
    }
    return lines;
}

TEST(Assembler, WarnsOfMotionsThatLeadNowhere) {
    EXPECT_THAT(idle_lines("G01\n"), ElementsAre(1)) << "all registers are 0 after reset";
    EXPECT_THAT(idle_lines("MOV XI, 1\nG01\nG01\n"), ElementsAre(3));
    EXPECT_THAT(idle_lines("MOV Z, 1\nG01Z\nG01\nG00Z\n"), ElementsAre(3, 4));
    EXPECT_THAT(idle_lines("MOV Dz, 0.1\nMOV N, 3\nG02\nMOV N, 3\nG02\n"), ElementsAre(3))
        << "where the first arc ends is known to the processor alone";
    EXPECT_THAT(idle_lines("MOV XI, 1\nMOV N, 3\nG03\n"), ElementsAre(3)) << "Dz is 0";
    EXPECT_THAT(idle_lines("MOV XI, 1\nMOV Dz, 0.1\nMOV N, 3\nG03\nG03\n"), ElementsAre(5)) << "N is 0";
    EXPECT_THAT(idle_lines("MOV N, 3\nMOV Z, 0.1\nG02Z\n"), ElementsAre()) << "it climbs";
}

TEST(Assembler, WarnsOfMotionsWithoutSpeedOrAcceleration) {
    const auto warnings = [](const std::string& text) { return assemble(text, "a.asm").warnings; };
    const auto without = warnings("MOV Vmax, 1\nMOV XI, 1\n  G01\nHLT\n");
    ASSERT_EQ(without.size(), 1U);
    EXPECT_EQ(without[0].place.line, 3);
    EXPECT_EQ(without[0].place.column, 3);
    EXPECT_THAT(without[0].message, HasSubstr("a motion has no Vmax or Amax: the processor will stop"));
    EXPECT_TRUE(warnings("MOV Vmax, 1\nLD Amax, 0x8000\nMOV XI, 1\nG01\nHLT\n").empty());
}

TEST(Assembler, KnowsTheLineOfAByteThatStopsTheProcessor) {
    const Assembled made = assemble("NOP\n  .byte 0x77\nHLT\n", "a.asm");
    Processor processor({}, made.image);
    processor.run(100);
    ASSERT_EQ(processor.state().stop, Stop::illegal_instruction);
    const CodeLine at = line_at(made.lines, processor.state().instruction_at);
    EXPECT_EQ(at.line, 2);
    EXPECT_EQ(at.column, 3);
}

TEST(Assembler, DoesNotWarnWhereAnotherWayMayLead) {
    EXPECT_THAT(idle_lines("G: NOP\nG01\n"), ElementsAre());
    EXPECT_THAT(idle_lines("MOV PC, 5\nG01\n"), ElementsAre());
    EXPECT_THAT(idle_lines(".byte 0x00\nG01\n"), ElementsAre());
    EXPECT_THAT(idle_lines("LD XI, 0x8000\nG01\n"), ElementsAre());
}

} // namespace
} // namespace millwright::cordic
