// What the cordic commands make of their options: none is passed over in silence, no number is none.
#include "tests/app/program.h"
#include "tests/app/scratch_files.h"
#include "tests/app/shipped_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using CordicOptions = ScratchFiles;

TEST_F(CordicOptions, RefuseArcsThatTheFormatCannotKeepWithinTheTolerance) {
    const std::string file = written("f10.ngc", "G21 G90\nF60\nG2 X0 Y0 I10 J0\nM2\n");
    const Ended coarse = run({"cordic", "run", file, "--format", "q24.8", "--arc-tolerance", "1e-7"});
    EXPECT_EQ(coarse.exit_code, 1);
    EXPECT_EQ(coarse.out, "");
    EXPECT_THAT(coarse.err, HasSubstr("f10.ngc:3:1: in q24.8 the end of a chord is 0.00"));
    const Ended whole = run({"cordic", "run", file, "--format", "q12.16", "--whole-arcs", "--json"});
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    const auto error_of = [](const Ended& ended) {
        return nlohmann::json::parse(ended.out).at("errors").at("position_mm").get<double>();
    };
    EXPECT_GT(error_of(whole), 0.001);
    const Ended divided = run({"cordic", "run", file, "--format", "q12.16", "--json"});
    ASSERT_EQ(divided.exit_code, 0) << divided.err;
    EXPECT_LT(error_of(divided), 0.001);
}

TEST_F(CordicOptions, TellTheWayOfRoundingThatTheProcessorUses) {
    const std::string file = written("arc.ngc", "G21\nF60\nG3 X0 Y0 I-5 J0\nM2\n");
    std::vector<std::string> answers;
    for (const char* rounding : {"truncate", "nearest", "nearest-even"}) {
        const Ended ended =
            run({"cordic", "run", file, "--format", "q10.22", "--json", "--rounding", rounding});
        ASSERT_EQ(ended.exit_code, 0) << ended.err;
        const auto answer = nlohmann::json::parse(ended.out);
        EXPECT_LT(answer.at("errors").at("position_mm").get<double>(), 0.001);
        answers.push_back(answer.at("points").dump());
    }
    EXPECT_NE(answers[0], answers[1]);
    EXPECT_NE(answers[1], answers[2]);
    EXPECT_EQ(run({"cordic", "run", file, "--rounding", "up"}).exit_code, 2);
}

TEST_F(CordicOptions, TakeNoNumbersThatAreNone) {
    const std::vector<std::vector<std::string>> uses{
        {"cordic", "run", thesis_arc, "--clock"},
        {"cordic", "run", thesis_arc, "--arc-tolerance"},
        {"cordic", "run", thesis_arc, "--rapid"},
        {"cordic", "run", thesis_arc, "--acceleration"},
        {"cordic", "run", thesis_arc, "--profile", "s-curve", "--jerk"},
        {"cordic", "run", thesis_arc, "--servo", "x", "--period"},
        {"cordic", "run", thesis_arc, "--profile", "s-curve", "--steps"},
        {"cordic", "run", thesis_arc, "--profile", "s-curve", "--timer"},
        {"cordic", "run", thesis_arc, "--plc", "x", "--scan"},
        {"cordic", "sew", thesis_arc, "--needle-rpm"},
        {"cordic", "sew", thesis_arc, "--needle-down"},
        {"cordic", "rotate", "1", "0"},
        {"cordic", "vector", "1"},
        {"run", "x.json", "--driver", "virtual", "--period"},
        {"run", "x.json", "--driver", "cordic", "--clock"},
        {"run", "x.json", "--driver", "virtual", "--clearance"}};
    for (const auto& use : uses) {
        for (const char* none : {"nan", "-NaN", "inf", "-infinity", "1e999"}) {
            std::vector<std::string> words = use;
            words.emplace_back(none);
            const Ended ended = run(words);
            EXPECT_EQ(ended.exit_code, 2) << use.back() << " " << none << "\n" << ended.err;
            EXPECT_EQ(ended.out, "");
        }
    }
    EXPECT_THAT(run({"cordic", "run", thesis_arc, "--clock", "nan"}).err,
                HasSubstr("--clock: \"nan\" is not a finite number"));
}

TEST_F(CordicOptions, OfAMotionAreRefusedWithoutOne) {
    for (const char* option : {"--jerk", "--steps", "--timer", "--min-interval"}) {
        const Ended ended = run({"cordic", "run", thesis_arc, option, "5"});
        EXPECT_EQ(ended.exit_code, 2) << option;
        EXPECT_THAT(ended.err, AllOf(HasSubstr(option), HasSubstr("--profile")));
    }
    EXPECT_THAT(run({"cordic", "run", thesis_arc, "--period", "0.1"}).err, HasSubstr("--servo"));
    const Ended trapezoid = run({"cordic", "run", thesis_arc, "--profile", "trapezoid", "--jerk", "5"});
    EXPECT_EQ(trapezoid.exit_code, 1);
    EXPECT_THAT(trapezoid.err, HasSubstr("--jerk applies only to --profile s-curve"));
}

TEST_F(CordicOptions, TellWhereAProgramGoesRoundForEver) {
    const std::string file =
        written("loop.asm", "MOV Vmax, 1\nMOV Amax, 1\nL: MOV XI, 1\nG01\nMOV XI, 2\nG01\nMOV PC, L\n");
    for (const char* command : {"run", "sew"}) {
        const Ended ended = run({"cordic", command, file});
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_EQ(ended.out, "");
        EXPECT_THAT(ended.err, HasSubstr("the program never ends"));
        EXPECT_THAT(ended.err, HasSubstr("loop.asm:"));
        const Ended some = run({"cordic", command, file, "--clocks", "5000"});
        EXPECT_EQ(some.exit_code, 1);
        EXPECT_THAT(some.err, HasSubstr("did not end within 5000 clocks"));
    }
    EXPECT_THAT(run({"cordic", "run", file, "--trace", path("loop.vcd")}).err,
                HasSubstr("the program never ends"));
}

TEST_F(CordicOptions, NameTheCauseOfASpeedThatIsBesideTheFeed) {
    const std::string file = written("x8.ngc", "F30\nG1 X3 Y4\nG1 X8\nM2\n");
    const Ended ended = run({"cordic", "run", file, "--matlab-zero", "--format", "f64"});
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.err,
                HasSubstr("x8.ngc:3: the speed deviates from the feed rate by up to 22 %: with --matlab-zero "
                          "nothing is turned along an axis"));
    EXPECT_THAT(ended.err, Not(HasSubstr("too few bits")));
    const Ended adrift = run({"cordic", "run", thesis_arc, "--iterations", "9", "--whole-arcs"});
    EXPECT_THAT(adrift.err, HasSubstr("its ends are up to 1.3 mm off"));
}

TEST_F(CordicOptions, CountNoMotionWithoutLengthAsLate) {
    const std::string head = "MOV Vmax, 1\nMOV Amax, 1\nMOV XI, 1\nG01\n";
    const auto answer = [&](const std::string& text) {
        const Ended ended = run({"cordic", "run", written("z.asm", head + text + "HLT\n"), "--json"});
        EXPECT_EQ(ended.exit_code, 0);
        return nlohmann::json::parse(ended.out);
    };
    const auto idle = answer("G01\nMOV XI, 2\nG01\n");
    EXPECT_EQ(idle.at("late"), 0);
    // While 1 mm is moved, both are computed: G01 in 85 clocks, MOV in 18 and G01 in 85, at 8 MHz.
    EXPECT_NEAR(idle.at("fastest_mm_per_min").get<double>(), 60.0 * 8e6 / 188.0, 1e-6 * 60.0 * 8e6 / 188.0);
    EXPECT_TRUE(answer("G01\n").at("fastest_mm_per_min").is_null());
}

TEST_F(CordicOptions, OfGCodeAreRefusedForProgramsThatAreMadeAlready) {
    const std::string image = path("arc.bin");
    ASSERT_EQ(run({"cordic", "asm", thesis_arc, "--out", image, "--format", "q10.22"}).exit_code, 0);
    const std::string text = written("p.asm", ".format q10.22\nHLT\n");
    for (const std::string& file : {image, text}) {
        EXPECT_EQ(run({"cordic", "run", file, "--format", "q10.22"}).exit_code, 0);
        const Ended other = run({"cordic", "run", file, "--format", "f64"});
        EXPECT_EQ(other.exit_code, 1);
        EXPECT_THAT(other.err, HasSubstr("the program is in q10.22, not in f64"));
        const Ended chords = run({"cordic", "run", file, "--arc-tolerance", "0.1"});
        EXPECT_EQ(chords.exit_code, 1);
        EXPECT_THAT(chords.err, HasSubstr("--arc-tolerance applies only to G-code"));
    }
}

TEST_F(CordicOptions, WriteTheHeightOfEveryPointInSpace) {
    const std::string file = written("helix.ngc", "G21 F600\nG3 X0 Y0 Z-4 I-5 J0\nG1 X5\nM2\n");
    const Ended ended = run({"cordic", "run", file, "--format", "f64", "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto points = nlohmann::json::parse(ended.out).at("points");
    double before = 0.0;
    for (std::size_t n = 0; n + 1 < points.size(); ++n) {
        const double z = points[n].at("z").get<double>();
        EXPECT_LT(z, before);
        EXPECT_LT(points[n].at("vz").get<double>(), 0.0);
        EXPECT_LT(points[n].at("az").get<double>(), 0.0);
        before = z;
    }
    EXPECT_EQ(before, -4.0);
    EXPECT_EQ(points.back().at("z"), -4.0); // level, at the height where the helix ends
    EXPECT_EQ(points.back().at("vz"), 0.0);
    EXPECT_EQ(points.back().at("az"), 0.0);
    const std::string flat = written("flat.ngc", "G21 F600\nG1 X5\nM2\n");
    const Ended level = run({"cordic", "run", flat, "--json"});
    EXPECT_FALSE(nlohmann::json::parse(level.out).at("points").at(0).contains("z"));
}

TEST_F(CordicOptions, PrintErrorsInTheirOrderAndNotWithoutEnd) {
    std::string text;
    for (int n = 0; n < 5'000; ++n) {
        text += "MOV Q, 1\n";
    }
    const Ended ended = run({"cordic", "run", written("many.asm", text)});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_LE(std::ranges::count(ended.err, '\n'), 25);
    EXPECT_LT(ended.err.find("many.asm:1:"), ended.err.find("many.asm:2:"));
    EXPECT_THAT(ended.err, HasSubstr("many.asm: 5000 errors"));
}

TEST_F(CordicOptions, FillTheRamForTheProcessorAndReadItBack) {
    const std::string file = written("ram.asm", "LD X0, 0x8000\nST X0, 0x8004\nHLT\n");
    const std::string in = written("in.ram", std::string("\x00\x00\xc0\x3f", 4)); // 1.5
    const Ended ended = run({"cordic", "run", file, "--ram", in, "--ram-out", path("out.ram"), "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_GT(nlohmann::json::parse(ended.out).at("clocks").at("data").get<int>(), 0);
    const std::string ram = content_of(path("out.ram"));
    EXPECT_EQ(ram.size(), 0x4000U);
    EXPECT_EQ(ram.substr(4, 4), ram.substr(0, 4));
    for (const std::string& read : {in, file}) {
        const Ended onto = run({"cordic", "run", file, "--ram", in, "--ram-out", read});
        EXPECT_EQ(onto.exit_code, 1);
        EXPECT_THAT(onto.err, HasSubstr("--ram-out would overwrite "));
    }
    EXPECT_EQ(content_of(in).size(), 4U);
    const Ended large = run({"cordic", "run", file, "--ram", written("large.ram", std::string(0x4001, 'x'))});
    EXPECT_EQ(large.exit_code, 1);
    EXPECT_THAT(large.err, HasSubstr("large.ram: 16385 bytes, but the RAM holds 16384"));
}

TEST_F(CordicOptions, TellThePlaceWhereAMicroprogramOrTheLogicHasNoAnswer) {
    const std::string halt = written("h.asm", "HLT\n");
    const Ended empty = run({"cordic", "run", halt, "--microprogram", written("empty.micro", "")});
    EXPECT_EQ(empty.exit_code, 1);
    EXPECT_THAT(empty.err, HasSubstr("empty.micro:1:1: the microprogram has no words"));
    const Ended off = run({"cordic", "run", halt, "--microprogram", written("off.micro", "CONT\n\nCONT\n")});
    EXPECT_EQ(off.exit_code, 1);
    EXPECT_THAT(off.err, HasSubstr("off.micro:3:1: the microprogram ran past its last word"));
    const std::string own = written("own.asm", "MOV P, 50\n  MUSER\nHLT\n");
    const Ended user = run({"cordic", "run", own, "--plc", "assets/samples/interlock.plc"});
    EXPECT_EQ(user.exit_code, 1);
    EXPECT_THAT(user.err, HasSubstr("own.asm:2:3: M50 is not a user-defined command"));
}

TEST_F(CordicOptions, WarnOfRunsThatAreNotAsPromised) {
    const auto warnings = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"cordic", "run"});
        words.emplace_back("--json");
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        const auto found = nlohmann::json::parse(ended.out).at("warnings");
        EXPECT_EQ(found.empty(), ended.err.find("warning: ") == std::string::npos) << ended.err;
        for (const auto& warning : found) {
            EXPECT_THAT(ended.err, HasSubstr(warning.at("message").get<std::string>()));
        }
        return found.dump();
    };
    EXPECT_EQ(warnings({thesis_arc}), "[]");
    EXPECT_THAT(warnings({thesis_arc, "--thesis-direction"}), HasSubstr("arcs turn the other way"));
    const std::string image = path("arc.bin");
    ASSERT_EQ(run({"cordic", "asm", thesis_arc, "--out", image}).exit_code, 0);
    EXPECT_EQ(warnings({image}), "[]");
    const std::string loop =
        written("loop.asm", "MOV PC, GO\nMOV XI, 1\nGO: MOV Vmax, 1\n  MOV Amax, 1\n  G01\n  G01\nHLT\n");
    EXPECT_THAT(warnings({loop}),
                AllOf(HasSubstr("where the axes already are"), HasSubstr(R"("column":3,"line":6)")));
    const std::string slow = written("slow.ngc", "G21 G90\nF1\nG1 X10 Y7\nM2\n");
    EXPECT_THAT(warnings({slow, "--format", "q10.6", "--acceleration", "50"}),
                HasSubstr("q10.6 has too few bits"));
    const std::string line = written("line.ngc", "G21 G90\nF60\nG1 X10 Y7\nM2\n");
    EXPECT_THAT(warnings({line, "--iterations", "4"}),
                AllOf(HasSubstr("4 iterations leave its direction up to 14 degrees off"),
                      Not(HasSubstr("too few bits"))));
}

// A way of 1e-6 mm back to the start is a full circle to the interpreter.
TEST_F(CordicOptions, ListWhatTheCompilerWarnsOf) {
    const std::string file =
        written("hair.ngc", "G21 G90 G17\nF60\nG1 X10 Y0\n  G3 X10 Y0.000008 I-10 J0\nM2\n");
    const Ended ended = run({"cordic", "run", file, "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto found = nlohmann::json::parse(ended.out).at("warnings");
    ASSERT_EQ(found.size(), 1U) << found;
    EXPECT_EQ(found[0].at("line"), 4);
    EXPECT_THAT(found[0].at("message").get<std::string>(),
                HasSubstr("past its start and is run as a full circle"));
    EXPECT_THAT(ended.err, HasSubstr("hair.ngc:4"));
}

TEST_F(CordicOptions, RefuseDirectionsThatSoFewIterationsDoNotReachBeforeAnythingRuns) {
    const std::string file = written("back.ngc", "G21 F60\nG1 X10\nG1 X-50\nM2\n");
    const Ended ended = run({"cordic", "run", file, "--iterations", "2"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_EQ(ended.out, "");
    EXPECT_THAT(ended.err,
                HasSubstr("back.ngc:3:1: the direction of a line cannot be reached with 2 iterations"));
}

TEST_F(CordicOptions, SayThatASpeedIsMissingOrNegativeWhereItIsRead) {
    const auto fault_of = [&](const std::string& text) {
        const Ended ended = run({"cordic", "run", written("speed.asm", text)});
        EXPECT_EQ(ended.exit_code, 1) << text;
        return ended.err;
    };
    EXPECT_THAT(fault_of("MOV Vmax, -5\nMOV Amax, 1\nMOV XI, 1\nG01\nHLT\n"),
                HasSubstr("speed.asm:1:11: Vmax must be above 0"));
    EXPECT_THAT(fault_of("MOV Vmax, 0\nHLT\n"), HasSubstr("speed.asm:1:11: Vmax must be above 0"));
    EXPECT_THAT(fault_of("MOV Amax, 1\nMOV XI, 1\n  G01\nHLT\n"),
                AllOf(HasSubstr("speed.asm:3:3: the processor stopped"),
                      HasSubstr("Vmax and Amax of a motion must be above 0")));
    // From memory, which the assembler does not know: the host has left nothing there, 0xffffffff.
    EXPECT_THAT(fault_of("LD Vmax, 0x8000\nHLT\n"),
                AllOf(HasSubstr("speed.asm:1:1: the processor stopped"), HasSubstr("NaN or infinity")));
}

TEST_F(CordicOptions, SayThatAVectorIsBelowWhatTheFormatCanTell) {
    const Ended ended = run({"cordic", "rotate", "1e-9", "0", "30", "--format", "q2.22"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("(1e-09, 0) is below the resolution of q2.22"));
    const Ended turned = run({"cordic", "rotate", "-0.5", "0", "0", "--format", "q2.22", "--json"});
    EXPECT_EQ(nlohmann::json::parse(turned.out).at("words").at(0).get<std::string>().size(), 8U)
        << "0x, 24 bits";
}

TEST_F(CordicOptions, AreForTheKindOfFileThatTheyAreFor) {
    const std::string image = path("arc.bin");
    ASSERT_EQ(run({"cordic", "asm", thesis_arc, "--out", image}).exit_code, 0);
    const Ended again = run({"cordic", "asm", image, "--out", path("again.bin")});
    EXPECT_EQ(again.exit_code, 1);
    EXPECT_THAT(again.err, HasSubstr("is already an image"));
    EXPECT_THAT(
        run({"cordic", "asm", "--help"}).out,
        AllOf(HasSubstr("G-code or assembly source (.asm)"), HasSubstr("G-code: speed of rapid moves")));
}

TEST_F(CordicOptions, ShowBytesThatAreNoTextAsNumbers) {
    const Ended ended = run({"cordic", "run", written("raw.asm", "MOV \x1b[31m\x07\xff, 1\n")});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("raw.asm:1:5: \"\\x1b[31m\\x07\\xff\" is not a register"));
    const Ended umlaut = run({"cordic", "run", written("word.asm", "MOV \xc3\x84, 1\n")});
    EXPECT_THAT(umlaut.err, HasSubstr("\"\xc3\x84\" is not a register"));
}

TEST_F(CordicOptions, OfTheArithmeticAreRecordedInTheImage) {
    const std::string image = path("arc.bin");
    const std::vector<std::string> settings = {
        "--iterations", "24", "--rounding", "nearest", "--thesis-direction", "--matlab-zero"};
    std::vector<std::string> words = {
        "cordic", "asm", thesis_arc, "--format", "q8.24", "--acceleration", "100", "--out", image};
    words.insert(words.end(), settings.begin(), settings.end());
    const Ended made = run(words);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Ended text = run({"cordic", "disasm", image});
    EXPECT_THAT(text.out,
                HasSubstr(".format q8.24\n        .iterations 24\n        .rounding nearest\n"
                          "        .direction thesis\n        .zero matlab\n"));
    // Without a word it is executed as what it was made for: as the G-code with the same options.
    const auto points = [](const Ended& ended) {
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        return nlohmann::json::parse(ended.out).at("points");
    };
    words = {"cordic", "run", thesis_arc, "--format", "q8.24", "--acceleration", "100", "--json"};
    words.insert(words.end(), settings.begin(), settings.end());
    const auto of_image = points(run({"cordic", "run", image, "--json"}));
    EXPECT_EQ(of_image, points(run(words)));
    EXPECT_EQ(of_image, points(run({"cordic", "run", written("again.asm", text.out), "--json"})));
    const auto refusal = [&](const std::string& file, std::vector<std::string> options) {
        options.insert(options.begin(), {"cordic", "run", file});
        const Ended ended = run(options);
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_EQ(ended.out, "");
        return ended.err;
    };
    EXPECT_THAT(refusal(image, {"--iterations", "32"}), HasSubstr("the program is made for 24 iterations"));
    EXPECT_THAT(refusal(image, {"--rounding", "truncate"}), HasSubstr("made for rounding \"nearest\""));
    EXPECT_THAT(refusal(image, {"--format", "f32"}), HasSubstr("the program is in q8.24, not in f32"));
    const std::string plain = path("plain.bin");
    ASSERT_EQ(run({"cordic", "asm", thesis_arc, "--out", plain}).exit_code, 0);
    EXPECT_THAT(refusal(plain, {"--iterations", "9"}), HasSubstr("made for the thesis's 29 steps"));
    EXPECT_THAT(refusal(plain, {"--thesis-direction"}), HasSubstr("made for G02 clockwise"));
    EXPECT_THAT(refusal(plain, {"--matlab-zero"}), HasSubstr("leave out --matlab-zero"));
}

TEST_F(CordicOptions, OfImagesOfVersionOneAreNotGuessed) {
    std::string bytes = "MWCP";
    bytes += std::string({1, 1, 0, 0, 1, 0, 0, 0, 1});
    const Ended old = run({"cordic", "run", written("old.bin", bytes)});
    EXPECT_EQ(old.exit_code, 1);
    EXPECT_THAT(old.err,
                HasSubstr("has version 1, which does not state the steps and rounding it is made for"));
    EXPECT_THAT(old.err, HasSubstr("write it with millwright cordic asm"));
}

TEST_F(CordicOptions, SayThatThereIsNothingInAProgramOfNoInstruction) {
    const Ended ended = run({"cordic", "run", written("empty.asm", "; nothing\n")});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("the program contains no instruction"));
}

TEST_F(CordicOptions, WarnWithThePlaceOfMotionsThatLeadNowhere) {
    const std::string twice = written("twice.asm", "MOV XI, 1\nMOV Vmax, 1\nMOV Amax, 1\nG01\n  G01\nHLT\n");
    const Ended made = run({"cordic", "asm", twice, "--out", path("twice.bin")});
    EXPECT_EQ(made.exit_code, 0);
    EXPECT_THAT(made.err, HasSubstr("twice.asm:5:3: a move has zero length"));
    const Ended vanished = run(
        {"cordic", "asm", written("dz.asm", "MOV Dz, 1e-9\n"), "--format", "q8.24", "--out", path("dz.bin")});
    EXPECT_EQ(vanished.exit_code, 1);
    EXPECT_THAT(vanished.err, HasSubstr("dz.asm:1:9: 1e-9 is below the resolution of q8.24"));
}

TEST_F(CordicOptions, PrintOneDocumentOfJson) {
    for (const char* text : {"G1 X10 F600\nM3 S100\nG2 X20 I5\nM30\n", "G1 X1 F60\nM2\n", "M2\n"}) {
        const Ended ended = run({"cordic", "run", written("a.ngc", text), "--json"});
        const auto answer = nlohmann::ordered_json::parse(ended.out);
        EXPECT_EQ(ended.out, answer.dump(2) + "\n") << text;
        EXPECT_EQ(answer.at("fastest_mm_per_min").is_null(), answer.at("points").size() < 2) << text;
    }
}

TEST_F(CordicOptions, LeaveTheFileOfPulsesAsItWasWhereThereAreTooMany) {
    const std::string pulses = path("pulses.csv");
    write_content(pulses, "as it was");
    const Ended ended = run({"cordic",
                             "run",
                             written("many.ngc", "G1 X0.01 F600\nX2000\nM2\n"),
                             "--profile",
                             "trapezoid",
                             "--steps",
                             "1000000",
                             "--timer",
                             "1e10",
                             "--pulses",
                             pulses});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("pulses on one axis, more than 1000000000"));
    EXPECT_EQ(content_of(pulses), "as it was");
}

} // namespace
} // namespace millwright::test
