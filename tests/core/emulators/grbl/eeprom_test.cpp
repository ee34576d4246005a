// What an emulated Grbl loses of its serial line while it writes its EEPROM, and what it shows of new
// offsets.
#include "core/emulators/grbl/grbl_emulator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace millwright::emulators {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> executed(const GrblEmulator& grbl) {
    std::vector<std::string> lines;
    for (const TruthLine& line : grbl.truth().lines) {
        lines.push_back(line.text);
    }
    return lines;
}

void rest(GrblEmulator& grbl) {
    do {
        grbl.advance(0.2);
    } while (grbl.moving() || grbl.planned_blocks() > 0);
}

struct GrblEeprom : testing::Test {
    GrblEmulator grbl;
    GrblEeprom() { (void)grbl.take_output(); }
};

TEST_F(GrblEeprom, LosesWhatComesWhileItWritesAnOffset) {
    grbl.receive("G10L2P1X12.345Y6.789Z0.5\nG54\nG0Z15\nG0X60Y40\nG1Z1F600\n");
    rest(grbl);
    EXPECT_GT(grbl.truth().lost_bytes, 20);
    const auto lines = executed(grbl);
    ASSERT_FALSE(lines.empty());
    EXPECT_EQ(lines.front(), "G10L2P1X12.345Y6.789Z0.5");
    EXPECT_THAT(lines, Not(testing::Contains("G0X60Y40")));
}

TEST_F(GrblEeprom, LosesNothingWhereTheAnswerIsAwaited) {
    for (const char* line :
         {"G10L2P1X12.345Y6.789Z0.5", "G54", "G0Z15", "$110=1000", "$N0=G54", "G28.1", "G0X1"}) {
        grbl.receive(std::string(line) + "\n");
        rest(grbl);
        EXPECT_EQ(grbl.take_output(), "ok\r\n") << line;
    }
    EXPECT_EQ(grbl.truth().lost_bytes, 0);
}

TEST_F(GrblEeprom, LosesNothingWhereTheOffsetIsTheSameAsBefore) {
    grbl.receive("G10L2P1X0Y0Z0\nG0X1\nG0X2\n");
    rest(grbl);
    EXPECT_EQ(grbl.truth().lost_bytes, 0);
    EXPECT_EQ(executed(grbl).size(), 3U);
}

/// 3.4 ms per byte that needs erasing and writing.
TEST_F(GrblEeprom, AnswersWhenItHasWritten) {
    grbl.receive("G10L2P1X12.345Y6.789Z0.5\n");
    grbl.advance(0.010);
    grbl.receive("?"); // one that the UART keeps
    EXPECT_EQ(grbl.take_output(), "");
    grbl.advance(0.060);
    EXPECT_THAT(grbl.take_output(), HasSubstr("ok\r\n"));
}

TEST_F(GrblEeprom, LosesRealTimeBytesToo) {
    grbl.receive("G10L2P1X12.345Y6.789Z0.5\n");
    grbl.advance(0.005);
    grbl.receive(std::string(2, '?') + std::string(4, '!'));
    grbl.advance(0.1);
    EXPECT_GT(grbl.truth().lost_bytes, 3);
    (void)grbl.take_output();
    grbl.receive("?");
    EXPECT_THAT(grbl.take_output(), StartsWith("<Idle|"));
}

/// The real one finds out whether a startup line is right by executing it.
TEST_F(GrblEeprom, ExecutesAStartupLineWhenItIsStored) {
    grbl.receive("$N0=G20G54\n");
    grbl.advance(0.5);
    (void)grbl.take_output();
    grbl.receive("$G\n");
    grbl.advance(0.1);
    EXPECT_THAT(grbl.take_output(), HasSubstr("G54 G17 G20 "));
}

/// Work positions count from the new offset when the line is parsed, and the offset is shown when the motion
/// before it has ended.
TEST_F(GrblEeprom, ReportsByANewOffsetBeforeItShowsIt) {
    grbl.receive("$10=0\n");
    grbl.advance(0.1);
    grbl.receive("G10L2P2X100\n");
    grbl.advance(0.1);
    grbl.receive("G1X10F600\n");
    grbl.advance(0.5);
    (void)grbl.take_output();
    for (int n = 0; n < 3; ++n) {
        grbl.receive("?");
        grbl.advance(0.001);
    }
    (void)grbl.take_output(); // those with WCO and Ov
    grbl.receive("G55\n");
    grbl.advance(0.01);
    grbl.receive("?");
    grbl.advance(0.001);
    const std::string moving = grbl.take_output();
    EXPECT_THAT(moving, StartsWith("<Run|WPos:-9"));
    EXPECT_THAT(moving, Not(HasSubstr("WCO")));
    rest(grbl);
    EXPECT_EQ(grbl.take_output(), "ok\r\n");
    grbl.receive("?");
    grbl.advance(0.001);
    EXPECT_THAT(grbl.take_output(), HasSubstr("WPos:-90.000,0.000,0.000|FS:0,0|WCO:100.000,0.000,0.000"));
}

TEST_F(GrblEeprom, ForgetsG92AndTheToolLengthWhenItIsReset) {
    for (const char* line : {"G92 X5", "G43.1 Z3"}) {
        grbl.receive(std::string(line) + "\n");
        grbl.advance(0.05);
    }
    grbl.receive("\x18");
    (void)grbl.take_output();
    grbl.receive("$#\n");
    grbl.advance(0.1);
    const std::string offsets = grbl.take_output();
    EXPECT_THAT(offsets, HasSubstr("[G92:0.000,0.000,0.000]"));
    EXPECT_THAT(offsets, HasSubstr("[TLO:0.000]"));
}

} // namespace
} // namespace millwright::emulators
