#include "core/gcode_programs/klartext.h"

#include "core/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::gcode {
namespace {

using ::testing::HasSubstr;

using Lines = std::vector<std::string>;

/// With block numbers put before the lines.
std::string numbered(const Lines& lines) {
    std::string text;
    int number = 0;
    for (const std::string& line : lines) {
        text += std::to_string(number++) + " " + line + "\n";
    }
    return text;
}

/// A program of these lines.
std::string program_of(const Lines& lines) {
    Lines all{"BEGIN PGM A MM"};
    for (const std::string& line : lines) {
        all.push_back(line);
    }
    all.emplace_back("END PGM A MM");
    return numbered(all);
}

std::vector<WrittenStep> read_klartext(const Lines& lines) {
    WrittenTextRules rules;
    rules.work_offset[Axis::z] = 100.0;
    return read_written_klartext(program_of(lines), "a.h", rules);
}

std::string klartext_error(const std::string& text) {
    try {
        (void)read_written_klartext(text, "a.h", {});
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "read";
}

std::string error_in(const std::string& line) {
    return klartext_error(program_of({line}));
}

TEST(Klartext, ReadsStraightBlocks) {
    const auto steps =
        read_klartext({"L X+3 Y+4 R0 F600", "L Z-2.5 FMAX", "L A+10 C-5 R0 F50", "L Z+7 R0 FMAX M91"});
    ASSERT_EQ(steps.size(), 4U);
    EXPECT_EQ(steps[0].kind, StepKind::feed);
    EXPECT_EQ(steps[0].target[Axis::x], 3.0);
    EXPECT_DOUBLE_EQ(steps[0].value, 0.5);
    EXPECT_EQ(steps[1].kind, StepKind::rapid);
    EXPECT_EQ(steps[1].target[Axis::z], 97.5); // beside the work offset
    EXPECT_EQ(steps[1].target[Axis::y], 4.0);
    EXPECT_NEAR(steps[2].value, std::hypot(10.0, 5.0) / 50.0 * 60.0, 1e-12);
    EXPECT_EQ(steps[3].target[Axis::z], 7.0); // of the machine
    EXPECT_EQ(steps[3].line, 5);
}

TEST(Klartext, ReadsSwitches) {
    const auto steps = read_klartext({"; M30",
                                      "TOOL CALL 3 Z",
                                      "TOOL CALL 3 Z S9000",
                                      "M4",
                                      "M8",
                                      "CYCL DEF 9.0 DWELL TIME",
                                      "CYCL DEF 9.1 DWELL 1.5",
                                      "STOP",
                                      "M9",
                                      "M5",
                                      "M30"});
    ASSERT_EQ(steps.size(), 8U);
    EXPECT_EQ(steps[0].kind, StepKind::tool); // the second call changes its speed alone
    EXPECT_EQ(steps[0].value, 3.0);
    EXPECT_EQ(steps[1].value, -9000.0);
    EXPECT_EQ(steps[3].kind, StepKind::dwell);
    EXPECT_EQ(steps[3].value, 1.5);
    EXPECT_EQ(steps[4].kind, StepKind::pause);
    EXPECT_EQ(steps[7].kind, StepKind::end);
}

// TOOL CALL with S alone, or with the tool that is in the spindle, changes the speed of a spindle that turns.
TEST(Klartext, KeepsASpeedThatAToolCallChangesOnTheWay) {
    const auto steps = read_klartext({"TOOL CALL 3 Z S9000",
                                      "L X+1 FMAX M4",
                                      "TOOL CALL 3 Z S7000",
                                      "L X+2 FMAX",
                                      "TOOL CALL S5000",
                                      "TOOL CALL S4000",
                                      "M3", // says it
                                      "TOOL CALL Z S4000",
                                      "L X+3 FMAX",
                                      "TOOL CALL Z S2000",
                                      "M5",
                                      "TOOL CALL Z S1000",
                                      "L X+4 FMAX M30"});
    std::vector<std::pair<StepKind, double>> found;
    for (const WrittenStep& step : steps) {
        found.emplace_back(step.kind, step.kind == StepKind::spindle_on ? step.value : 0.0);
    }
    const std::vector<std::pair<StepKind, double>> expected{{StepKind::tool, 0.0},
                                                            {StepKind::spindle_on, -9000.0},
                                                            {StepKind::rapid, 0.0},
                                                            {StepKind::spindle_on, -7000.0},
                                                            {StepKind::rapid, 0.0},
                                                            {StepKind::spindle_on, 4000.0},
                                                            {StepKind::rapid, 0.0},
                                                            {StepKind::spindle_off, 0.0},
                                                            {StepKind::rapid, 0.0},
                                                            {StepKind::end, 0.0}};
    EXPECT_EQ(found, expected);
    EXPECT_EQ(steps[3].line, 4); // the first line begins the program
}

TEST(Klartext, KnowsWhenTheTipIsKept) {
    const auto steps = read_klartext({"L X+1 FMAX",
                                      "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS",
                                      "L X+2 FMAX",
                                      "FUNCTION RESET TCPM",
                                      "L X+3 FMAX",
                                      "M128",
                                      "L X+4 FMAX",
                                      "M129",
                                      "L X+5 FMAX"});
    const std::vector<bool> tip{false, true, false, true, false};
    for (std::size_t n = 0; n < tip.size(); ++n) {
        EXPECT_EQ(steps[n].tip, tip[n]);
    }
}

TEST(Klartext, ReadsInches) {
    const auto steps =
        read_written_klartext("0 BEGIN PGM A INCH\n1 L X+1 F60\n2 END PGM A INCH\n", "a.h", {});
    EXPECT_DOUBLE_EQ(steps[0].target[Axis::x], 25.4);
    EXPECT_DOUBLE_EQ(steps[0].value, 1.0);
}

// As controls of others write them: M behind the move, BLK FORM, comments behind blocks, lines that end as
// DOS's.
TEST(Klartext, ReadsWhatSurroundsTheBlocksInForeignPrograms) {
    const auto steps = read_klartext({"BLK FORM 0.1 Z X+0 Y+0 Z-10",
                                      "BLK FORM 0.2 X+100 Y+100 Z+0",
                                      "* - rough ; not a block",
                                      "TOOL CALL 1 Z S5000 F300 ; end mill",
                                      "L X+10 Y+10 R0 FMAX M3",
                                      "L Z-2 M8",
                                      "L Z+5 FMAX M9",
                                      "L M5",
                                      "L Z+50 R0 FMAX M30"});
    std::vector<StepKind> kinds;
    for (const WrittenStep& step : steps) {
        kinds.push_back(step.kind);
    }
    EXPECT_THAT(kinds,
                testing::ElementsAre(StepKind::tool,
                                     StepKind::spindle_on,
                                     StepKind::rapid,
                                     StepKind::coolant_on,
                                     StepKind::feed,
                                     StepKind::rapid,
                                     StepKind::coolant_off,
                                     StepKind::spindle_off,
                                     StepKind::rapid,
                                     StepKind::end));
    EXPECT_EQ(steps[1].value, 5000.0);
    EXPECT_DOUBLE_EQ(steps[4].value, 98.0 / 300.0 * 60.0); // to Z98 of the machine, by the feed of the call
    std::string dos;
    for (const char c : program_of({"L X+1\tFMAX", "M30 "})) {
        dos += c == '\n' ? "\r\n" : std::string(1, c);
    }
    EXPECT_EQ(klartext_error(dos), "read");
}

TEST(Klartext, ReadsProgramsWithoutBlockNumbers) {
    const std::string blocks =
        "BEGIN PGM A MM\n; a heading\n\nTOOL CALL 1 Z S800\nL X+3 Y+4 R0 F600 M3\nEND PGM A MM\n";
    const auto steps = read_written_klartext(blocks, "a.h", {});
    const auto move = std::ranges::find(steps, StepKind::feed, &WrittenStep::kind);
    ASSERT_NE(move, steps.end());
    EXPECT_EQ(move->line, 5);
    EXPECT_EQ(move->target[Axis::x], 3.0);
    EXPECT_EQ(move->target[Axis::y], 4.0);
    EXPECT_EQ(klartext_error("BEGIN PGM A MM\nL X+1 F60\nEND PGM A MM\n"), "read");
    EXPECT_THAT(klartext_error("L X+1 F60\nEND PGM A MM\n"),
                HasSubstr("a.h:1:1: a program must start with BEGIN PGM"));
    // Numbers that begin, or end, in the middle: a block may be lost.
    EXPECT_THAT(klartext_error("0 BEGIN PGM A MM\nL X+1 F60\n2 END PGM A MM\n"),
                HasSubstr("a.h:2:1: the block number must be 1"));
    EXPECT_NE(klartext_error("BEGIN PGM A MM\n1 L X+1 F60\nEND PGM A MM\n"), "read");
}

TEST(Klartext, RefusesWhatItDoesNotKnowWithItsPlace) {
    EXPECT_THAT(error_in("L X+1 RL F60"), HasSubstr("a.h:2:9: 'RL' is not supported in an L block"));
    EXPECT_THAT(error_in("L X+1"), HasSubstr("a.h:2:1: a feed move has no feed rate"));
    EXPECT_THAT(error_in("L X+1 X+2 F60"), HasSubstr("a.h:2:9: X occurs twice"));
    EXPECT_THAT(error_in("L X+1 FMAX F60"), HasSubstr("FMAX and F cannot be in the same block"));
    EXPECT_THAT(error_in("L X+-1 FMAX"), HasSubstr("a.h:2:5: 'X+-1' is not a number"));
    EXPECT_THAT(error_in("L X1e5 FMAX"), HasSubstr("is not a number"));
    EXPECT_THAT(error_in("L X FMAX"), HasSubstr("is not a number"));
    EXPECT_THAT(error_in("C X+1 Y+2 DR+"), HasSubstr("a.h:2:3: 'C' is found where M is expected"));
    EXPECT_THAT(error_in("M77"), HasSubstr("M77 is not supported"));
    EXPECT_THAT(error_in("CYCL DEF 200 DRILLING"), HasSubstr("only the cycles 9 and 32"));
    EXPECT_THAT(error_in("FUNCTION TCPM F CONT AXIS POS PATHCTRL AXIS"),
                HasSubstr("tool-tip control (TCPM) must be switched on with"));
    EXPECT_THAT(error_in("FUNCTION MODE MILL"),
                HasSubstr("tool-tip control (TCPM) must be switched on with"));
    EXPECT_THAT(error_in(""), HasSubstr("read"));
    EXPECT_THAT(klartext_error("0 BEGIN PGM A MM\n2 END PGM A MM\n"),
                HasSubstr("a.h:2:1: the block number must be 1"));
    EXPECT_THAT(klartext_error("0 BEGIN PGM A MM\n\n"), HasSubstr("a.h:2:1: the line is empty"));
    EXPECT_THAT(klartext_error("0 BEGIN PGM A MM\n"), HasSubstr("must end with END PGM"));
    EXPECT_THAT(klartext_error("0 BEGIN PGM A MM\n1 END PGM B MM\n"),
                HasSubstr("differs from the one after BEGIN PGM"));
    EXPECT_THAT(klartext_error("0 BEGIN PGM A CM\n"), HasSubstr("the unit must be MM or INCH"));
    EXPECT_THAT(klartext_error("0 L X+1 FMAX\n"), HasSubstr("must start with BEGIN PGM"));
    EXPECT_THAT(klartext_error("0 BEGIN PGM A MM\n1 END PGM A MM\n2 M30\n"),
                HasSubstr("nothing may follow END PGM"));
    EXPECT_THAT(klartext_error(""), HasSubstr("must end with END PGM"));
    EXPECT_THAT(klartext_error(program_of({"M128", "L Z+1 FMAX M91"})),
                HasSubstr("M91 can only be used with tool-tip control (TCPM) off"));
}

} // namespace
} // namespace millwright::gcode
