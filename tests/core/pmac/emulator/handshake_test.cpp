// P2, P3: what an emulated PMAC answers, byte by byte, after the manual's tables of I3, I4 and I6.
#include "tests/core/pmac/emulator/pmac_card.h"

#include <gtest/gtest.h>

#include <array>

namespace millwright::pmac {
namespace {

using test::PmacCard;

TEST(PmacHandshakeP2, SaysWhatEachModeOfI3Says) {
    struct Case {
        std::string mode, accepted, data;
    };
    const std::array<Case, 4> cases{{{"0", "", "25\r50\r75\r"},
                                     {"1", "\n", "\n25\r\n50\r\n75\r\n"},
                                     {"2", "\x06", "25\r50\r75\r\x06"},
                                     {"3", "\x06", "\n25\r\n50\r\n75\r\x06"}}};
    for (const Case& one : cases) {
        PmacCard pmac;
        (void)pmac.raw("P1=25 P2=50 P3=75");
        (void)pmac.raw("I3=" + one.mode);
        EXPECT_EQ(pmac.raw("P4=1"), one.accepted) << one.mode;
        EXPECT_EQ(pmac.raw("P1..3"), one.data) << one.mode;
    }
}

TEST(PmacHandshakeP2, SaysWhatEachModeOfI6SaysToAnError) {
    struct Case {
        std::string i3, i6, said;
    };
    const std::array<Case, 6> cases{{{"1", "3", "\a\r\nERR003\r"},
                                     {"2", "1", "\aERR003\r"},
                                     {"2", "3", "\a\rERR003\r"},
                                     {"3", "1", "\a\nERR003\r"},
                                     {"0", "0", "\a"},
                                     {"1", "2", "\a"}}};
    for (const Case& one : cases) {
        PmacCard pmac;
        (void)pmac.raw("I3=" + one.i3 + " I6=" + one.i6);
        EXPECT_EQ(pmac.raw("garbage"), one.said) << one.i3 << " " << one.i6;
    }
}

TEST(PmacHandshakeP3, AnswersTheSequencesOfTheThesis) {
    PmacCard pmac;
    EXPECT_EQ(pmac.raw("#1J+"), "\n");
    EXPECT_EQ(pmac.raw("#1P"), "\n0\r\n");
    EXPECT_EQ(pmac.raw("garbage"), "\a\r\nERR003\r");
    const std::string probe = pmac.raw("RHL:$720"); // the presence test counts 12 to 16 characters
    EXPECT_EQ(probe.size(), 1u + 12u + 1u + 1u);
}

TEST(PmacHandshakeP2, AddsTheSumsOfI4) {
    PmacCard pmac;
    pmac.card.receive("J+\x0E");
    EXPECT_EQ(pmac.card.take_output(), std::string(1, static_cast<char>(117))); // the manual's own examples
    pmac.card.receive("\x18J/\x0E\x18");
    EXPECT_EQ(pmac.card.take_output(), "");
    pmac.card.receive("J/\x0E");
    EXPECT_EQ(pmac.card.take_output(), std::string(1, static_cast<char>(121)));
    (void)pmac.raw("");
    (void)pmac.raw("I4=1");
    EXPECT_EQ(pmac.raw("J/"), "\n" + std::string(1, static_cast<char>(121)));
    const std::string answer = "\n1\r"; // of I4 itself; its sum, the end, the command's sum
    EXPECT_EQ(pmac.raw("I4"),
              answer + static_cast<char>('\n' + '1' + '\r') + "\n" + static_cast<char>('I' + '4'));
}

TEST(PmacHandshakeP2, TakesControlCharactersInTheMiddleOfALine) {
    PmacCard pmac;
    pmac.card.receive("P1=2");
    EXPECT_EQ(pmac.control('\x10'), "0 0 0 0 0 0 0 0");
    pmac.card.receive("5\r");
    (void)pmac.card.take_output();
    EXPECT_EQ(pmac.ask("P1"), "25");
    pmac.card.receive("P1=77\b\b8\r"); // ^H takes characters back
    (void)pmac.card.take_output();
    EXPECT_EQ(pmac.ask("P1"), "8");
    pmac.card.receive("P1=P1+1\rP2=\t"); // ^I repeats the last line at once
    (void)pmac.card.take_output();
    pmac.card.receive("3\r");
    (void)pmac.card.take_output();
    EXPECT_EQ(pmac.ask("P1"), "10");
    EXPECT_EQ(pmac.ask("P2"), "3");
    pmac.card.receive("P2=0\rP2=\x18P3=4\r"); // ^X forgets the line
    (void)pmac.card.take_output();
    EXPECT_EQ(pmac.ask("P2"), "0");
    EXPECT_EQ(pmac.ask("P3"), "4");
}

TEST(PmacHandshakeP2, RefusesBytesThatAreNoText) {
    PmacCard pmac;
    EXPECT_EQ(pmac.raw("P1=\xC3\xA4"), "\a\r\nERR004\r");
    EXPECT_EQ(pmac.raw(std::string(300, 'J')), "\a\r\nERR003\r");
    EXPECT_EQ(pmac.ask("P1"), "0");
}

TEST(PmacHandshakeP3, KnowsItsVariables) {
    PmacCard pmac;
    EXPECT_EQ(pmac.send("I130=16777217"), ""); // words of 24 bits roll over
    EXPECT_EQ(pmac.ask("I130"), "1");
    EXPECT_EQ(pmac.send("I130=-5 I112=8388607"), "");
    EXPECT_EQ(pmac.ask("I130"), "-5");
    EXPECT_EQ(pmac.ask("I112"), "8388607");
    EXPECT_EQ(pmac.ask("I125"), "$C000"); // I9=2
    EXPECT_EQ(pmac.send("I9=0"), "");
    EXPECT_EQ(pmac.ask("I125"), "49152");
    EXPECT_EQ(pmac.ask("I102"), "49155");
    EXPECT_EQ(pmac.send("I9=3"), "");
    EXPECT_EQ(pmac.ask("I125"), "I125=$C000");
    EXPECT_EQ(pmac.send("I9=0\nI3=5"), ""); // rolls over
    EXPECT_EQ(pmac.ask("I3"), "1");
    EXPECT_EQ(pmac.send("I130=701\nI130=*"), "");
    EXPECT_EQ(pmac.ask("I130"), "2000");
    EXPECT_EQ(pmac.send("7.25"), "");
    EXPECT_EQ(pmac.ask("P0"), "7.25");
    EXPECT_EQ(pmac.send("p1=2 q1=3\nP2=(P1+Q1)*4-SQRT(16)/2&3"), "");
    EXPECT_EQ(pmac.ask("P2"), "18");
    EXPECT_EQ(pmac.ask("P1024"), "ERR003");
    EXPECT_EQ(pmac.ask("P1=5/0"), "");
    EXPECT_EQ(pmac.ask("P1"), "0");
}

TEST(PmacHandshakeP3, PointsMVariablesIntoMemory) {
    PmacCard pmac;
    EXPECT_EQ(pmac.ask("M151->"), "*");
    EXPECT_EQ(pmac.send("M151->DP:$D201\nM154->Y:$D200,0\nM155->X:$D200,0"), "");
    EXPECT_EQ(pmac.ask("M151->"), "DP:$D201");
    EXPECT_EQ(pmac.ask("M154->"), "Y:$D200,0");
    pmac.card.set_shared_32(0x0804, -123456);
    EXPECT_EQ(pmac.ask("M151"), "-123456");
    EXPECT_EQ(pmac.send("M151=98765\nM154=1 M155=1"), "");
    EXPECT_EQ(pmac.card.shared_32(0x0804), 98765);
    EXPECT_EQ(pmac.card.shared_16(0x0800), 1);
    EXPECT_EQ(pmac.card.shared_16(0x0802), 1);
    EXPECT_EQ(pmac.send("M5->X:$C000,20,4"), "");
    EXPECT_EQ(pmac.ask("M5"), "1"); // home flag, no limits, no fault
    EXPECT_EQ(pmac.send("M5->*\nM5=3"), "");
    EXPECT_EQ(pmac.ask("M5"), "3");
    EXPECT_EQ(pmac.ask("M5->X:$C000,20,9"), "ERR003");
    EXPECT_EQ(pmac.send("WX:$786,$D,$43"), "");
    EXPECT_EQ(pmac.ask("RHX:$786,2"), "00000D|000043");
}

TEST(PmacHandshakeP3, ReportsStatusAsInTheManual) {
    PmacCard pmac;
    // the manual's own worked reply: activated, integration mode, desired velocity zero; of C.S. 1,
    // amplifier enabled, home complete, in position
    EXPECT_EQ(pmac.send("#1->120X\n#1J/\n#1HMZ"), "");
    pmac.card.advance(0.5);
    EXPECT_EQ(pmac.ask("#1?"), "812000804401");
    EXPECT_EQ(pmac.send("K"), "");
    pmac.card.advance(0.5);
    EXPECT_EQ(pmac.ask("?"), "850000800400"); // open loop
    EXPECT_EQ(pmac.ask("#2?"), "010000000000");
    EXPECT_EQ(pmac.ask("???").size(), 12u);
    EXPECT_EQ(pmac.ask("??").size(), 12u);
    EXPECT_EQ(pmac.ask("&2??"), "A80020000000"); // X Y Z in the feed, circle vectors incremental
}

TEST(PmacHandshakeP3, TellsInBinaryWhatIsGathered) {
    PmacCard pmac;
    EXPECT_EQ(pmac.control('\x05'), ""); // I20 chooses nothing
    ASSERT_EQ(pmac.send("WY:$D300,$123456\nWX:$D300,$ABCDEF\nWY:$D301,$000001"), "");
    ASSERT_EQ(pmac.send("I20=$B I21=$D300 I22=$40D300 I23=$D300 I24=$80D300"), "");
    EXPECT_EQ(pmac.ask("I22"), "$40D300");
    pmac.card.receive("P1=4\x05");
    EXPECT_EQ(pmac.card.take_output(), "\x12\x34\x56\xAB\xCD\xEF\xAB\xCD\xEF\x12\x34\x56");
    pmac.card.receive("2\r"); // the line goes on
    EXPECT_EQ(pmac.card.take_output(), "\n");
    EXPECT_EQ(pmac.ask("P1"), "42");
}

TEST(PmacHandshakeP3, RepeatsWhatItGetsInFullDuplex) {
    PmacCard pmac;
    (void)pmac.raw("P1=5");
    pmac.card.receive("\x14");
    EXPECT_EQ(pmac.card.take_output(), "");
    EXPECT_EQ(pmac.raw("P1"), "P1\r\n5\r\n");
    EXPECT_EQ(pmac.raw("garbage"), "garbage\r\a\r\nERR003\r");
    pmac.card.receive("\x14");
    EXPECT_EQ(pmac.raw("P1"), "\n5\r\n");
    pmac.card.receive("\x14");
    pmac.card.power_cycle();
    EXPECT_EQ(pmac.raw("I3"), "\n1\r\n"); // a card that starts is in half duplex
}

TEST(PmacHandshakeP3, TakesALineFromTheSharedMemory) {
    PmacCard pmac;
    const std::string line = "P1=25 P1";
    for (std::size_t n = 0; n < line.size(); n += 2) {
        const auto letters = static_cast<std::uint16_t>(line[n] | line[n + 1] << 8);
        pmac.card.set_shared_16(0x0630 + static_cast<int>(n), letters);
    }
    pmac.card.receive("\x17");
    EXPECT_EQ(pmac.card.take_output(), "\n25\r\n");
    pmac.card.set_shared_16(0x0630, 'X' | '1' << 8);
    pmac.card.set_shared_16(0x0632, 0);
    pmac.card.receive("\x17");
    EXPECT_EQ(pmac.card.take_output(), "\a\r\nERR005\r");
}

TEST(PmacHandshakeP3, AnswersTheCommandsOfTheThesis) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send(test::arm_axes + test::arm_program), "");
    const std::array<const char*, 58> accepted{"@",
                                               "@0",
                                               "#",
                                               "#2",
                                               "&",
                                               "&1",
                                               "SIZE",
                                               "LIST PROG 1",
                                               "LIST PLC 1",
                                               "ENABLE PLC 1",
                                               "DISABLE PLC 1,2",
                                               "12",
                                               "I130=2000",
                                               "I130=*",
                                               "P1=1",
                                               "M1=1",
                                               "M1->",
                                               "M1->*",
                                               "I130",
                                               "P1",
                                               "M1",
                                               "#1->",
                                               "#1->150X+10",
                                               "??",
                                               "%50",
                                               "%",
                                               "%100",
                                               "ZZ",
                                               "B1",
                                               "B1.0",
                                               "H",
                                               "A",
                                               "Q",
                                               "Z",
                                               "INC",
                                               "ABS(X,Y)",
                                               "FRAX(X,Y)",
                                               "$",
                                               "HMZ",
                                               "HOMEZ",
                                               "J/",
                                               "J=",
                                               "J=100",
                                               "J:100",
                                               "P",
                                               "V",
                                               "F",
                                               "?",
                                               "???",
                                               "HM",
                                               "K",
                                               "J+",
                                               "J-",
                                               "S",
                                               "R",
                                               "P1..3",
                                               "CLOSE",
                                               "TYPE"};
    for (const char* const line : accepted) {
        EXPECT_NE(pmac.raw(line).find('\n'), std::string::npos) << line;
        EXPECT_EQ(pmac.ask(line).find("ERR"), std::string::npos) << line;
        pmac.card.receive("\x01"); // nothing of it shall be in the way of the next
        pmac.card.advance(3.0);
        (void)pmac.card.take_output();
    }
    for (const char character : std::string("\x02\x03\x06\x07\x10\x16")) {
        EXPECT_NE(pmac.control(character), "") << static_cast<int>(character);
    }
    for (const char character : std::string("\x0F\x11\x12\x13\x01\x0B")) { // they act, and say nothing
        EXPECT_EQ(pmac.control(character), "") << static_cast<int>(character);
    }
    EXPECT_EQ(pmac.ask("#1?").substr(8, 1), "0"); // of a killed motor
    EXPECT_EQ(pmac.ask("OPEN ROT"), "");
    EXPECT_EQ(pmac.ask("CLOSE"), "");
    EXPECT_EQ(pmac.ask("OPEN PROG 7"), "");
    EXPECT_EQ(pmac.ask("CLEAR"), "");
    EXPECT_EQ(pmac.ask("SIZE").front(), '-'); // while a buffer is open
    EXPECT_EQ(pmac.ask("CLOSE"), "");
    EXPECT_EQ(pmac.ask("UNDEFINE"), "");
    EXPECT_EQ(pmac.ask("#1->"), "0");
}

TEST(PmacHandshakeP3, RefusesWithTheManualsNumbers) {
    PmacCard pmac;
    EXPECT_EQ(pmac.ask("X1000"), "ERR005");
    EXPECT_EQ(pmac.ask("CLEAR"), "ERR005");
    EXPECT_EQ(pmac.ask("B1R"), "ERR014"); // no motors
    EXPECT_EQ(pmac.send(test::arm_axes), "");
    EXPECT_EQ(pmac.ask("B9R"), "ERR015");
    EXPECT_EQ(pmac.send(test::arm_program), "");
    EXPECT_EQ(pmac.send("#1K"), "");
    EXPECT_EQ(pmac.ask("B1R"), "ERR012");
    EXPECT_EQ(pmac.send("#1J/\nI400=0"), "");
    EXPECT_EQ(pmac.ask("B1R"), "ERR013");
    EXPECT_EQ(pmac.send("I400=1\n#4J/"), "");
    EXPECT_EQ(pmac.ask("OPEN PROG 3"), "");
    EXPECT_EQ(pmac.ask("OPEN PROG 4"), "ERR007");
    EXPECT_EQ(pmac.send("CLEAR\nWHILE(P1=0)\nX1"), "");
    EXPECT_EQ(pmac.ask("CLOSE"), "ERR009");
    EXPECT_EQ(pmac.ask("B3R"), "ERR016");
    EXPECT_EQ(pmac.ask("B1R"), "");
    for (const char* const refused : {"#1K", "#1J+", "#1HM", "OPEN PROG 1", "#1->10X", "B2", "#1J=5"}) {
        EXPECT_EQ(pmac.ask(refused), "ERR001") << refused;
    }
    EXPECT_EQ(pmac.ask("&2#1->10X"), "ERR003"); // of another coordinate system
}

} // namespace
} // namespace millwright::pmac
