#include "core/cordic/assembler.h"

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
    const auto [image, lines, errors] = assemble("        .format q8.24\n"
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
    const auto [image, lines, errors] = assemble(".format f64\nmov Vmax, 1", "a.asm");
    EXPECT_TRUE(errors.empty());
    EXPECT_THAT(image.code, ElementsAre(0x12, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f));
}

struct Wrong {
    const char* text;
    int line, column;
    const char* message;
};

TEST(Assembler, NamesLineAndColumnOfEveryMistake) {
    for (const Wrong& wrong : {
             Wrong{"g00\n  g05", 2, 3, "\"g05\" is no instruction"},
             Wrong{"mov Q, 1", 1, 5, "\"Q\" is no register"},
             Wrong{"mov", 1, 4, "a register is missing"},
             Wrong{"mov XI 1", 1, 8, "a comma is missing"},
             Wrong{"mov XI,", 1, 8, "a number is missing"},
             Wrong{"mov XI, one", 1, 9, "\"one\" is no number"},
             Wrong{"mov XI, nan", 1, 9, "\"nan\" is no number"},
             Wrong{"mov XI, 1e400", 1, 9, "is no number"},
             Wrong{".format q8.8\nmov XI, 200", 2, 9, "200 does not fit into q8.8"},
             Wrong{"mov N, -1", 1, 8, "\"-1\" is no whole number"},
             Wrong{"mov N, 1.5", 1, 8, "\"1.5\" is no whole number"},
             Wrong{"mov PC, 65536", 1, 9, "no whole number from 0 to 65535"},
             Wrong{"mov XI, 0x123456789", 1, 9, "no hexadecimal number of 4 bytes"},
             Wrong{"mov PC, 0x1000A", 1, 9, "\"0x1000A\" is no whole number from 0 to 65535"},
             Wrong{".format f64\nmov N, 0x100000001", 2, 8, "no whole number from 0 to 4294967295"},
             Wrong{".format f64\nmov P, 0x100000001", 2, 8, "no whole number from 0 to 4294967295"},
             Wrong{"mov XI, +-1", 1, 9, "\"+-1\" is no number"},
             Wrong{"ld Vz, 0x8000", 1, 4, "Vz is computed and cannot be loaded"},
             Wrong{"ld XI, 70000", 1, 8, "\"70000\" is no address from 0 to 65535"},
             Wrong{"ld XI, 0xfffd", 1, 8, "4 bytes at \"0xfffd\" are not all on the bus"},
             Wrong{"st XI, 0x7fff", 1, 8, "are not all in the RAM or the motion controller's port"},
             Wrong{"a: st XI, a", 1, 11, "\"a\" is no address"},
             Wrong{"ld XI, away", 1, 8, "there is no label away"},
             Wrong{"mov PC, away", 1, 9, "there is no label away"},
             Wrong{"a: nop\na: nop", 2, 1, "label a is there already"},
             Wrong{"g01 g02", 1, 5, "\"g02\" is too much"},
             Wrong{"nop\n.format f64", 2, 9, ".format stands behind"},
             Wrong{".format f63", 1, 9, "\"f63\" is no number format"},
             Wrong{".byte 256", 1, 7, ".byte needs a number from 0 to 255"},
             Wrong{"a: PAGE\n.page\n mov PC, a", 3, 10, "label a lies in another page"},
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
    EXPECT_THAT(errors[0].message, HasSubstr("crosses the end of a page"));
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
            const auto [again, lines, errors] = assemble(text, "again.asm");
            ASSERT_TRUE(errors.empty()) << errors[0].message << '\n' << text;
            EXPECT_EQ(again, image) << text;
        }
    }
}

} // namespace
} // namespace millwright::cordic
