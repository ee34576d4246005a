#include "tests/core/gcode/read_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace millwright::gcode {
namespace {

using test::ends_of;
using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> x_of(const std::string& text) {
    std::vector<double> x;
    for (const auto& end : ends_of(text)) {
        x.push_back(end[0]);
    }
    return x;
}

TEST(ControlFlow, ExecutesOneBranch) {
    const auto branch = [](const char* value) {
        return x_of(
            std::string("#1=") + value +
            "\nO1 if [#1 EQ 1]\nG0 X10\nO1 elseif [#1 EQ 2]\nG0 X20\nO1 elseif [#1 EQ 3]\nG0 X30\nO1 else\n"
            "G0 X40\nO1 endif\nX50");
    };
    EXPECT_THAT(branch("1"), ElementsAre(10, 50));
    EXPECT_THAT(branch("2"), ElementsAre(20, 50));
    EXPECT_THAT(branch("3"), ElementsAre(30, 50));
    EXPECT_THAT(branch("4"), ElementsAre(40, 50));
}

TEST(ControlFlow, DoesNotLookAtWhatIsLeftOut) {
    EXPECT_THAT(x_of("O1 if [0]\nG0 X[1/0] nonsense\nO1 elseif [1]\nG0 X1\nO1 elseif [1/0]\nO1 endif"),
                ElementsAre(1));
}

TEST(ControlFlow, ARefusedReturnHasNoSecondFault) {
    ReaderSettings settings;
    settings.most_errors = 5;
    settings.read_on = true;
    for (const char* const text : {"M98 P1\nG0 X9\nM2\nO1\nG0 X1\nM99 P10 G0 Z-50\n",
                                   "M98 P1\nM2\nO1\nG0 X1\nM99 garbage!\n",
                                   "M98 P1\nM2\nO1\nG0 X1\nG0 X2 M99\n"}) {
        EXPECT_THAT(test::read_all(text, settings).errors, testing::SizeIs(1)) << text;
    }
    EXPECT_THAT(test::read_all("M98 P1\nM2\nO1\nG0 X1\n", settings).errors,
                ElementsAre(testing::Field(&Diagnostic::message, HasSubstr("ends inside a subroutine"))));
}

TEST(ControlFlow, RepeatsLoops) {
    EXPECT_THAT(x_of("O1 while [#1 LT 3]\n#1=[#1+1]\nG0 X#1\nO1 endwhile"), ElementsAre(1, 2, 3));
    EXPECT_THAT(x_of("O1 do\n#1=[#1+1]\nG0 X#1\nO1 while [#1 LT 3]"), ElementsAre(1, 2, 3));
    EXPECT_THAT(x_of("G91\nO1 repeat [2]\nO2 repeat [2]\nG0 X1\nO2 endrepeat\nO1 endrepeat"),
                ElementsAre(1, 2, 3, 4));
}

TEST(ControlFlow, BreakAndContinueLeaveTheLoopOrThePass) {
    EXPECT_THAT(x_of("O1 while [1]\n#1=[#1+1]\nO2 if [#1 EQ 2]\nO1 continue\nO2 endif\nO3 if [#1 EQ 4]\nO1 "
                     "break\nO3 endif\n"
                     "G0 X#1\nO1 endwhile\nX9"),
                ElementsAre(1, 3, 9));
    // LinuxCNC stumbles over the break that it meets while it looks for the end of the pass.
    EXPECT_THAT(
        x_of("O1 do\n#1=[#1+1]\nO2 if [#1 EQ 2]\nO1 continue\nO2 endif\nO3 if [#1 EQ 4]\nO1 break\nO3 endif\n"
             "G0 X#1\nO1 while [1]\nX9"),
        ElementsAre(1, 3, 9));
}

TEST(ControlFlow, ABreakDoesNotEndTheNextLoop) {
    EXPECT_THAT(x_of("O1 while [1]\nO1 break\nO1 endwhile\nO2 do\n#1=[#1+1]\nG0 X#1\nO2 while [#1 LT 3]"),
                ElementsAre(1, 2, 3));
}

TEST(ControlFlow, SubroutinesHaveTheirOwnArgumentsNamesAndLabels) {
    EXPECT_THAT(x_of("#1=5\n#<a>=6\nO100 sub\n#<a>=[#1*2]\nO1 if [1]\nG0 X#<a>\nO1 endif\nO100 endsub\n"
                     "O100 call [1]\nO1 if [1]\nG0 X#1\nO1 endif\nX#<a>"),
                ElementsAre(2, 5, 6));
    EXPECT_THAT(error_of("O100 sub\n#<own>=1\nO100 endsub\nO100 call\nG0 X#<own>"),
                HasSubstr("#<own> is not defined"));
}

TEST(ControlFlow, SubroutinesReturnValues) {
    EXPECT_THAT(x_of("O100 sub\nO1 if [#1 GT 0]\nO100 return [#1+1]\nO1 endif\nO100 endsub\nO100 call "
                     "[4]\nG0 X#<_value>\n"
                     "X#<_value_returned>\nO100 call [0]\nX#<_value_returned>"),
                ElementsAre(5, 1, 0));
}

TEST(ControlFlow, ASubroutineMayStandBehindItsCall) {
    EXPECT_THAT(x_of("O100 call [3]\nG0 X1\nO100 sub\nG0 X#1\nO100 endsub\nX2"), ElementsAre(3, 1, 2));
}

TEST(ControlFlow, ReturnsFromInsideOfALoop) {
    EXPECT_THAT(
        x_of(
            "O100 sub\nO1 while [1]\n#1=[#1+1]\nG0 X#1\nO2 if [#1 EQ 2]\nO100 return\nO2 endif\nO1 endwhile\n"
            "O100 endsub\nO100 call [0]\nX9\nO100 call [1]\nX8"),
        ElementsAre(1, 2, 9, 2, 8));
}

TEST(ControlFlow, TheLabelOfAReturnDoesNotMatter) {
    EXPECT_THAT(x_of("O100 sub\nO1 if [1]\nO999 return [4]\nO1 endif\nO100 endsub\nO100 call\nG0 X#<_value>"),
                ElementsAre(4));
}

TEST(ControlFlow, FanucSubprogramsRepeat) {
    EXPECT_THAT(x_of("M98 P10 L3\nG90 G0 X0\nM2\nO10\nG91 G0 X1\nM99"), ElementsAre(1, 2, 3, 0));
}

TEST(ControlFlow, ModesComeBackWithTheSubroutine) {
    const auto program =
        test::read("G21 G90 F100 S500 M3\nO1 sub\nM73\nG20 G91 F5 M5 M8\nO1 endsub\nO1 call\nG1 X1");
    ASSERT_EQ(program.errors.size(), 0U);
    EXPECT_EQ(program.state.unit, LengthUnit::mm);
    EXPECT_DOUBLE_EQ(program.moves.back().target[Axis::x], 1.0);
    EXPECT_EQ(program.lines_of("SET_FEED_RATE").at(2), "SET_FEED_RATE(100.0000)");
    EXPECT_EQ(program.lines_of("START_SPINDLE_CLOCKWISE").size(), 2U);
}

TEST(ControlFlow, DefinitionsThatRunIntoTheEndNameTheirBeginning) {
    EXPECT_EQ(error_of("G0 X1\nO1 while [0]\nG0 X2"), "4:1: O1 of line 2 is not closed");
}

TEST(ControlFlow, TakesTheOutermostLoopThatGoesRoundForTheEndlessOne) {
    const auto line_of_error = [](const std::string& text) {
        ReaderSettings settings;
        settings.most_repeated_lines = 20'000;
        settings.most_errors = 100;
        const auto errors = test::read_all(text, settings).errors;
        EXPECT_EQ(errors.size(), 1U);
        return errors.empty() ? 0 : errors.front().place.line;
    };
    const std::string inner = "O2 repeat [50]\nG0 X1\nX2\nO2 endrepeat\n";
    EXPECT_EQ(line_of_error("G21 G90\nO1 while [1]\n" + inner + "O1 endwhile\nM2\n"), 2);
    EXPECT_EQ(line_of_error("G21 G90\nO1 do\n" + inner + "O1 while [1]\nM2\n"), 2);
    EXPECT_EQ(line_of_error("O2 repeat [9]\nG0 X1\nO1 while [1]\nG0 X2\nO1 endwhile\nO2 endrepeat\nM2\n"), 3);
    EXPECT_EQ(line_of_error("O9 sub\n" + inner + "O9 endsub\nO1 while [1]\nO9 call\nO1 endwhile\nM2\n"), 7);
    EXPECT_EQ(line_of_error("O9 sub\nO1 do\nG0 X1\nO1 while [1]\nO9 endsub\nG0 X0\nO9 call\nM2\n"), 2);
    EXPECT_EQ(line_of_error("G21\nM98 P7 L1000000\nM2\nO7\nG0 X1\nX2\nM99\n"), 2);
    EXPECT_EQ(line_of_error("O1 while [1]\nG0 X1\nO1 continue\nO1 endwhile\nM2\n"), 1);
}

} // namespace
} // namespace millwright::gcode
