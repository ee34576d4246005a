// Lines that a person types while the driver is connected to the emulated card, in computed time.
#include "core/pmac/driver/internal/command_kind.h"
#include "tests/core/pmac/driver/pmac_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::pmac::internal {
namespace {

using test::jog_of;
using test::long_x_feed;
using test::PmacWire;
using test::refusal;
using testing::HasSubstr;

TEST(PmacTypedLines, TakesCommandsAndTellsTheCardsErrors) {
    PmacWire wire;
    const auto ask = [&](const std::vector<std::string>& lines, bool all = false) {
        (void)wire.session.command(lines, all);
        EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
        return wire.session.status().answer;
    };
    EXPECT_EQ(ask({"#2P", "&1?"}).text.substr(0, 2), "0\n");
    EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::done);
    EXPECT_EQ(ask({"#"}).text, "2"); // the person's own address, whatever was asked meanwhile
    const drivers::CommandAnswer refused = ask({"P1=4", "UNKNOWN", "P1=5"});
    EXPECT_EQ(refused.state, drivers::CommandAnswer::State::refused);
    EXPECT_THAT(refused.text, HasSubstr("ERR003, no such command"));
    EXPECT_EQ(wire.card.variable('P', 1), 4.0);
    EXPECT_THAT(ask({"OPEN PROG 3", "CLEAR", "X1", "CLOSE", "UNKNOWN", "P1=6"}, true).text,
                HasSubstr("'UNKNOWN' is rejected"));
    EXPECT_EQ(wire.card.variable('P', 1), 6.0);
    EXPECT_NE(refusal([&] { (void)wire.session.command({"J\x01+"}, false); }), "");
}

TEST(PmacTypedLines, FillABufferLineByLine) {
    PmacWire wire;
    const auto ask = [&](const std::string& line) {
        (void)wire.session.command({line}, false);
        EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
        return wire.session.status().answer;
    };
    EXPECT_EQ(ask("OPEN PLC 5").text, "OPEN PLC 5: 0 lines are kept until CLOSE");
    (void)ask("CLEAR");
    EXPECT_EQ(ask("P20=P20+1").text, "OPEN PLC 5: 2 lines are kept until CLOSE");
    const std::vector<drivers::ConsoleLine> shown = wire.session.take_console();
    ASSERT_FALSE(shown.empty());
    EXPECT_EQ(shown.back().text, "P20=P20+1: not yet sent; OPEN PLC 5: 2 lines are kept until CLOSE");
    EXPECT_EQ(shown.back().kind, drivers::ConsoleKind::message); // shown with the status reports off, too
    EXPECT_EQ(ask("#1P").text, "0") << "a question is answered at once";
    EXPECT_NE(refusal([&] { (void)wire.session.command({"I5=0"}, false); }), "");
    EXPECT_EQ(ask("LIST PLC 5").text, "OPEN PLC 5: 3 lines are kept until CLOSE");
    for (const char* const line : {"CLEAR", "P20=P20+1", "DISABLE PLC 5"}) {
        EXPECT_EQ(ask(line).state, drivers::CommandAnswer::State::done) << line;
    }
    EXPECT_EQ(wire.card.variable('P', 20), 0.0) << "nothing is sent before CLOSE";
    EXPECT_EQ(ask("CLOSE").state, drivers::CommandAnswer::State::done);
    EXPECT_TRUE(wire.session.kept_lines().empty());
    EXPECT_THAT(ask("LIST PLC 5").text, HasSubstr("P20=P20+1"));
    (void)ask("ENABLE PLC 5");
    EXPECT_TRUE(wire.run_until([&] { return wire.card.variable('P', 20) > 0.0; }, 3.0));
}

// The lines of the first buffer were lost.
TEST(PmacTypedLines, ASecondOpenIsRefusedAndTheFirstBufferIsKept) {
    PmacWire wire;
    const auto ask = [&](const std::vector<std::string>& lines) {
        (void)wire.session.command(lines, false);
        EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
        return wire.session.status().answer;
    };
    (void)ask({"OPEN PLC 5"});
    (void)ask({"CLEAR"});
    (void)ask({"P4=9"});
    const auto reason = [&](const std::vector<std::string>& lines, bool file) {
        return refusal([&] { (void)wire.session.command(lines, file); });
    };
    for (const std::vector<std::string>& lines : std::vector<std::vector<std::string>>{
             {"OPEN PLC 6"}, {"open plc5 clear"}, {"P5=1", "OPEN ROT"}, {"OPEN PLC 6 CLEAR P5=1 CLOSE"}}) {
        EXPECT_THAT(reason(lines, false), HasSubstr("ERR007, a buffer is already open")) << lines.front();
        EXPECT_THAT(reason(lines, false), HasSubstr("'OPEN PLC 5' is not closed")) << lines.front();
    }
    EXPECT_THAT(reason({"I130=3000"}, true), HasSubstr("while a buffer is open"));
    EXPECT_EQ(wire.session.kept_lines(), (std::vector<std::string>{"OPEN PLC 5", "CLEAR", "P4=9"}));
    EXPECT_EQ(ask({"CLOSE"}).state, drivers::CommandAnswer::State::done);
    EXPECT_THAT(ask({"LIST PLC 5"}).text, HasSubstr("P4=9"));
    EXPECT_THAT(reason({"OPEN PLC 6", "CLEAR", "OPEN PLC 7", "CLOSE"}, true), HasSubstr("ERR007"));
}

// The card moved motors without a word: the rule of power looks at no line that is stored.
TEST(PmacTypedLines, AJogBetweenOpenAndCloseIsRefused) {
    PmacWire wire;
    for (const char* line : {"#1J:700", "#1HM", " j = 5", "A", "K", "B1R", "&1R", "HM"}) {
        for (const bool file : {false, true}) {
            EXPECT_THAT(refusal([&] {
                            (void)wire.session.command({"OPEN PROG 3", "CLEAR", line, "CLOSE"}, file);
                        }),
                        HasSubstr("would act on it at once"))
                << line;
        }
    }
    EXPECT_THAT(refusal([&] { (void)wire.session.command({"OPEN PROG 3 CLEAR #1J:700 CLOSE"}, false); }),
                HasSubstr("#1J:700"));
    for (const char* line : {"A10 B5", "HOME1", "X10 Y(P1)", "SPLINE1", "K2 J3", "CMD\"#1J/\"", "S500"}) {
        EXPECT_NO_THROW((void)wire.session.command({"OPEN PROG 3", "CLEAR", line}, false)) << line;
        EXPECT_NO_THROW((void)wire.session.command({"CLOSE"}, false)) << line;
        EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
    }
}

// It waited for a CLOSE that had come, or P1=3 was executed.
TEST(PmacTypedLines, ABufferOnOneLineIsReadAsTheCardReadsIt) {
    PmacWire wire;
    const auto ask = [&](const std::vector<std::string>& lines) {
        (void)wire.session.command(lines, false);
        EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
        return wire.session.status().answer;
    };
    EXPECT_EQ(ask({"OPEN PLC 5 CLEAR P21=3 CLOSE"}).state, drivers::CommandAnswer::State::done);
    EXPECT_EQ(ask({"LIST PLC 5"}).text, "P21=3");
    (void)ask({"P22=4 close open plc 6 clr"}); // what stands before OPEN is executed
    EXPECT_EQ(wire.card.variable('P', 22), 4.0);
    EXPECT_EQ(ask({"P21=5"}).text, "OPEN plc 6: 2 lines are kept until CLOSE");
    EXPECT_EQ(ask({"CMD\"CLOSE\" P21=6 CLS P22=7"}).state, drivers::CommandAnswer::State::done);
    EXPECT_EQ(wire.card.variable('P', 22), 7.0); // behind CLOSE
    EXPECT_EQ(ask({"LIST PLC 6"}).text, "P21=5\nCMD\"CLOSE\"P21=6");
    EXPECT_EQ(wire.card.variable('P', 21), 0.0) << "stored, not executed";
    EXPECT_THAT(refusal([&] { (void)wire.session.command({"OPEN PLC 31 CLEAR CLOSE"}, false); }),
                HasSubstr("guard"));
}

// The lines of the buffer were executed, with HOME1 among them.
TEST(PmacTypedLines, ABufferThatTheCardDoesNotOpenIsSkipped) {
    PmacWire wire({}, false);
    (void)wire.session.load({"OPEN PROG 40000", "CLEAR", "P21=3", "HOME1", "CLOSE", "P22=4"});
    EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
    EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::refused);
    EXPECT_THAT(wire.session.status().answer.text, HasSubstr("'OPEN PROG 40000' is rejected"));
    EXPECT_EQ(wire.card.variable('P', 21), 0.0);
    EXPECT_EQ(wire.card.variable('P', 22), 4.0);
    EXPECT_FALSE(wire.powered());
}

// What stands behind CLOSE was executed while the program was loaded.
TEST(PmacTypedLines, AProgramStaysInItsBuffer) {
    PmacWire wire;
    for (const std::string line : {"CLOSE", "X1 CLS #1J:500", "OPEN PROG 3", "X2 CLEAR"}) {
        EXPECT_THAT(refusal([&] {
                        wire.session.start({"LINEAR", line, "X3"}, wire.now);
                    }),
                    HasSubstr("opened, cleared and closed automatically"))
            << line;
    }
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
}

// Behind the addresses it was read as a part of the last one.
TEST(PmacTypedLines, ANumberAloneSetsP0) {
    PmacWire wire;
    for (const auto& [line, value] : {std::pair("5", 5.0), std::pair("-2.5", -2.5), std::pair(".5", 0.5)}) {
        (void)wire.session.command({line}, false);
        EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
        EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::done) << line;
        EXPECT_EQ(wire.card.variable('P', 0), value);
    }
    EXPECT_THAT(refusal([&] { (void)wire.session.command({"5P"}, false); }),
                HasSubstr("starts with a number"));
}

bool line_is_answered(PmacWire& wire) {
    return wire.run_until(
        [&] { return wire.session.status().answer.state != drivers::CommandAnswer::State::pending; }, 3.0);
}

// A motor that a command set going is no machine at rest.
TEST(PmacTypedLines, TellsThatACommandMovesAMotorAndAnswersQuestionsMeanwhile) {
    PmacWire wire;
    (void)wire.session.command({"#1J:2400"}, false);
    ASSERT_TRUE(line_is_answered(wire));
    ASSERT_TRUE(wire.run_until([&] { return wire.card.command(1) > 100.0; }, 3.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::running);
    EXPECT_EQ(wire.session.status().activity, drivers::Activity::command);
    EXPECT_NE(refusal([&] { (void)wire.session.command({"#1P", "P1=4"}, false); }), "");
    (void)wire.session.command({"#1P", "#1?"}, false);
    ASSERT_TRUE(line_is_answered(wire));
    EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::done);
    EXPECT_EQ(wire.state(), drivers::DriverState::running);
    EXPECT_LT(wire.card.command(1), 2400.0); // still under way
    ASSERT_TRUE(wire.run_to_end(60.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
    EXPECT_NEAR(wire.card.command(1), 2400.0, 1.0);
}

TEST(PmacTypedLines, StopsWhatACommandSetGoing) {
    for (const std::string line : {"#1J/", "stop()", "#1K", "&1A"}) {
        PmacWire wire;
        (void)wire.session.command({"#1J:9000"}, false);
        ASSERT_TRUE(wire.run_until([&] { return wire.card.command(1) > 100.0; }, 3.0));
        if (line == "stop()") {
            wire.session.stop(wire.now);
        } else {
            (void)wire.session.command({line}, false);
        }
        ASSERT_TRUE(wire.run_to_end(5.0)) << line;
        EXPECT_NE(wire.state(), drivers::DriverState::alarm) << line;
        EXPECT_LT(wire.card.position(1), 2000.0) << line;
        wire.pass(1.0);
        EXPECT_TRUE(wire.standing()) << line;
        EXPECT_EQ(wire.card.enabled(1), line != "#1K") << line;
        EXPECT_TRUE(wire.card.enabled(2)) << line;
    }
}

TEST(PmacTypedLines, AStopThatIsTypedStopsTheProgram) {
    PmacWire wire;
    wire.session.start(long_x_feed, wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.card.command(1) > 100.0; }, 5.0));
    (void)wire.session.command({"P1000"}, false); // a question, meanwhile
    ASSERT_TRUE(line_is_answered(wire));
    EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::done);
    EXPECT_EQ(wire.state(), drivers::DriverState::running);
    (void)wire.session.command({"&1A"}, false);
    ASSERT_TRUE(wire.run_to_end(5.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped);
    EXPECT_TRUE(wire.standing());
}

TEST(PmacTypedLines, TakesNoJogWithoutAnEnd) {
    PmacWire wire;
    for (const std::string line : {"#1J+", "J-", "#2 j +"}) {
        EXPECT_THAT(refusal([&] { (void)wire.session.command({line}, false); }), HasSubstr("without an end"));
    }
    wire.pass(1.0);
    EXPECT_EQ(wire.card.command(1), 0.0);
}

// The usual M-variables of a card: they read a motor, and take no value.
TEST(PmacTypedLines, ReadTheRegistersOfAMotorAndWriteNone) {
    PmacWire wire;
    (void)wire.session.command({"#2J:300"}, false);
    ASSERT_TRUE(wire.run_to_end(10.0));
    (void)wire.session.command({"M261->D:$64", "M262->D:$67", "M239->Y:$8D4,14", "M261", "M262", "M239"},
                               false);
    ASSERT_TRUE(line_is_answered(wire));
    ASSERT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::done)
        << wire.session.status().answer.text;
    const double unit = 32.0 * wire.card.variable('I', 208); // in a count
    EXPECT_NEAR(wire.card.variable('M', 261) / unit, wire.card.command(2), 1e-3);
    EXPECT_NEAR(wire.card.variable('M', 261) / unit, 300.0, 1e-3);
    EXPECT_NEAR(wire.card.variable('M', 262) / unit, 300.0, 3.0);
    EXPECT_EQ(wire.card.variable('M', 239), 1.0); // amplifier enabled
    EXPECT_THAT(refusal([&] { (void)wire.session.command({"M261=0"}, false); }), HasSubstr("for reading"));
    wire.pass(0.5);
    EXPECT_NEAR(wire.card.command(2), 300.0, 1e-9);
}

// What a test of a motor had borrowed is given back.
TEST(PmacTypedLines, SetsVariablesAloneInAnAlarm) {
    PmacWire wire;
    wire.session.emergency_stop(wire.now);
    (void)wire.session.command({"I122=17", "M1023->X:$0,0,24"}, false);
    ASSERT_TRUE(line_is_answered(wire));
    EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::done);
    EXPECT_EQ(wire.card.variable('I', 122), 17.0);
    for (const std::string line : {"#1J/", "#1J:5", "&1A", "#1HM", "I122=17 #1J/"}) {
        EXPECT_THAT(refusal([&] { (void)wire.session.command({line}, false); }), HasSubstr("alarm")) << line;
    }
    wire.pass(0.5);
    EXPECT_EQ(wire.state(), drivers::DriverState::alarm);
    EXPECT_FALSE(wire.powered());
}

TEST(PmacTypedLinesF2, NoneGivesAKilledMotorPower) {
    PmacWire wire({}, false);
    for (const std::vector<std::string>& lines : std::vector<std::vector<std::string>>{
             {"#2J/"}, {"#1J:12"}, {"#3", "J=5"}, {"#1HM"}, {"#4J^0"}, {"OPEN PROG 2", "X1", "CLOSE", "a"}}) {
        EXPECT_THAT(refusal([&] { (void)wire.session.command(lines, false); }), HasSubstr("would enable"))
            << lines.front();
        // The window has a button of that name; options are the command line's business.
        EXPECT_THAT(refusal([&] { (void)wire.session.command(lines, false); }),
                    ::testing::EndsWith("(inspect the machine, then enable its motors)"));
    }
    (void)wire.session.command({"#4->150A", "OPEN PROG 2", "ABS X10A", "HOME1", "CLOSE", "#1HMZ"}, false);
    ASSERT_TRUE(line_is_answered(wire));
    wire.pass(0.5);
    EXPECT_FALSE(wire.powered());
    wire.session.let_lines_give_power();
    (void)wire.session.command({"#1J/"}, false);
    wire.pass(0.5);
    EXPECT_TRUE(wire.card.enabled(1));
}

// A stop was refused, with the advice to give the motors power.
TEST(PmacTypedLinesF2, AStopOfWhatStandsIsDoneAndGivesNoPower) {
    PmacWire wire({}, false);
    for (const std::string line : {"A", "&1A", "H", "Q"}) {
        (void)wire.session.command({line}, false);
        ASSERT_TRUE(line_is_answered(wire)) << line;
        EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::done) << line;
    }
    wire.pass(0.5);
    EXPECT_FALSE(wire.powered());
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
    (void)wire.session.command({"A"}, false);
    EXPECT_THAT(wire.session.status().answer.text, HasSubstr("nothing moves"));
}

TEST(PmacTypedLinesF2, ThatGivePowerAreNotHeldUpByWhatAMotorToldBeforeTheyCame) {
    PmacWire wire({}, false, "XYZA", {}, "I111=1\nI129=3000\n#1J/\n");
    EXPECT_FALSE(wire.card.enabled(1)) << "its following error was too great at once";
    wire.session.let_lines_give_power();
    (void)wire.session.command({"#2J/"}, false);
    wire.pass(0.5);
    EXPECT_TRUE(wire.card.enabled(2));
    EXPECT_NE(wire.state(), drivers::DriverState::alarm);
    (void)wire.session.command({"#1J/"}, false); // and is too great again
    wire.pass(0.5);
    EXPECT_EQ(wire.state(), drivers::DriverState::alarm);
}

TEST(PmacTypedLinesF2, NoneGivesPowerBackBehindAKill) {
    PmacWire wire;
    for (const std::vector<std::string>& lines :
         std::vector<std::vector<std::string>>{{"#1K", "A"}, {"#2K #2J/"}}) {
        EXPECT_THAT(refusal([&] { (void)wire.session.command(lines, false); }), HasSubstr("would enable"));
    }
}

TEST(PmacTypedLinesF2, AStopBrakesWhatMovesAndGivesTheOthersNoPower) {
    PmacWire wire;
    (void)wire.session.command({"#2K"}, false);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
    (void)wire.session.command({"#1J:9000"}, false);
    ASSERT_TRUE(wire.run_until([&] { return wire.card.command(1) > 100.0; }, 3.0));
    (void)wire.session.command({"&1A"}, false);
    ASSERT_TRUE(wire.run_to_end(5.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped) << wire.session.status().message;
    EXPECT_LT(wire.card.position(1), 2000.0);
    wire.pass(0.5);
    EXPECT_TRUE(wire.standing());
    EXPECT_FALSE(wire.card.enabled(2));
}

// A following error that ended an earlier motion stays in the motor's status.
TEST(PmacTypedLines, AnOldFaultOfAMotorIsNoNews) {
    PmacWire wire;
    (void)wire.session.command({"I111=16"}, false); // a count
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
    wire.session.jog(jog_of(0, 5.0, 5.0), wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 3.0));
    wire.pass(0.2);
    wire.session.reset(wire.now);
    for (const std::string line : {"I111=32000", "#1->120X", "P1"}) {
        (void)wire.session.command({line}, false);
        wire.pass(0.5);
        EXPECT_EQ(wire.state(), drivers::DriverState::idle) << line << ": " << wire.session.status().message;
    }
    EXPECT_FALSE(wire.powered());
}

TEST(PmacTypedLines, TakesNoControlCharacterByItsName) {
    PmacWire wire;
    for (const bool moving : {false, true}) {
        if (moving) {
            (void)wire.session.command({"#1J:9000"}, false);
            ASSERT_TRUE(wire.run_until([&] { return wire.card.command(1) > 100.0; }, 3.0));
        }
        for (const std::string line : {"^R", "^O", "^A #1J:5", "^KR"}) {
            EXPECT_THAT(refusal([&] { (void)wire.session.command({line}, false); }),
                        HasSubstr("control character"));
        }
    }
}

TEST(PmacTypedLines, OpensNoLoop) {
    PmacWire wire;
    for (const std::string line : {"#1O5", "O-0.5", "#2 o 50", "#1O(P1)", "#1O0.01"}) {
        EXPECT_THAT(refusal([&] { (void)wire.session.command({line}, false); }), HasSubstr("in open loop"))
            << line;
    }
    for (const std::string line : {"#1O0", "OPEN PROG 7", "GOTO5", "CLOSE"}) {
        EXPECT_FALSE(opens_loop(line)) << line;
    }
    wire.pass(1.0);
    EXPECT_EQ(wire.card.position(1), 0.0);
}

TEST(PmacTypedLines, LoadsNoSettingsWhileAMotorHasPower) {
    PmacWire wire;
    EXPECT_THAT(refusal([&] { (void)wire.session.load({"I130=3000"}); }), HasSubstr("are enabled"));
    (void)wire.session.command({"#1K#2K#3K"}, false);
    ASSERT_TRUE(line_is_answered(wire));
    EXPECT_THAT(refusal([&] { (void)wire.session.load({"I130=3000"}); }), HasSubstr("are enabled"));
    (void)wire.session.command({"#4K"}, false);
    ASSERT_TRUE(line_is_answered(wire));
    wire.pass(0.5);
    (void)wire.session.load({"I130=3000"});
    ASSERT_TRUE(line_is_answered(wire));
    EXPECT_EQ(wire.card.variable('I', 130), 3000.0);
}

TEST(PmacTypedLines, AMotorThatGoesWhereNobodySentItLosesItsPower) {
    PmacWire wire;
    (void)wire.session.command({"I111=0", "I130=-2000", "I129=10"}, false); // the loop's sign is wrong
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 5.0));
    EXPECT_EQ(wire.session.status().message, "X is enabled and moves without a command");
    EXPECT_LT(std::abs(wire.degrees(0)), 10.0);
    wire.pass(1.0);
    EXPECT_FALSE(wire.powered());
}

TEST(PmacTypedLines, TellsThePersonsLinesWithTheirAnswers) {
    PmacWire wire;
    (void)wire.session.take_console();
    (void)wire.session.command({"I122", "#1P"}, false);
    ASSERT_TRUE(line_is_answered(wire));
    (void)wire.session.command({"FOO"}, false);
    ASSERT_TRUE(line_is_answered(wire));
    std::vector<std::string> texts;
    for (const drivers::ConsoleLine& line : wire.session.take_console()) {
        if (line.kind != drivers::ConsoleKind::query && line.kind != drivers::ConsoleKind::report) {
            texts.push_back((line.sent ? "> " : "") + line.text);
        }
    }
    EXPECT_THAT(texts, testing::IsSupersetOf({"> I122", "32", "> #1P", "> FOO"}));
    EXPECT_THAT(texts, testing::Contains(HasSubstr("ERR003, no such command")));
}

TEST(PmacCommandKind, QuestionsChangeNothing) {
    for (const std::string_view line : {"#1P",
                                        "P",
                                        "#1?",
                                        "&1??",
                                        "???",
                                        "#1P M1023",
                                        "I122 I123",
                                        "#12 V #3F",
                                        " Q5 ",
                                        "#1p",
                                        "I122..422",
                                        "P1..4"}) {
        EXPECT_TRUE(only_asks(line)) << line;
    }
    for (const std::string_view line :
         {"", " ", "#1", "P1=4", "#1J/", "M1->X:0", "I122=3", "#1PK", "K", "1P", "P1 A", "TYPE", "#1J:20"}) {
        EXPECT_FALSE(only_asks(line)) << line;
    }
}

TEST(PmacCommandKind, StopsAndKillsAreKnown) {
    for (const std::string_view line : {"#1J/", "J/ #2J/", "&1A", "h", "Q", "S", "\\"}) {
        EXPECT_TRUE(only_stops(line)) << line;
    }
    for (const std::string_view line : {"", "#1J+", "#1K", "A R", "R", "#1J=5"}) {
        EXPECT_FALSE(only_stops(line)) << line;
    }
    EXPECT_TRUE(only_kills("#1K #2K"));
    EXPECT_FALSE(only_kills("K R"));
    EXPECT_TRUE(jogs_without_end("#1J- #2J="));
    EXPECT_FALSE(jogs_without_end("#1J=-5 J:-3 J/"));
}

TEST(PmacTypedLines, AResetThatWasTypedIsToldAsOne) {
    PmacWire wire;
    (void)wire.session.command({"$$$"}, false);
    ASSERT_TRUE(wire.run_to_end(20.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("the card was reset"));
    EXPECT_FALSE(wire.powered());
}

} // namespace
} // namespace millwright::pmac::internal
