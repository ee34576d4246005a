// P4, F1: files of commands, as the thesis had one.
#include "core/pmac/driver/pmac_file.h"

#include "tests/core/pmac/emulator/pmac_card.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::pmac {
namespace {

using testing::HasSubstr;

/// One motor's part of the thesis's file, with the last line unended.
const std::string ini =
    "#1->120X\r\nI3=1\nI4=0\nI9=0\nCLOSE\nDELETE GATHER\nDELETE TRACE\nDELETE STIMULUS\n\n"
    "I125=$13C000\nM36->X:$C000,22\nM39->X:$C000,23\nI102=49155\nI169=6553\nI103=1824\n"
    "I900=5\nI900=1\nI129=-996\nM39->X:$3,15\nI111=0\nI112=8388607\ni130=701\nI131=795\n"
    "I119=0.015625\nI120=0\nI121=50\nI122=0.2\nI902=10\nI903=0\nI123=5\nI126=0";

TEST(PmacFileP4, IsTakenWholeWithItsLastLine) {
    const PmacFile file = read_pmac_file(ini, "pmac.ini");
    EXPECT_EQ(file.lines.size(), 27u); // three of the hand-shake and an empty one are left out
    EXPECT_EQ(file.lines.back().text, "I126=0");
    EXPECT_EQ(file.lines.front().text, "#1->120X");
    test::PmacCard pmac;
    for (const PmacFile::Line& line : file.lines) {
        EXPECT_EQ(pmac.ask(line.text), "") << line.text;
    }
    EXPECT_EQ(pmac.card.variable('I', 125), 0x13C000);
    EXPECT_EQ(pmac.card.variable('I', 900), 1.0); // the last value counts
    EXPECT_EQ(pmac.card.variable('I', 129), -996.0);
    EXPECT_EQ(pmac.card.variable('I', 130), 701.0);
    EXPECT_EQ(pmac.card.variable('I', 169), 6553.0);
}

// The buffer was taken as open to the end of the file, so that jogs passed as its lines.
TEST(PmacFile, ABufferOnOneLineEndsOnIt) {
    const PmacFile file =
        read_pmac_file("OPEN PLC 5 CLEAR P1=3 CLOSE #1J:9\n#1J:5\nCLOSE\nI130=5\n", "a.ini");
    std::vector<std::string> sent;
    for (const PmacFile::Line& line : file.lines) {
        sent.push_back(line.text);
    }
    EXPECT_EQ(sent, (std::vector<std::string>{"OPEN PLC 5", "CLEAR", "P1=3", "CLOSE", "CLOSE", "I130=5"}));
    EXPECT_EQ(file.left_out, 2);
    ASSERT_EQ(file.omissions.size(), 2u);
    EXPECT_THAT(to_text(file.omissions.front()), HasSubstr("a.ini:1:1: #1J:9 is skipped"));
    EXPECT_THAT(to_text(file.omissions.back()), HasSubstr("a.ini:2:1: #1J:5 is skipped"));
}

TEST(PmacFile, ASecondOpenIsRefusedWithItsPlace) {
    try {
        (void)read_pmac_file("OPEN PLC 5\nCLEAR\nP4=9\nOPEN PLC 6\nCLOSE\n", "a.ini");
        FAIL() << "it was read";
    } catch (const Error& error) {
        EXPECT_EQ(
            to_text(error.diagnostic()),
            "a.ini:4:1: 'OPEN PLC 6' is rejected: ERR007, a buffer is already open (write CLOSE before it: "
            "'OPEN PLC 5' is not closed)");
    }
}

TEST(PmacFile, AJogBetweenOpenAndCloseIsRefusedWithItsPlace) {
    try {
        (void)read_pmac_file("OPEN PROG 3\nCLEAR\n#1J:700\nCLOSE\n", "a.ini");
        FAIL() << "it was read";
    } catch (const Error& error) {
        EXPECT_THAT(to_text(error.diagnostic()), HasSubstr("a.ini:3:1: '#1J:700' is no line of a program"));
    }
}

TEST(PmacFileF1, AByteOrderMarkIsSkipped) {
    const PmacFile file = read_pmac_file("\xEF\xBB\xBFI130=5\nI131=6\n", "a.ini");
    ASSERT_EQ(file.lines.size(), 2u);
    EXPECT_EQ(file.lines.front().text, "I130=5");
}

TEST(PmacFileF1, WarnsOfEachProtectionThatIsOff) {
    const PmacFile file = read_pmac_file(ini, "pmac.ini");
    std::string all;
    for (const Diagnostic& warning : file.warnings) {
        all += to_text(warning) + "\n";
    }
    EXPECT_THAT(all, HasSubstr("I111=0: a following error does not stop motor 1"));
    EXPECT_THAT(all, HasSubstr("pmac.ini:10:1: I125 bit 16: motor 1: its amplifier is never disabled"));
    EXPECT_THAT(all, HasSubstr("I125 bit 17: motor 1: its limit switches are ignored"));
    EXPECT_THAT(all, HasSubstr("I125 bit 20: motor 1: a fault of its amplifier"));
    EXPECT_EQ(file.warnings.size(), 4u);
    ASSERT_EQ(file.omissions.size(), 3u);
    EXPECT_THAT(to_text(file.omissions.front()), HasSubstr("I3=1 is skipped"));
    EXPECT_EQ(file.left_out, 0);
    EXPECT_TRUE(read_pmac_file("I125=$C000\nI111=0\nI111=32000\n", "safe.ini").warnings.empty());
}

TEST(PmacFileF1, TakesNoFlagsFromANumberThatIsNoWord) {
    for (const auto& line : {"I225=" + std::string(80, '4'), std::string("I130=2000000000000")}) {
        try {
            (void)read_pmac_file("I100=1\n" + line, "a.ini");
            FAIL() << line;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(),
                        HasSubstr("a.ini:2:1: '" + line + "': settings of the card have at most"));
        }
    }
}

// The card would take FROBNICATE letter by letter: F, then R, which runs a program.
TEST(PmacFileF1, LeavesOutWhatSetsNothing) {
    const PmacFile file = read_pmac_file("I100=1\nFROBNICATE=3\n#1J+\n$$$\n&1B1R\nHM\nA\nm36->X:$C000,22\n&1#"
                                         "2->222Y\nI130..133=5\nWY:$724,$5007F0\n"
                                         "OPEN PROG 1 CLEAR\nX10\nDWELL5\nCLOSE\nX10\n",
                                         "a.ini");
    EXPECT_EQ(file.left_out, 7);
    ASSERT_EQ(file.omissions.size(), 7u);
    EXPECT_THAT(to_text(file.omissions.front()),
                HasSubstr("a.ini:2:1: FROBNICATE=3 is skipped: it does not set anything"));
    EXPECT_EQ(file.omissions.back().place.line, 16);
    EXPECT_TRUE(file.warnings.empty());
    EXPECT_EQ(file.lines.size(), 10u); // OPEN and CLEAR are two
}

TEST(PmacFileP4, TellsWhatTheCardWouldRollOver) {
    const PmacFile file = read_pmac_file("I169=40000\nI100=2\nI8=0", "a.ini");
    ASSERT_EQ(file.warnings.size(), 2u);
    EXPECT_THAT(to_text(file.warnings[0]),
                HasSubstr("a.ini:1:1: I169=40000: the card wraps this value around"));
    EXPECT_THAT(to_text(file.warnings[1]), HasSubstr("a.ini:2:1"));
    EXPECT_TRUE(read_pmac_file("; only words\n\n   \n", "a.ini").lines.empty());
    try {
        (void)read_pmac_file("I100=1\nJ\x0B+\n", "a.ini");
        FAIL();
    } catch (const Error& refused) {
        EXPECT_EQ(refused.diagnostic().place.line, 2);
        EXPECT_EQ(refused.diagnostic().place.column, 2);
    }
}

} // namespace
} // namespace millwright::pmac
