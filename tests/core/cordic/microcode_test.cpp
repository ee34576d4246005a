#include "core/cordic/microcode.h"

#include "core/cordic/microprogram.h"
#include "core/cordic/processor.h"
#include "tests/core/cordic/wrong_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace millwright::cordic {
namespace {

using testing::HasSubstr;

TEST(MicroAssembler, TurnsTextIntoWords) {
    const std::array<std::pair<std::string, int>, 1> constants = {{{"TIMES", 28}}};
    const auto [program, errors] =
        assemble_microprogram("; a comment\n"
                              "START: LDCT TIMES | fold_move\n"
                              "LOOP1: RPCT LOOP1 | rotate, rotate_both ; 29 times\n"
                              "  CJS bus_busy SUB\n"
                              "  JZ\n"
                              "SUB:\n"
                              "  CRTN always\n"
                              ".map 0x20 0x21 START\n",
                              "loop.mic",
                              constants);
    EXPECT_TRUE(errors.empty());
    EXPECT_EQ(program.count, 5);
    EXPECT_EQ(program.words[0], (MicroWord{MicroOp::LDCT, Condition::never, 28, bit_of(Control::fold_move)}));
    EXPECT_EQ(
        program.words[1],
        (MicroWord{
            MicroOp::RPCT, Condition::never, 1, bit_of(Control::rotate) | bit_of(Control::rotate_both)}));
    EXPECT_EQ(program.words[2], (MicroWord{MicroOp::CJS, Condition::bus_busy, 4, 0}));
    EXPECT_EQ(program.words[4], (MicroWord{MicroOp::CRTN, Condition::always, 0, 0}));
    EXPECT_EQ(program.lines[4], 7);
    EXPECT_EQ(program.map[0x20], 0);
    EXPECT_EQ(program.map[0x21], 0);
    EXPECT_FALSE(program.map[0x22]);
    EXPECT_EQ(program.labels.at("SUB"), 4);
}

TEST(MicroAssembler, NamesLineAndColumnOfEveryMistake) {
    for (const WrongText& wrong : {
             WrongText{"  JUMP always A", 1, 3, "\"JUMP\" is not a micro-operation"},
             WrongText{"CONT\n CJP always NOWHERE", 2, 13, "label NOWHERE is not defined"},
             WrongText{"CJP sometimes 0", 1, 5, "CJP needs a condition"},
             WrongText{"CJP", 1, 4, "CJP needs a condition"},
             WrongText{"LDCT", 1, 5, "a branch address or count is missing"},
             WrongText{"LDCT 256", 1, 6, "256 must be from 0 to 255"},
             WrongText{"LDCT -1", 1, 6, "-1 must be from 0 to 255"},
             WrongText{"CONT | fly", 1, 8, "\"fly\" is not a control signal"},
             WrongText{"CONT | rotate,", 1, 15, "a control signal is missing"},
             WrongText{"CONT rotate", 1, 6, "unexpected \"rotate\""},
             WrongText{"A: CONT\nA: CONT", 2, 1, "label A is already defined"},
             WrongText{"1A: CONT", 1, 1, "\"1A\" is not a label"},
             WrongText{".map 300 A", 1, 6, ".map needs an opcode from 0 to 255"},
             WrongText{".map 3", 1, 7, ".map needs a label"},
             WrongText{".map 3 B", 1, 8, "label B is not defined"},
             WrongText{"", 1, 1, "the microprogram has no words"},
             WrongText{"; nothing\n\n", 1, 1, "the microprogram has no words"},
             WrongText{"A: CONT\n.map 1 3 A\n.map 2 A", 3, 8, "opcode 0x02 is already mapped"},
         }) {
        const auto errors = assemble_microprogram(wrong.text, "wrong.mic").errors;
        ASSERT_EQ(errors.size(), 1U) << wrong.text;
        EXPECT_EQ(errors[0].place.line, wrong.line) << wrong.text;
        EXPECT_EQ(errors[0].place.column, wrong.column) << wrong.text;
        EXPECT_THAT(errors[0].message, HasSubstr(wrong.message)) << wrong.text;
    }
}

// Without a mapping ROM: the low four bits of the opcode choose among the words of a table.
TEST(MicroAssembler, GivesTheVectorJumpTheStartOfItsTable) {
    const auto [program, errors] = assemble_microprogram("FETCH: CONT | read_program\n"
                                                         "WAIT:  CJP bus_busy WAIT\n"
                                                         "       CONT | load_opcode\n"
                                                         "       CJV always TABLE\n"
                                                         "TABLE: JZ\n"
                                                         "       JZ | next_page\n"
                                                         "       JZ | halt\n",
                                                         "vector.mic");
    ASSERT_TRUE(errors.empty());
    Processor processor({}, Image{.format = binary32, .code = {0x00, 0xf0, 0x02, 0x00}}, program);
    processor.run(1000);
    EXPECT_EQ(processor.state().stop, Stop::halted);
    EXPECT_EQ(processor.state().opcode, 0x02);
}

TEST(MicroAssembler, RefusesMoreThanTheRomHolds) {
    std::string text;
    for (int n = 0; n < micro_rom_size + 1; ++n) {
        text += "CONT\n";
    }
    const auto errors = assemble_microprogram(text, "long.mic").errors;
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_EQ(errors[0].place.line, micro_rom_size + 1);
}

Stop stop_of(const std::string& text, const std::vector<std::uint8_t>& code = {0x01}) {
    auto made = assemble_microprogram(text, "own.mic");
    EXPECT_TRUE(made.errors.empty()) << text;
    Processor processor({}, Image{.format = binary32, .code = code}, std::move(made.program));
    EXPECT_LT(processor.run(100'000), 100'000) << text;
    return processor.state().stop;
}

TEST(MicroprogramOfOnesOwn, StopsWhereItLeavesWhatThereIs) {
    std::string full;
    for (int n = 0; n < micro_rom_size; ++n) {
        full += "CONT\n";
    }
    EXPECT_EQ(stop_of("CONT\nCONT\n"), Stop::microprogram_end);
    EXPECT_EQ(stop_of(full), Stop::microprogram_end); // not again from 0
    EXPECT_EQ(stop_of("CJP always 9\n"), Stop::microprogram_end);
    EXPECT_EQ(stop_of("CONT | command\nA: CONT | write_byte\nCJP always A\n"), Stop::too_many_bytes);
    EXPECT_EQ(stop_of("CONT | publish\nA: CONT | write_byte\nCJP always A\n"), Stop::too_many_bytes);
    EXPECT_EQ(stop_of("CONT | write_byte\nJZ\n"), Stop::too_many_bytes); // nothing was handed over
    EXPECT_EQ(stop_of("A: CONT | shift_byte\nCJP always A\n"), Stop::too_many_bytes);
    EXPECT_EQ(stop_of("A: CONT | rotate\nCJP always A\n"), Stop::too_many_steps);
    EXPECT_EQ(stop_of("A: CONT | correct\nCJP always A\n"), Stop::too_many_steps);
    EXPECT_EQ(stop_of("CONT | count_chord\nJZ\n"), Stop::arc_too_coarse);     // N is 0
    EXPECT_EQ(stop_of("CONT | write_data\nJZ\n"), Stop::illegal_instruction); // IR names no register
}

TEST(Microprogram, FitsItsRomAndIsListed) {
    for (const Publishing publishing : {Publishing::latch, Publishing::bus}) {
        const Microprogram program = make_microprogram(thesis_sequence(), binary32, publishing);
        EXPECT_EQ(program.labels.at("FETCH"), 0);
        EXPECT_LE(program.count, 128); // half of the ROM is free
        EXPECT_THAT(listing(program), HasSubstr("FETCH:     CONT"));
        EXPECT_THAT(listing(program), HasSubstr("rotate rotate_both"));
    }
}

} // namespace
} // namespace millwright::cordic
