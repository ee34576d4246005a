#include "tests/app/program.h"
#include "tests/app/shipped_files.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;

TEST(Cordic, RotatesAndAnswersInJson) {
    const Ended ended = run({"cordic", "rotate", "3", "-4", "-400.5", "--json"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto answer = nlohmann::json::parse(ended.out);
    EXPECT_NEAR(answer.at("x").get<double>(), -0.3165743, 5e-7); // of (3, -4) by -40.5 degrees
    EXPECT_NEAR(answer.at("y").get<double>(), -4.9899680, 5e-7);
    EXPECT_LT(answer.at("error").get<double>(), 3.2e-7);
    EXPECT_EQ(answer.at("clocks"), 37);
    EXPECT_TRUE(answer.at("z").is_number());
}

TEST(Cordic, VectorAnswersWithLengthAndDegrees) {
    const Ended ended =
        run({"cordic", "vector", "-3", "4", "--format", "q4.28", "--iterations", "24", "--json"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto answer = nlohmann::json::parse(ended.out);
    EXPECT_NEAR(answer.at("magnitude").get<double>(), 5.0, 1e-6);
    EXPECT_NEAR(answer.at("angle_deg").get<double>(), 126.8698976458, 1e-5);
    EXPECT_EQ(answer.at("clocks"), 25);
    const int shift = answer.at("shift").get<int>();
    EXPECT_EQ(shift, -2); // to the right: its gain must not overflow
    const auto length = std::stoull(answer.at("words").at(0).get<std::string>(), nullptr, 16);
    EXPECT_EQ(std::ldexp(static_cast<double>(length), -28 - shift), answer.at("magnitude").get<double>());
}

TEST(Cordic, SaysWhatDoesNotFit) {
    const Ended large = run({"cordic", "rotate", "1.9", "0", "30", "--format", "q2.22"});
    EXPECT_EQ(large.exit_code, 1);
    EXPECT_THAT(large.err, HasSubstr("does not fit into q2.22"));
    const Ended format = run({"cordic", "rotate", "1", "0", "30", "--format", "q2"});
    EXPECT_EQ(format.exit_code, 2);
    EXPECT_THAT(format.err, HasSubstr("\"q2\" is not a number format"));
    EXPECT_EQ(run({"cordic", "rotate", "1", "0"}).exit_code, 2);
    EXPECT_EQ(run({"cordic", "rotate", "1", "0", "10", "--iterations", "63"}).exit_code, 2);
}

TEST(Cordic, AccuracyMeasuresOneFormatThatIsAskedFor) {
    const ScratchFolder folder;
    const auto out = folder.path().string();
    const std::vector<std::string> words{"cordic", "accuracy", "--out", out, "--random", "1000", "--format"};
    const auto of_format = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return run(more);
    };
    const Ended ended = of_format({"q3.20", "--rounding", "nearest", "--iterations", "18"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    std::istringstream table(content_of(folder.path() / "accuracy.csv"));
    std::vector<std::string> rows;
    for (std::string row; std::getline(table, row);) {
        rows.push_back(row);
    }
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_THAT(rows[1], testing::StartsWith("q3.20,nearest,classic 18,1000,"));
    EXPECT_THAT(content_of(folder.path() / "bounds.svg"), HasSubstr("q3.20"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "e1-pre.svg")) << "the thesis's are in binary64";
    EXPECT_THAT(of_format({"q1.15"}).err, HasSubstr("vectors of length 1 do not fit into q1.15"));
    EXPECT_THAT(of_format({"f32", "--rounding", "nearest"}).err,
                HasSubstr("--rounding applies only to fixed point"));
}

TEST(Cordic, AccuracyWritesItsTableAndPictures) {
    const ScratchFolder folder;
    const Ended ended = run({"cordic", "accuracy", "--out", folder.path().string(), "--random", "1000"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(folder.path() / "accuracy.csv"), HasSubstr("q2.14,truncate,thesis 29,65536,"));
    for (const char* name : {"bounds.svg",
                             "e1-pre.svg",
                             "e2-post.svg",
                             "e3-rotation.svg",
                             "e4-angle.svg",
                             "e4-length.svg",
                             "e5-errors.svg",
                             "e5-values.svg",
                             "e6-arc.svg",
                             "e6-errors.svg",
                             "e7-errors.svg",
                             "e7-program.svg"}) {
        EXPECT_THAT(content_of(folder.path() / name), HasSubstr("</svg>")) << name;
    }
    EXPECT_THAT(ended.out, HasSubstr("E5"));
}

TEST(Cordic, RunsTheThesissArcAndTellsPointsClocksAndErrors) {
    const Ended ended = run({"cordic", "run", thesis_arc, "--format", "f64", "--json"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto answer = nlohmann::json::parse(ended.out);
    const auto& points = answer.at("points");
    EXPECT_EQ(points.back().at("x"), 5.0);
    EXPECT_EQ(points.back().at("y"), 5.0);
    EXPECT_LT(answer.at("errors").at("position_mm").get<double>(), 119 * 6e-8 * 5.0 + 1e-6);
    // The way to the start and the last chord are lines, the other chords are turned.
    EXPECT_EQ(answer.at("clocks").at("cordic"), 2 * 74 + (points.size() - 2) * 111);
    EXPECT_GT(answer.at("fastest_mm_per_min").get<double>(), 0.0);
}

TEST(Cordic, AssemblesAndDisassemblesToTheSame) {
    const ScratchFolder folder;
    const std::string image = (folder.path() / "arc.bin").string();
    const std::string text = (folder.path() / "arc.asm").string();
    EXPECT_EQ(run({"cordic", "asm", thesis_arc, "--out", image}).exit_code, 0);
    const Ended shown = run({"cordic", "disasm", image});
    EXPECT_EQ(shown.exit_code, 0);
    EXPECT_THAT(shown.out, HasSubstr("G03"));
    write_content(text, shown.out);
    const std::string again = (folder.path() / "again.bin").string();
    EXPECT_EQ(run({"cordic", "asm", text, "--out", again}).exit_code, 0);
    EXPECT_EQ(content_of(image), content_of(again));
    EXPECT_EQ(run({"cordic", "run", again, "--clock", "1e6"}).exit_code, 0);
}

TEST(Cordic, WritesWaves) {
    const ScratchFolder folder;
    const auto waves = folder.path() / "arc.vcd";
    EXPECT_EQ(run({"cordic", "run", thesis_arc, "--trace", waves.string(), "--arc-tolerance", "1"}).exit_code,
              0);
    EXPECT_THAT(content_of(waves), HasSubstr("$enddefinitions $end"));
}

TEST(Cordic, ProgramsThatCannotRunSayWhy) {
    const ScratchFolder folder;
    const auto file = folder.path() / "part.ngc";
    write_content(file, "G21\nG0 X1\nG0 Z2 A3\nM2\n");
    const Ended axis = run({"cordic", "run", file.string()});
    EXPECT_EQ(axis.exit_code, 1);
    EXPECT_THAT(axis.err, HasSubstr("part.ngc:3:7: the CORDIC processor has no axis A"));
    EXPECT_EQ(run({"cordic", "run", file.string(), "--other-axes"}).exit_code, 0);
    const auto text = folder.path() / "wrong.asm";
    write_content(text, "G01\n MOV Q, 1\n");
    const Ended wrong = run({"cordic", "run", text.string()});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.err, HasSubstr("wrong.asm:2:6: \"Q\" is not a register"));
    const auto endless = folder.path() / "endless.asm";
    write_content(endless, "again: MOV PC, again\n");
    const Ended stopped = run({"cordic", "run", endless.string(), "--clocks", "1000"});
    EXPECT_EQ(stopped.exit_code, 1);
    EXPECT_THAT(stopped.err, HasSubstr("did not end within 1000 clocks"));
    EXPECT_EQ(run({"cordic", "disasm", file.string() + ".bin"}).exit_code, 1);
}

TEST(Cordic, RunsAProgramWithoutAnEndToItsLastLineWithANotice) {
    const ScratchFolder scratch;
    const std::string file = (scratch.path() / "part.ngc").string();
    write_content(file, "G21 G90\nG0 X1 Y1 Z5\nG1 Z-1 F100\n");
    const Ended ended = run({"cordic", "run", file});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(
        ended.err,
        HasSubstr("part.ngc: the program does not end with M2, M30 or %; it was read to its last line\n"));
    write_content(file, "G21 G90\nG0 X1 Y1 Z5\nG1 Z-1 F100\nM2\n");
    const Ended whole = run({"cordic", "run", file});
    EXPECT_EQ(whole.err, "");
    EXPECT_EQ(whole.out, ended.out);
}

TEST(Cordic, SaysWhatIsWrongWithEveryKindOfBadInput) {
    struct Bad {
        std::string name, text, message;
        std::vector<std::string> options{};
    };
    const ScratchFolder folder;
    const auto micro = (folder.path() / "deep.micro").string();
    write_content(micro, "CONT\nA: CJS always A\n");
    const auto label = (folder.path() / "label.micro").string();
    write_content(label, "CONT\n CJP always NOWHERE\n");
    for (const Bad& bad : {
             Bad{"a.ngc", "G21 F100\nG2 X1 Y0 I5 J0\nM2\n", "a.ngc:2:1: the arc's radius is"},
             Bad{"b.ngc",
                 "G21 S100 M3\nG0 X1\n G33 Z1 K1\nM2\n",
                 "b.ngc:3:2: the CORDIC processor does not support feed"},
             Bad{"c.ngc",
                 "G21\nG0 X300\nM2\n",
                 "c.ngc:2:4: X 300 does not fit into q8.24",
                 {"--format", "q8.24", "--acceleration", "100"}},
             Bad{"d.asm",
                 ".format q4.12\nMOV X0, -7\nMOV Vmax, 1\nMOV XI, 7\nG01\nHLT\n",
                 "d.asm:5:1: the processor stopped at the instruction at 0x000f: a number did not fit into "
                 "the word (choose a number format with more integer bits)"},
             Bad{"j.ngc",
                 "G21 F100\nG0 X-100\nG1 X100\nM2\n",
                 "j.ngc:3:1: the processor stopped at the instruction at",
                 {"--format", "q8.24", "--acceleration", "100"}},
             Bad{"e.asm", "MOV PC, away\n", "e.asm:1:9: label away is not defined"},
             Bad{"f.asm",
                 "HLT\n",
                 "deep.micro:2:1: a microprogram nested calls more than 4 deep",
                 {"--microprogram", micro}},
             Bad{"g.asm", "HLT\n", "label.micro:2:", {"--microprogram", label}},
             Bad{"h.bin", "MWCP?", "h.bin"},
             Bad{"i.ngc", "G21 S100 M19 R0\nM2\n", "does not support spindle orientation"},
         }) {
        const auto file = folder.path() / bad.name;
        write_content(file, bad.text);
        std::vector<std::string> words{"cordic", "run", file.string()};
        words.insert(words.end(), bad.options.begin(), bad.options.end());
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 1) << bad.name;
        EXPECT_THAT(ended.err, HasSubstr(bad.message)) << bad.name;
    }
    const auto still = folder.path() / "still.ngc";
    write_content(still, "G21\nG0 X1\nG0 X1\nG0 X1.001\nM2\n");
    const Ended ended = run({"cordic", "run", still.string(), "--format", "q16.8"});
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.err, HasSubstr("still.ngc:3:1: a move of zero length is skipped"));
    EXPECT_THAT(ended.err, HasSubstr("still.ngc:4:1: a move of 0.001 mm is below the resolution of q16.8"));
}

TEST(Cordic, PutsSetPointsInTimeAndMeasuresTheirPulses) {
    const ScratchFolder folder;
    const auto pulses = folder.path() / "pulses.csv";
    for (const char* profile : {"trapezoid", "s-curve"}) {
        const Ended ended = run({"cordic",
                                 "run",
                                 thesis_arc,
                                 "--profile",
                                 profile,
                                 "--steps",
                                 "100",
                                 "--timer",
                                 "1e5",
                                 "--pulses",
                                 pulses.string(),
                                 "--json"});
        ASSERT_EQ(ended.exit_code, 0) << ended.err;
        const auto motion = nlohmann::json::parse(ended.out).at("motion");
        EXPECT_NEAR(motion.at("max_acceleration_mm_s2").get<double>(), 250.0, 1e-3); // half of Amax
        EXPECT_LE(motion.at("max_speed_mm_s").get<double>(), 50.0 + 1e-3);           // the rapid's
        std::int64_t count = 0;
        for (const auto& axis : motion.at("axes")) {
            count += axis.at("pulses").get<std::int64_t>();
            EXPECT_LE(axis.at("max_jitter_s").get<double>(), 0.5e-5 + 1e-12); // half a tick
            EXPECT_LE(axis.at("end_error_steps").get<double>(), 0.5);
        }
        const std::string text = content_of(pulses);
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), count + 1);
    }
    EXPECT_EQ(run({"cordic", "run", thesis_arc, "--pulses", pulses.string()}).exit_code, 1);
}

TEST(Cordic, WritesServoSetPointsThatAgreeWithOneAnother) {
    const ScratchFolder folder;
    const auto servo = folder.path() / "servo.csv";
    const Ended ended = run({"cordic",
                             "run",
                             thesis_arc,
                             "--profile",
                             "s-curve",
                             "--servo",
                             servo.string(),
                             "--period",
                             "0.01",
                             "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const double seconds = nlohmann::json::parse(ended.out).at("motion").at("time_s").get<double>();
    std::istringstream lines(content_of(servo));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "time,X,Y,Z,vX,vY,vZ,aX,aY,aZ");
    std::vector<std::array<double, 10>> rows;
    while (std::getline(lines, line)) {
        std::ranges::replace(line, ',', ' ');
        std::istringstream words(line);
        for (double& value : rows.emplace_back()) {
            words >> value;
        }
    }
    ASSERT_GT(rows.size(), 100U);
    EXPECT_NEAR(rows.back()[0], seconds, 1e-6 * seconds);
    EXPECT_NEAR(rows.back()[1], 5.0, 1e-5);
    for (std::size_t n = 1; n < rows.size(); ++n) {
        const double period = rows[n][0] - rows[n - 1][0];
        for (std::size_t axis = 1; axis <= 3;
             ++axis) { // what is between them is no farther than 250 mm/s2 takes
            const double mean = 0.5 * (rows[n][axis + 3] + rows[n - 1][axis + 3]);
            EXPECT_NEAR(rows[n][axis] - rows[n - 1][axis], mean * period, 250.0 * period * period);
        }
    }
    EXPECT_EQ(run({"cordic", "run", thesis_arc, "--servo", servo.string()}).exit_code, 1);
}

TEST(Cordic, PrintsTheMicroprogramThatItRunsOn) {
    const ScratchFolder folder;
    const Ended text = run({"cordic", "microprogram"});
    EXPECT_EQ(text.exit_code, 0);
    EXPECT_THAT(text.out, HasSubstr("SETPOINT: LDCT LAST_STEP"));
    const auto file = folder.path() / "our.micro";
    write_content(file, text.out);
    const Ended ours = run({"cordic", "run", thesis_arc});
    const Ended again = run({"cordic", "run", thesis_arc, "--microprogram", file.string()});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(again.out, ours.out);
}

TEST(Cordic, WritesHardwareForFixedPoint) {
    const ScratchFolder folder;
    const Ended ended =
        run({"cordic", "rtl", "--format", "q2.22", "--out", folder.path().string(), "--vectors", "10"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(folder.path() / "cordic_core.v"), HasSubstr("module cordic_core"));
    EXPECT_THAT(content_of(folder.path() / "cordic_pipeline.v"), HasSubstr("module cordic_pipeline"));
    EXPECT_THAT(content_of(folder.path() / "cordic_core_tb.v"), HasSubstr("vectors.hex"));
    EXPECT_THAT(content_of(folder.path() / "cordic_pipeline_tb.v"), HasSubstr("vectors.hex"));
    const Ended floating = run({"cordic", "rtl", "--format", "f32", "--out", folder.path().string()});
    EXPECT_EQ(floating.exit_code, 1);
    EXPECT_THAT(floating.err, HasSubstr("hardware can only be generated for fixed point"));
}

TEST(Cordic, WritesTheWholeProcessorAsHardware) {
    const ScratchFolder folder;
    const std::string out = folder.path().string();
    const Ended random = run({"cordic", "rtl-processor", "--out", out, "--instructions", "10"});
    EXPECT_EQ(random.exit_code, 0) << random.err;
    EXPECT_THAT(random.out, HasSubstr("iverilog -g2001 -s gcode_processor_tb"));
    EXPECT_THAT(content_of(folder.path() / "arithmetic_unit.v"), HasSubstr("q12.20"));
    const Ended of_arc = run({"cordic", "rtl-processor", thesis_arc, "--out", out});
    EXPECT_EQ(of_arc.exit_code, 0) << of_arc.err;
    EXPECT_THAT(content_of(folder.path() / "gcode_processor_tb.v"), HasSubstr("RUNS = 1;"));
    for (const auto& [option, value] : {std::pair("--instructions", "10"), {"--seed", "7"}}) {
        const Ended both = run({"cordic", "rtl-processor", thesis_arc, "--out", out, option, value});
        EXPECT_EQ(both.exit_code, 2) << option;
        EXPECT_THAT(both.err, HasSubstr(std::string("FILE excludes ") + option));
    }
    const Ended folder_for_file = run({"cordic", "rtl-processor", out, "--out", out});
    EXPECT_EQ(folder_for_file.exit_code, 1);
    EXPECT_THAT(folder_for_file.err, testing::Not(HasSubstr("actually")));
    const auto endless = folder.path() / "endless.asm";
    write_content(endless, ".format q12.20\nAGAIN: MOV PC, AGAIN\n");
    for (const auto& [options, reason] :
         {std::pair(std::vector<std::string>{"--format", "f32"}, "fixed point"),
          std::pair(std::vector<std::string>{"--matlab-zero"}, "sign(0)"),
          std::pair(std::vector<std::string>{"--iterations", "3"}, "every direction"),
          std::pair(std::vector<std::string>{endless.string()}, "clocks")}) {
        std::vector<std::string> arguments = {"cordic", "rtl-processor", "--out", out};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Ended refused = run(arguments);
        EXPECT_EQ(refused.exit_code, 1);
        EXPECT_THAT(refused.err, HasSubstr(reason));
    }
}

TEST(Cordic, ComparesWithTheMicrocontrollerOfTheThesis) {
    const Ended ended = run({"cordic", "compare"});
    EXPECT_EQ(ended.exit_code, 0);
    for (const char* figure : {"10696", "44876", "6486486", "99.308 %", "144.5", "6.685 %", "675"}) {
        EXPECT_THAT(ended.out, HasSubstr(figure));
    }
    EXPECT_EQ(nlohmann::json::parse(run({"cordic", "compare", "--json"}).out).at("screw_rpm"), 675.0);
}

TEST(Cordic, SewsAProgramAndSaysWhatComesTooLate) {
    const ScratchFolder folder;
    const auto file = folder.path() / "seam.ngc";
    write_content(file, "G21 F600\nG1 X3\nG1 X6\nG1 X6 Y60\nM2\n");
    const Ended fast = run({"cordic", "sew", file.string(), "--json"});
    ASSERT_EQ(fast.exit_code, 0) << fast.err;
    const auto answer = nlohmann::json::parse(fast.out);
    EXPECT_EQ(answer.at("stitches"), 3);
    EXPECT_NEAR(answer.at("period_s").get<double>(), 0.02, 1e-12);
    EXPECT_EQ(answer.at("late_computations"), 0);
    EXPECT_EQ(answer.at("late_moves"), 1); // 60 mm in 13.3 ms: 13,500 turns per minute of the screw
    EXPECT_EQ(answer.at("first_late"), 3); // as the text below counts
    EXPECT_EQ(answer.at("first_late_line"), 4);
    const Ended slow = run({"cordic", "sew", file.string(), "--clock", "1000", "--screw-rpm", "1e5"});
    EXPECT_THAT(slow.out, HasSubstr("too late: computations 3, moves 0"));
    EXPECT_THAT(slow.out, HasSubstr("first: stitch 1, "));
    const Ended none = run({"cordic", "sew", file.string(), "--screw-rpm", "1e5", "--json"});
    EXPECT_TRUE(nlohmann::json::parse(none.out).at("first_late").is_null());
}

TEST(Cordic, RunsBesideTheLogicOfAMachine) {
    const Ended ended = run({"cordic",
                             "run",
                             thesis_arc,
                             "--plc",
                             "assets/samples/interlock.plc",
                             "--inputs",
                             "assets/samples/interlock.inputs",
                             "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto logic = nlohmann::json::parse(ended.out).at("logic");
    EXPECT_EQ(logic.at("end"), "finished");
    EXPECT_NEAR(logic.at("held_s").get<double>(), 2.0, 5e-3); // the door is open for two seconds
    EXPECT_EQ(logic.at("starved_s"), 0.0);
    EXPECT_GT(logic.at("outputs").size(), 3U);
    const ScratchFolder folder;
    write_content(folder / "stop.plc", "LD I1\nST STOP\n");
    write_content(folder / "stop.inputs", "5 I1 1\n");
    const Ended stopped = run({"cordic",
                               "run",
                               thesis_arc,
                               "--plc",
                               folder / "stop.plc",
                               "--inputs",
                               folder / "stop.inputs",
                               "--json"});
    EXPECT_EQ(stopped.exit_code, 1);
    EXPECT_THAT(stopped.err, HasSubstr("the logic stopped the machine before the end of the program"));
    EXPECT_EQ(nlohmann::json::parse(stopped.out).at("stop"), "stopped by the logic");
    const auto wrong = folder.path() / "wrong.plc";
    write_content(wrong, "LD I0\nST I1\n");
    const Ended refused = run({"cordic", "run", thesis_arc, "--plc", wrong.string()});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("wrong.plc:2:4: I1 cannot be set by the logic"));
    EXPECT_EQ(run({"cordic", "run", thesis_arc, "--inputs", "x"}).exit_code, 2);
}

TEST(Cordic, GivesTheAxesAllOfTheAccelerationWhereItIsAskedTo) {
    const auto largest = [](const std::vector<std::string>& more) {
        std::vector<std::string> words{"cordic", "run", thesis_arc, "--format", "f64", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        double most = 0.0;
        const auto answer = nlohmann::json::parse(run(words).out);
        for (const auto& point : answer.at("points")) {
            most = std::max(most, std::hypot(point.at("ax").get<double>(), point.at("ay").get<double>()));
        }
        return most;
    };
    EXPECT_NEAR(largest({}), 250.0, 1e-4);
    EXPECT_NEAR(largest({"--whole-acceleration"}), 500.0, 1e-4);
}

} // namespace
} // namespace millwright::test
