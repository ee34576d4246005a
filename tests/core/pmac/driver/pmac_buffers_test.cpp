// Buffers that the card does not take as they were sent, in computed time.
#include "core/pmac/driver/internal/buffer_words.h"
#include "core/pmac/driver/pmac_file.h"
#include "core/pmac/driver/refused_lines.h"
#include "tests/core/pmac/driver/pmac_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::pmac::internal {
namespace {

using test::PmacWire;
using testing::ElementsAre;
using testing::HasSubstr;

/// What is said to a file, with the numbers of its lines.
std::string said_to(PmacWire& wire, const std::string& text) {
    const PmacFile file = read_pmac_file(text, "demo.ini");
    std::vector<std::string> lines;
    for (const PmacFile::Line& line : file.lines) {
        lines.push_back(line.text);
    }
    (void)wire.session.load(lines);
    EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 5.0)) << text;
    EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::refused) << text;
    return with_line_numbers(wire.session.status().answer.text, file, "");
}

// The card opened it at OPEN and refused what is behind: reports and settings were stored in it.
TEST(PmacBuffers, ARefusedOpenIsClosedAllTheSame) {
    PmacWire wire({}, false);
    const std::string said = said_to(wire, "OPEN PLC 5 WHILE (1\nCLEAR\nP1=2\nCLOSE\nI130=3000\nI131=900\n");
    EXPECT_THAT(said, HasSubstr("1: 'OPEN PLC 5 WHILE (1' is rejected: ERR003"));
    EXPECT_THAT(said, HasSubstr("2: 'CLEAR' is not executed: its buffer was not opened"));
    EXPECT_THAT(said, HasSubstr("3: 'P1=2' is not executed"));
    EXPECT_EQ(said.find("'CLOSE'"), std::string::npos) << said;
    EXPECT_EQ(wire.card.variable('I', 130), 3000.0);
    EXPECT_EQ(wire.card.variable('I', 131), 900.0);
    (void)wire.session.command({"LIST PLC 5"}, false);
    EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
    EXPECT_EQ(wire.session.status().answer.text, "");
}

// They were lost without a word.
TEST(PmacBuffers, LinesBehindARefusedOpenWithoutCloseAreNamed) {
    PmacWire wire({}, false);
    const std::string said = said_to(wire, "P10=1\nOPEN PLC 77\nP1=1\n\nP20=5\nP21=6\n");
    EXPECT_THAT(said, HasSubstr("2: 'OPEN PLC 77' is rejected"));
    EXPECT_THAT(said, HasSubstr("3: 'P1=1' is not executed"));
    EXPECT_THAT(said, HasSubstr("5: 'P20=5' is not executed"));
    EXPECT_THAT(said, HasSubstr("6: 'P21=6' is not executed"));
    EXPECT_EQ(wire.card.variable('P', 10), 1.0);
    EXPECT_EQ(wire.card.variable('P', 20), 0.0);
}

TEST(PmacBuffers, ManyLinesBehindARefusedOpenAreCounted) {
    PmacWire wire({}, false);
    std::string text = "OPEN PROG 40000\n";
    for (int n = 0; n < 300; ++n) {
        text += "X" + std::to_string(n) + "\n";
    }
    const std::string said = said_to(wire, text + "CLOSE\nP22=4\n");
    EXPECT_THAT(said, HasSubstr("11: 'X9' is not executed"));
    EXPECT_THAT(said, HasSubstr("12: 'X10' and the 289 lines behind it, up to 'X299', are not executed"));
    EXPECT_EQ(wire.card.variable('P', 22), 4.0);
}

TEST(PmacBuffers, AProgramThatLacksALineIsCalledIncomplete) {
    PmacWire wire({}, false);
    const std::string said = said_to(wire, "OPEN PROG 4\nCLEAR\nX1\nFOO=BAR\nX2\nCLOSE\nI999999=3\n");
    EXPECT_THAT(said,
                testing::ContainsRegex("4: 'FOO=BAR' is rejected: [^\n]*; the program of 'OPEN PROG 4' is "
                                       "stored without this line and is incomplete\n"));
    EXPECT_THAT(said, HasSubstr("7: 'I999999=3' is rejected"));
    EXPECT_EQ(said.rfind("incomplete"), said.find("incomplete")) << said;
}

// OPEN was found in "STOP ENDIF", and the program refused: OPEN DIF.
TEST(PmacBuffers, ALineIsSplitAtTheCardsWords) {
    EXPECT_THAT(split_at_buffer_words("IF (P1=1) STOP ENDIF"), ElementsAre("IF (P1=1) STOP ENDIF"));
    EXPECT_FALSE(has_buffer_word("STOP ENDWHILE"));
    EXPECT_FALSE(has_buffer_word("P1=$C LEAR"));
    EXPECT_FALSE(has_buffer_word("P1=$CLEAR"));
    EXPECT_THAT(split_at_buffer_words("O PEN plc 5 cl s P1=$C CLOSE"),
                ElementsAre("OPEN plc 5", "CLOSE", "P1=$C", "CLOSE"));
    EXPECT_THAT(split_at_buffer_words("STOP OPEN PROG 2 CLR"), ElementsAre("STOP", "OPEN PROG 2", "CLEAR"));
    PmacWire wire;
    const std::vector<std::string> lines{"OPEN PROG 4", "CLEAR", "IF (P1=1) STOP ENDIF", "CLOSE"};
    (void)wire.session.command(lines, false);
    EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
    EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::done)
        << wire.session.status().answer.text;
    (void)wire.session.command({"LIST PROG 4"}, false);
    EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
    EXPECT_EQ(wire.session.status().answer.text, "IF(P1=1)STOPENDI");
    EXPECT_EQ(read_pmac_file("OPEN PROG 4\nIF (P1=1) STOP ENDIF\nCLOSE\n", "a.ini").lines.size(), 3u);
    EXPECT_EQ(test::refusal([&] {
                  wire.session.start({"IF (P1=1) STOP ENDIF", "ABS LINEAR TM500", "X0"}, wire.now);
              }),
              "");
}

// A structure that the card refuses at CLOSE was an alarm.
TEST(PmacBuffers, ARefusedCloseIsNoAlarm) {
    PmacWire wire({}, false);
    EXPECT_THAT(said_to(wire, "OPEN PLC 5\nCLEAR\nWHILE(P1=1)\n"), HasSubstr("'CLOSE' is rejected"));
    for (const std::string line : {"CLOSE", "FOO=BAR"}) {
        (void)wire.session.command({"OPEN PLC 5", "CLEAR", "WHILE(P1=1)", line, "CLOSE"}, false);
        wire.pass(1.0);
        EXPECT_EQ(wire.state(), drivers::DriverState::idle) << line << wire.session.status().message;
        EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::refused) << line;
    }
}

} // namespace
} // namespace millwright::pmac::internal
