#include "core/cordic_control/supervised_run.h"

#include "core/cordic/assembler.h"
#include "core/cordic_control/plc_assembler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::cordic {
namespace {

using testing::HasSubstr;

constexpr double scan_s = 1e-3;

/// 100 mm at 50 mm/s, 2 s; then back.
const std::string there_and_back =
    ".format f64\nMOV Vmax, 50\nMOV Amax, 100\nMOV XI, 100\nG01\nMOV XI, 0\nG01\nM30\n";

Processor supervised_processor(const std::string& code) {
    const Assembled made = assemble(code, "program.asm");
    EXPECT_TRUE(made.errors.empty()) << made.errors[0].message;
    return Processor({}, made.image);
}

SupervisedRun supervised(const std::string& code, const std::string& logic, const std::string& inputs = {}) {
    Processor processor = supervised_processor(code);
    PlcProgram program = assemble_plc(logic, "logic.plc");
    EXPECT_TRUE(program.errors.empty()) << program.errors[0].message;
    Plc plc(std::move(program));
    SupervisedSettings settings;
    ReadInputs read = read_inputs(inputs, "inputs");
    EXPECT_TRUE(read.errors.empty());
    settings.inputs = std::move(read.changes);
    settings.most_seconds = 60.0;
    return run_supervised(processor, plc, settings);
}

/// "Q0+ Q0- ..." in the order they came.
std::string outputs(const SupervisedRun& run) {
    std::string all;
    for (const OutputChange& change : run.outputs) {
        all += plc_name(change.bit) + (change.value ? "+ " : "- ");
    }
    return all;
}

TEST(SupervisedRun, TakesAsLongAsTheMotion) {
    const SupervisedRun done = supervised(there_and_back, "LD MOVING\nST Q0\n");
    EXPECT_EQ(done.end, SupervisedEnd::finished);
    EXPECT_EQ(done.executed, 2);
    EXPECT_NEAR(done.moved_seconds, 4.0, 1e-6);
    EXPECT_NEAR(done.seconds, 4.0, 2 * scan_s);
    EXPECT_EQ(outputs(done), "Q0+ Q0- ");
    EXPECT_EQ(done.position[0], 0.0);
}

// A door that is open from 1 s to 1.5 s.
TEST(SupervisedRun, StandsWhileAnInterlockIsOpen) {
    const SupervisedRun done = supervised(there_and_back, "LD I0\nST HOLD\n", "1 I0 1\n1.5 I0 0\n");
    EXPECT_EQ(done.end, SupervisedEnd::finished);
    EXPECT_NEAR(done.held_seconds, 0.5, 2 * scan_s);
    EXPECT_NEAR(done.moved_seconds, 4.0, 1e-6);
    EXPECT_NEAR(done.seconds, 4.5, 3 * scan_s);
}

TEST(SupervisedRun, IsStoppedByTheLogicWhereTheAxesAre) {
    const SupervisedRun done = supervised(there_and_back, "LD I0\nTON T0, 500\nST STOP\n", "0.5 I0 1\n");
    EXPECT_EQ(done.end, SupervisedEnd::stopped);
    EXPECT_NEAR(done.seconds, 1.0, 2 * scan_s);
    EXPECT_NEAR(done.position[0], 50.0, 50.0 * 2 * scan_s);
    EXPECT_EQ(done.executed, 0);
}

TEST(SupervisedRun, WaitsAtM00UntilTheLogicStartsIt) {
    const std::string code = "MOV Vmax, 50\nMOV Amax, 100\nMOV XI, 10\nG01\nM00\nMOV XI, 20\nG01\nHLT\n";
    const SupervisedRun done =
        supervised(code, "LD WAITING\nST Q0\nLD I0\nST START\n", "0 I0 1\n0.05 I0 0\n2 I0 1\n");
    EXPECT_EQ(done.end, SupervisedEnd::finished);
    EXPECT_NEAR(done.waited_seconds, 1.8, 3 * scan_s); // the start of before is none
    EXPECT_THAT(outputs(done), HasSubstr("Q0+ START+ Q0- "));
    EXPECT_EQ(done.position[0], 20.0);
}

// M117 closes a clamp, whose switch reports half a second later.
TEST(SupervisedRun, HandsTheMachinesOwnCommandsToTheLogicUntilItIsDone) {
    const std::string code = "MOV P, 117\nMUSER\nMOV Vmax, 50\nMOV Amax, 100\nMOV XI, 10\nG01\nHLT\n";
    const SupervisedRun done =
        supervised(code, "LD U117\nS Q3\nLD U117\nAND I3\nST FIN\nLD U118\nST Q4\n", "0.5 I3 1\n");
    EXPECT_EQ(done.end, SupervisedEnd::finished);
    EXPECT_NEAR(done.waited_seconds, 0.5, 3 * scan_s);
    EXPECT_THAT(outputs(done), HasSubstr("Q3+ FIN+ FIN-"));
    EXPECT_THAT(outputs(done), testing::Not(HasSubstr("Q4")));
}

TEST(SupervisedRun, ShowsSpindleCoolantAndTheEndToTheLogic) {
    const std::string code = "MOV P, 900\nM03\nM08\nMOV P, 100000\nG04\nM05\nM09\nG04\nM02\n";
    const SupervisedRun done = supervised(code, "LD SPINDLE\nST Q0\nLD COOLANT\nST Q1\nLD ENDED\nST Q2\n");
    EXPECT_EQ(outputs(done), "Q0+ Q1+ Q0- Q1- Q2+ ");
    EXPECT_NEAR(done.moved_seconds, 0.2, 1e-9);
}

// A chord takes 121 clocks to compute and 2.6 ms to cut: at 10 kHz the axes wait for each of them.
TEST(SupervisedRun, TellsHowLongTheAxesWaitedForTheProcessor) {
    const std::string code =
        ".format f64\nMOV X0, 5\nMOV Vmax, 50\nMOV Amax, 100\nMOV Dz, 0.0261799\nMOV N, 120\nG03\nHLT\n";
    Processor slow = supervised_processor(code);
    Plc nothing(assemble_plc("", "logic.plc"));
    SupervisedSettings settings;
    settings.start = {5.0, 0.0, 0.0};
    settings.clock_hz = 1e4;
    const SupervisedRun starved = run_supervised(slow, nothing, settings);
    EXPECT_NEAR(starved.seconds, static_cast<double>(slow.state().clocks.total) / 1e4, 0.01);
    EXPECT_NEAR(starved.starved_seconds, starved.seconds - starved.moved_seconds, 0.03);
    EXPECT_GT(starved.starved_seconds, 1.0);
    Processor fast = supervised_processor(code);
    settings.clock_hz = 8e6;
    const SupervisedRun kept_up = run_supervised(fast, nothing, settings);
    EXPECT_EQ(kept_up.starved_seconds, 0.0);
    EXPECT_NEAR(kept_up.moved_seconds, starved.moved_seconds, 1e-9);
}

// The sewing machine of the thesis: 20 ms a stitch, the needle in the material for a third of it.
TEST(SupervisedRun, SewsOnlyWhileTheNeedleIsUp) {
    std::string inputs;
    for (int n = 0; n < 200; ++n) {
        inputs += std::to_string(0.02 * n) + " I0 1\n" + std::to_string(0.02 * n + 0.02 / 3.0) + " I0 0\n";
    }
    const SupervisedRun done = supervised(there_and_back, "LD I0\nST HOLD\n", inputs);
    EXPECT_EQ(done.end, SupervisedEnd::finished);
    EXPECT_NEAR(done.moved_seconds, 4.0, 1e-6);
    EXPECT_NEAR(done.held_seconds / 4.0, 7.0 / 20.0, 0.05); // a third, in whole scans
}

TEST(SupervisedRun, EndsInADefinedStateWhereTheProcessorStands) {
    const SupervisedRun done =
        supervised(".format q4.12\nMOV X0, -7\nMOV Vmax, 1\nMOV Amax, 1\nMOV XI, 7\nG01\nHLT\n", "");
    EXPECT_EQ(done.end, SupervisedEnd::fault);
    EXPECT_EQ(done.executed, 0);
    EXPECT_EQ(supervised("again: MOV PC, again\n", "").end, SupervisedEnd::out_of_time);
    EXPECT_THROW((void)supervised("MOV P, 7\nMUSER\nHLT\n", ""), Error);
}

} // namespace
} // namespace millwright::cordic
