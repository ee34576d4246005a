#include "core/gcode/canon_printer.h"
#include "core/gcode/interpreter.h"
#include "tests/core/gcode/read_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace millwright::gcode {
namespace {

using testing::HasSubstr;

ReaderSettings grbl() {
    ReaderSettings settings;
    settings.dialect = Dialect::grbl;
    return settings;
}

test::ReadProgram read_grbl(const std::string& text) {
    return test::read_all(text, grbl());
}

std::string grbl_refusal(const std::string& text) {
    const auto program = read_grbl(text);
    return program.errors.empty() ? std::string() : program.errors.front().message;
}

TEST(Grbl, TakesItsSubset) {
    const auto program =
        read_grbl("X1 Y2 (rapid is the mode at the start)\nG1 X5 F100\nG2 X10 Y0 I2.5 J-1\nG38.2 Z-5\n"
                  "G10 L20 P1 X0\nG28.1\nG53 G0 X0\nG43.1 Z1\nG49\nM3 S1000\nM8\nG4 P0.1\nG80\n");
    EXPECT_EQ(program.errors.size(), 0U) << (program.errors.empty() ? "" : to_text(program.errors.front()));
}

TEST(Grbl, NeedsNoEndAndSaysThatThereIsNone) {
    const auto notice_of = [](const std::string& text) {
        CanonPrinter sink([](std::string_view) {});
        Interpreter program(text, "part.nc", grbl(), sink);
        program.run();
        EXPECT_TRUE(program.errors().empty());
        return program.end_notice() ? to_text(*program.end_notice()) : std::string();
    };
    EXPECT_EQ(notice_of("G0 X1"),
              "part.nc: the program does not end with M2 or M30; it was read to its last line (Grbl does not "
              "switch off the spindle and the coolant)");
    EXPECT_EQ(notice_of("G0 X1\nM2\n"), "");
    EXPECT_EQ(notice_of("%\nG0 X1\nM30\n%\n"), "");
}

TEST(Grbl, KeepsTheFeedWhenItsModeIsSetAgain) {
    EXPECT_EQ(grbl_refusal("G94 F100\nG94 G1 X1\n"), "");
    EXPECT_THAT(test::error_of("G94 F100\nG94 G1 X1"), HasSubstr("feed rate of zero"));
}

TEST(Grbl, RefusesWhatItDoesNotKnowByItsOwnErrorNumbers) {
    EXPECT_THAT(grbl_refusal("G81 X1 Z-1 R1"), HasSubstr("G81 (error 20)"));
    EXPECT_THAT(grbl_refusal("G41 D1"), HasSubstr("G41 (error 20)"));
    EXPECT_THAT(grbl_refusal("G43 H1"), HasSubstr("G43 (error 20)"));
    EXPECT_THAT(grbl_refusal("G64"), HasSubstr("G64 (error 20)"));
    EXPECT_THAT(grbl_refusal("M6"), HasSubstr("M6 (error 20)"));
    EXPECT_THAT(grbl_refusal("G59.1"), HasSubstr("(error 23)"));
    EXPECT_THAT(grbl_refusal("G90.1"), HasSubstr("(error 20)"));
    EXPECT_THAT(grbl_refusal("G92.2"), HasSubstr("(error 20)"));
    EXPECT_THAT(grbl_refusal("M98 P1"), HasSubstr("M98 (error 20)"));
    EXPECT_THAT(grbl_refusal("T256"), HasSubstr("(error 38)"));
    EXPECT_THAT(grbl_refusal("G0 A5"), HasSubstr("A words (error 20)"));
    EXPECT_THAT(grbl_refusal("G0 X[1+1]"), HasSubstr("(error 2)"));
    EXPECT_THAT(grbl_refusal("#1=5"), HasSubstr("(error 1)"));
    EXPECT_THAT(grbl_refusal("O1 call"), HasSubstr("(error 20)"));
    EXPECT_THAT(grbl_refusal("G1 F1\nG2 I5"), HasSubstr("(error 26)"));
    EXPECT_THAT(grbl_refusal("G1 F1\nG2 X1 Y1 I.5 J.5 P2"), HasSubstr("(error 36)"));
}

// The advice was G90.1, which the next line of the same check refused.
TEST(Grbl, IsNotAdvisedWhatItDoesNotKnow) {
    const auto errors = read_grbl("G21 G90\nG0 X10 Y0\nG2 X20 Y10 I20 J0 F100\nM2\n").errors;
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_THAT(errors[0].hint, HasSubstr("incremental centres"));
    EXPECT_THAT(errors[0].hint, testing::Not(HasSubstr("G90.1")));
}

TEST(Grbl, CodesOfOtherFirmwareAreNotCalledUnknownToIt) {
    const auto refusal = [](const char* firmware, const std::string& text) {
        ReaderSettings settings = grbl();
        settings.grbl_name = firmware;
        const auto program = test::read_all(text, settings);
        return program.errors.empty() ? std::string() : program.errors.front().message;
    };
    for (const char* line : {"G81 X1 Z-1 R1", "G43 H1", "M6", "G59.1", "M62 P1"}) {
        EXPECT_THAT(refusal("grblHAL", line), HasSubstr("is not a code of Grbl 1.1: grblHAL may support it"))
            << line;
    }
    EXPECT_THAT(refusal("FluidNC", "M6"), HasSubstr("FluidNC may support it"));
    EXPECT_EQ(refusal("FluidNC", "G81 X1 Z-1 R1"), "FluidNC does not support G81 (error 20)");
    EXPECT_EQ(refusal("grblHAL", "G64"), "grblHAL does not support G64 (error 20)");
}

TEST(Grbl, RefusesArcsByItsOwnErrorNumbers) {
    const auto arc = [](const std::string& words) { return grbl_refusal("G1 F1\n" + words); };
    EXPECT_THAT(arc("G2 Z1 I1"), HasSubstr("(error 32)"));
    EXPECT_THAT(arc("G18 G2 Y1 I1"), HasSubstr("(error 32)"));
    EXPECT_THAT(arc("G2 X1"), HasSubstr("(error 35)"));
    EXPECT_THAT(arc("G2 X1 K1"), HasSubstr("(error 35)"));
    EXPECT_EQ(arc("G2 X1 Y1 I.5 J.5 K1"), ""); // it reads over the offset across the plane
    EXPECT_THAT(arc("G2 X1 R1 I1"), HasSubstr("(error 36)"));
    EXPECT_THAT(arc("G2 X2 I1\nX4"), HasSubstr("(error 35)")); // still an arc
    EXPECT_EQ(arc("G2 X2 I1\nG92 X4\nG1 X1"), "");
    EXPECT_EQ(arc("G19 G3 Y2 J1\nY4 K0 J1"), "");
}

TEST(Grbl, RefusesAToolLengthOrTheEndOfG92BesideAMotion) {
    EXPECT_THAT(grbl_refusal("G43.1 G1 Z1 F100"), HasSubstr("G43.1 and G1 both use axis words"));
    EXPECT_THAT(grbl_refusal("G49 G0"), HasSubstr("(error 24)"));
    EXPECT_THAT(grbl_refusal("G00 G17 G49 G80 G90"),
                HasSubstr("(error 24)")); // gcode.c: G49 is an axis command
    EXPECT_THAT(grbl_refusal("G49 X1"), HasSubstr("Grbl ignores axis words in a line with G49"));
    EXPECT_THAT(grbl_refusal("G92 X1\nG92.1 G0 X1"), HasSubstr("Grbl still moves by the old G92"));
    EXPECT_EQ(grbl_refusal("G92.1 G0 X1"), ""); // where there is no G92, both are the same
    EXPECT_EQ(grbl_refusal("G49 G80\nG92.1 G80"), "");
}

TEST(Grbl, RefusesOffsetsByItsOwnErrorNumbers) {
    EXPECT_THAT(grbl_refusal("G10 L2 P1"), HasSubstr("(error 26)"));
    EXPECT_THAT(grbl_refusal("G10 X1"), HasSubstr("(error 28)"));
    EXPECT_THAT(grbl_refusal("G10 L2 P7 X1"), HasSubstr("(error 29)"));
    EXPECT_THAT(grbl_refusal("G10 L2 P-1 X1"), HasSubstr("(error 4)"));
    EXPECT_THAT(grbl_refusal("G10 L3 P1 X1"), HasSubstr("(error 20)"));
    EXPECT_THAT(grbl_refusal("G10 L2 P1 X1 R5"), HasSubstr("(error 20)"));
    EXPECT_THAT(grbl_refusal("G10 L20 P1 X1 R5"), HasSubstr("(error 36)"));
}

/// LinuxCNC reads F before the unit changes.
TEST(Grbl, TakesAFeedInTheUnitOfItsOwnLine) {
    const std::string text = "G20 G0 X.5\nG21 G1 X50 F1000\n";
    const auto program = read_grbl(text);
    EXPECT_EQ(program.lines_of("SET_FEED_RATE"), std::vector<std::string>{"SET_FEED_RATE(1000.0000)"});
    EXPECT_EQ(program.state.feed_rate, 1000.0);
    EXPECT_EQ(program.lines_of("USE_LENGTH_UNITS").size(), 3U); // at the start and of each line
    EXPECT_EQ(test::read_all(text).state.feed_rate, 25400.0);
    EXPECT_EQ(read_grbl("G21 F2540\nG20").state.feed_rate, 100.0);
}

TEST(Grbl, TakesG53AsAbsoluteInIncrementalMode) {
    const auto program = read_grbl("G92 X-1\nG91\nG0 X5 Z-5\nG53 G0 Z-1\n");
    ASSERT_EQ(program.errors.size(), 0U);
    EXPECT_EQ(program.moves.back().target[Axis::x], 4.0);
    EXPECT_EQ(program.moves.back().target[Axis::z], -1.0);
    EXPECT_THAT(test::error_of("G91 G53 G0 Z-1"), HasSubstr("G53 cannot be used in incremental mode"));
}

TEST(Grbl, LeavesTheAxisWordOfAToolLengthToIt) {
    const auto program = read_grbl("G1 F100 X0\nG2 X20 Y0 R15\nG43.1 Z3\n");
    ASSERT_EQ(program.errors.size(), 0U);
    EXPECT_EQ(program.moves.size(), 2U);
    EXPECT_EQ(program.state.tool_offset[Axis::z], 3.0);
}

/// They are not sent.
TEST(Grbl, ReadsOverPercentSigns) {
    EXPECT_EQ(read_grbl("%\nG0 X1\n% (again)\nG0 X2\n %\n").moves.size(), 2U);
    EXPECT_EQ(grbl_refusal("%\nG0 X1\n%\n"), "");
    EXPECT_THAT(grbl_refusal("G0 X1 %"), HasSubstr("'%' in a program (error 1)"));
    EXPECT_THAT(grbl_refusal("%O1000"), HasSubstr("'%' in a program (error 1)"));
    EXPECT_THAT(grbl_refusal("%\n%\n"), HasSubstr("the program is empty"));
}

/// Also axis words of codes that move nothing.
TEST(Grbl, TakesNoAxisWordsWhileMotionIsCancelled) {
    for (const char* line : {"X1", "G43.1 Z1", "G92 X1", "G10 L20 P1 X0", "G28 X1"}) {
        EXPECT_THAT(grbl_refusal(std::string("G80\n") + line), HasSubstr("(error 31)")) << line;
    }
    EXPECT_THAT(grbl_refusal("G80 G0 X1"), HasSubstr("(error 21)"));
    EXPECT_EQ(grbl_refusal("G80\nG28\nG0 X1"), "");
}

TEST(Grbl, HasMistWhereItWasBuiltWithIt) {
    EXPECT_THAT(grbl_refusal("M7"), HasSubstr("not support mist coolant, M7 (error 20)"));
    ReaderSettings built = grbl();
    built.mist = true;
    EXPECT_EQ(test::read_all("M7", built).errors.size(), 0U);
    EXPECT_THAT(test::read_all("M7 M8", built).errors.at(0).message, HasSubstr("(error 21)"));
}

TEST(Grbl, ReadsOverWhatTheFirmwareReadsOver) {
    EXPECT_EQ(grbl_refusal("G0 X1 (open to the end of the line"), "");
    EXPECT_EQ(grbl_refusal("G0 (a (comment) in a comment X1"), grbl_refusal("G0 in a comment X1"));
    EXPECT_EQ(read_grbl("G0 (a (b) X1").moves.size(), 1U);
    EXPECT_EQ(grbl_refusal("G0 X1 N5 / Y2"), "");
    EXPECT_EQ(read_grbl("T1.9").state.selected_tool, 1);
    EXPECT_EQ(grbl_refusal("G10 L2.9 P1.5 X1\nG10 L2 P.5 X1"), "");
    EXPECT_EQ(grbl_refusal("G4 P.5"), "");
}

TEST(Grbl, CountsTheCharactersThatItKeeps) {
    EXPECT_EQ(grbl_refusal("G0 X1" + std::string(200, ' ') + "(" + std::string(200, 'c') + ")"), "");
    EXPECT_THAT(grbl_refusal("G0 X" + std::string(90, '0')), HasSubstr("(error 11)"));
}

} // namespace
} // namespace millwright::gcode
