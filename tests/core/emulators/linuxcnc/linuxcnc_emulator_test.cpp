// The emulated LinuxCNC by its words alone, as man page linuxcncrsh has them.
#include "core/emulators/linuxcnc/linuxcnc_emulator.h"

#include "core/base/files.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::emulators {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Conversation : testing::Test {
    test::ScratchFolder scratch;
    LinuxCncEmulator emulator{
        {.model = std::make_shared<const kinematics::MachineModel>(test::machine("router-xyz"))}};

    std::string answer(const std::string& line) {
        emulator.receive(line + "\r\n");
        return emulator.take_output();
    }
    void enable() {
        (void)answer("hello EMC test 1.0");
        (void)answer("set echo off");
        EXPECT_EQ(answer("set verbose on"), "SET VERBOSE ACK\r\n");
        EXPECT_EQ(answer("set enable EMCTOO"), "SET ENABLE ACK\r\n");
    }
    void switch_on() {
        enable();
        EXPECT_EQ(answer("set estop off"), "SET ESTOP ACK\r\n");
        EXPECT_EQ(answer("set machine on"), "SET MACHINE ACK\r\n");
        EXPECT_EQ(answer("set home -1"), "SET HOME ACK\r\n");
        emulator.advance(1.0);
        EXPECT_EQ(answer("get joint_homed"), "JOINT_HOMED YES YES YES\r\n");
    }
    /// A program in a file, run to its end or as far as `seconds` go.
    void run(const std::string& text, double seconds = 100.0) {
        write_file(scratch / "p.ngc", text);
        EXPECT_EQ(answer("set mode auto"), "SET MODE ACK\r\n");
        EXPECT_EQ(answer("set open " + (scratch / "p.ngc").string()), "SET OPEN ACK\r\n");
        EXPECT_EQ(answer("set run"), "SET RUN ACK\r\n");
        for (double time = 0.0; time < seconds; time += 0.01) {
            emulator.advance(0.01);
        }
    }
};

TEST_F(Conversation, BeginsWithHelloAndEnable) {
    EXPECT_EQ(answer("get estop"), "get estop\r\n"); // the echo alone
    EXPECT_THAT(answer("hello WRONG test 1.0"), HasSubstr("HELLO NAK"));
    EXPECT_THAT(answer("hello EMC test 1.0"), HasSubstr("HELLO ACK"));
    EXPECT_THAT(answer("get estop"), HasSubstr("ESTOP ON"));
    (void)answer("set echo off");
    EXPECT_EQ(answer("set estop off"), "SET ESTOP NAK\r\n"); // not enabled
    EXPECT_EQ(answer("set enable wrong"), "SET ENABLE NAK\r\n");
    EXPECT_EQ(answer("set enable EMCTOO"), ""); // not verbose
    EXPECT_EQ(answer("set estop off"), "");
    EXPECT_EQ(answer("get estop"), "ESTOP OFF\r\n");
}

TEST_F(Conversation, RefusesWhatItDoesNotKnow) {
    enable();
    for (const char* words : {"set nothing on",
                              "set estop maybe",
                              "set mode fast",
                              "set run 7",
                              "set home 0",
                              "set jog_incr X 0 1",
                              "set jog_incr X 10 -1",
                              "set jog_incr Q 10 1",
                              "set jog_incr X ten 1",
                              "set feed_override 900",
                              "set set_wait done"}) {
        EXPECT_THAT(answer(words), HasSubstr("NAK")) << words;
    }
    EXPECT_EQ(answer("get nothing"), "GET NOTHING NAK\r\n");
    EXPECT_EQ(answer("dance"), "");
}

TEST_F(Conversation, MovesNothingUntilItIsOnAndHomed) {
    enable();
    const auto complains = [&](const std::string& command, const std::string& about) {
        (void)answer(command);
        EXPECT_THAT(answer("get error"), HasSubstr(about)) << command;
        emulator.advance(1.0);
        EXPECT_LT(emulator.truth().last_motion, 0.0);
    };
    complains("set machine on", "emergency stop");
    complains("set home -1", "machine is off");
    complains("set jog_incr X 600 10", "machine is off");
    (void)answer("set estop off");
    (void)answer("set machine on");
    (void)answer("set mode mdi");
    complains("set mdi G0 X1", "not homed");
    (void)answer("set mode auto");
    complains("set run", "not homed");
    EXPECT_EQ(answer("get error"), "ERROR OK\r\n");
}

TEST_F(Conversation, RunsAProgramLineByLineAndTellsItsMessages) {
    switch_on();
    run("G21 G90 G94\nG1 X10 F600\nG1 Y10\n(MSG,half)\nG1 X0\nG4 P0\n(MSG,all)\nM2\n", 1.5);
    EXPECT_EQ(answer("get program_status"), "PROGRAM_STATUS RUNNING\r\n");
    EXPECT_EQ(answer("get program_line"), "PROGRAM_LINE 3\r\n");
    EXPECT_EQ(answer("get operator_display"), "OPERATOR_DISPLAY OK\r\n");
    EXPECT_EQ(answer("set pause"), "SET PAUSE ACK\r\n");
    emulator.advance(1.0);
    const kinematics::AxisPositions held = emulator.position();
    emulator.advance(5.0);
    EXPECT_EQ(emulator.position(), held);
    EXPECT_EQ(answer("get program_status"), "PROGRAM_STATUS PAUSED\r\n");
    EXPECT_EQ(answer("set resume"), "SET RESUME ACK\r\n");
    for (int n = 0; n < 1000; ++n) {
        emulator.advance(0.01);
    }
    EXPECT_EQ(answer("get program_status"), "PROGRAM_STATUS IDLE\r\n");
    EXPECT_EQ(answer("get operator_display"), "OPERATOR_DISPLAY half\r\n");
    EXPECT_EQ(answer("get operator_display"), "OPERATOR_DISPLAY all\r\n");
    EXPECT_EQ(answer("get abs_act_pos"), "ABS_ACT_POS 0.0000 10.0000 0.0000 0.0000 0.0000 0.0000\r\n");
    const LinuxCncTruth& truth = emulator.truth();
    std::vector<int> lines;
    for (const LinuxCncTruthLine& line : truth.lines) {
        lines.push_back(line.line);
    }
    EXPECT_EQ(lines, (std::vector{2, 3, 5}));
    EXPECT_EQ(truth.ended_runs, 1);
}

TEST_F(Conversation, StopsBeforeALineThatIsWrong) {
    switch_on();
    run("G21 G90 G94\nG1 X10 F6000\nG1 X900\nM2\n", 10.0);
    EXPECT_THAT(answer("get error"), HasSubstr("would exceed the limits of axis X"));
    EXPECT_EQ(answer("get program_status"), "PROGRAM_STATUS IDLE\r\n");
    EXPECT_NEAR(emulator.position()[0], 10.0, 1e-6);
    EXPECT_EQ(emulator.truth().ended_runs, 0);
    run("G21\nG1 X1\nM2\n", 10.0); // without a feed
    EXPECT_THAT(answer("get error"), StartsWith("ERROR "));
    EXPECT_NE(answer("get error"), "");
    (void)answer("set open /nowhere/p.ngc");
    EXPECT_THAT(answer("get error"), HasSubstr("can't open"));
}

TEST_F(Conversation, StandsAtOnceInTheEmergencyStop) {
    switch_on();
    run("G21 G90 G94\nG1 X100 F600\nM2\n", 1.0);
    emulator.raise_alarm();
    const kinematics::AxisPositions stopped = emulator.position();
    emulator.advance(10.0);
    EXPECT_EQ(emulator.position(), stopped);
    EXPECT_EQ(answer("get estop"), "ESTOP ON\r\n");
    EXPECT_EQ(answer("get machine"), "MACHINE OFF\r\n");
    (void)answer("set resume");
    (void)answer("set run");
    emulator.advance(10.0);
    EXPECT_EQ(emulator.position(), stopped);
    emulator.power_cycle();
    EXPECT_EQ(answer("get estop"), "get estop\r\n"); // it has no session
}

} // namespace
} // namespace millwright::emulators
