#include "core/cordic_control/plc_assembler.h"

#include "core/base/error.h"
#include "core/cordic/assembler.h"
#include "core/cordic/microcode.h"
#include "core/cordic_control/plc.h"
#include "tests/core/cordic/wrong_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace millwright::cordic {
namespace {

using testing::HasSubstr;

TEST(PlcAssembler, NamesLineAndColumnOfEveryMistake) {
    for (const WrongText& wrong : {
             WrongText{"LD I0\n  LOAD I1", 2, 3, "\"LOAD\" is not an instruction"},
             WrongText{"LD I32", 1, 4, "\"I32\" is not a bit"},
             WrongText{"LD", 1, 3, "a bit is missing"},
             WrongText{"LD I0\nST I1", 2, 4, "I1 cannot be set by the logic"},
             WrongText{"LD I0\nST MOVING", 2, 4, "MOVING cannot be set by the logic"},
             WrongText{"LD I0\nS C0", 2, 3, "C0 cannot be set by the logic"},
             WrongText{"LD I0\nTON Q0, 5", 2, 5, "Q0 is not a timer"},
             WrongText{"LD I0\nCTU T0, 5", 2, 5, "T0 is not a counter"},
             WrongText{"LD I0\nTON T0", 2, 7, "a comma and a time in ms are expected"},
             WrongText{"LD I0\nTON T0, -1", 2, 9, "a comma and a time in ms are expected"},
             WrongText{"LD I0\nTON T0, nan", 2, 9, "a comma and a time in ms are expected"},
             WrongText{"LD I0\nCTU C0, 1.5", 2, 9, "a comma and a count are expected"},
             WrongText{"LD I0 I1", 1, 7, "unexpected \"I1\""},
             WrongText{"LD I0\n)", 2, 1, "no open parenthesis"},
             WrongText{"LD I0\nAND( I1", 2, 1, "AND( is not closed"},
             WrongText{"OR( I0\nOR( I0\nOR( I0\nOR( I0\nOR( I0\nOR( I0\nOR( I0\nOR( I0\n OR( "
                       "I0\n)\n)\n)\n)\n)\n)\n)\n)\n)",
                       9,
                       2,
                       "nested more than 8 deep"},
         }) {
        const auto errors = assemble_plc(wrong.text, "wrong.plc").errors;
        ASSERT_FALSE(errors.empty()) << wrong.text;
        EXPECT_EQ(errors[0].place.line, wrong.line) << wrong.text;
        EXPECT_EQ(errors[0].place.column, wrong.column) << wrong.text;
        EXPECT_THAT(errors[0].message, HasSubstr(wrong.message)) << wrong.text;
    }
}

TEST(Assembler, TextInUtf16IsAnErrorOfItsFirstLineInEveryLanguage) {
    const std::string text("N\0O\0P\0\n\0", 8);
    const std::vector<std::vector<Diagnostic>> found{assemble(text, "a.txt").errors,
                                                     assemble_microprogram(text, "a.txt", {}).errors,
                                                     assemble_plc(text, "a.txt").errors,
                                                     read_inputs(text, "a.txt").errors};
    for (const std::vector<Diagnostic>& errors : found) {
        ASSERT_EQ(errors.size(), 1U);
        EXPECT_THAT(to_text(errors[0]), HasSubstr("a.txt:1: the file is text in UTF-16"));
    }
}

} // namespace
} // namespace millwright::cordic
