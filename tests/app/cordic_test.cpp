#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

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
    EXPECT_NEAR(answer.at("degrees").get<double>(), 126.8698976458, 1e-5);
    EXPECT_EQ(answer.at("clocks"), 25);
}

TEST(Cordic, SaysWhatDoesNotFit) {
    const Ended large = run({"cordic", "rotate", "1.9", "0", "30", "--format", "q2.22"});
    EXPECT_EQ(large.exit_code, 1);
    EXPECT_THAT(large.err, HasSubstr("does not fit into q2.22"));
    const Ended format = run({"cordic", "rotate", "1", "0", "30", "--format", "q2"});
    EXPECT_EQ(format.exit_code, 1);
    EXPECT_THAT(format.err, HasSubstr("\"q2\" is no number format"));
    EXPECT_EQ(run({"cordic", "rotate", "1", "0"}).exit_code, 2);
    EXPECT_EQ(run({"cordic", "rotate", "1", "0", "10", "--iterations", "63"}).exit_code, 2);
}

TEST(Cordic, AccuracyWritesItsTableAndPictures) {
    const ScratchFolder folder;
    const Ended ended = run({"cordic", "accuracy", "--out", folder.path().string(), "--random", "1000"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(folder.path() / "accuracy.csv"), HasSubstr("q2.14,truncate,thesis 29,65536,"));
    for (const char* name : {"bounds.svg",
                             "e1-pre.svg",
                             "e3-rotation.svg",
                             "e4-angle.svg",
                             "e4-length.svg",
                             "e5-errors.svg",
                             "e5-values.svg",
                             "e6-arc.svg",
                             "e7-program.svg"}) {
        EXPECT_THAT(content_of(folder.path() / name), HasSubstr("</svg>")) << name;
    }
    EXPECT_THAT(ended.out, HasSubstr("E5"));
}

const std::string arc = "assets/samples/thesis-arc.ngc";

TEST(Cordic, RunsTheThesissArcAndTellsPointsClocksAndErrors) {
    const Ended ended = run({"cordic", "run", arc, "--format", "f64", "--json"});
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
    EXPECT_EQ(run({"cordic", "asm", arc, "--out", image}).exit_code, 0);
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
    EXPECT_EQ(run({"cordic", "run", arc, "--trace", waves.string(), "--tolerance", "1"}).exit_code, 0);
    EXPECT_THAT(content_of(waves), HasSubstr("$enddefinitions $end"));
}

TEST(Cordic, ProgramsThatCannotRunSayWhy) {
    const ScratchFolder folder;
    const auto file = folder.path() / "part.ngc";
    write_content(file, "G21\nG0 X1\nG0 Z2\nM2\n");
    const Ended axis = run({"cordic", "run", file.string()});
    EXPECT_EQ(axis.exit_code, 1);
    EXPECT_THAT(axis.err, HasSubstr("part.ngc:3: the CORDIC processor has no axis Z"));
    EXPECT_EQ(run({"cordic", "run", file.string(), "--other-axes"}).exit_code, 0);
    const auto text = folder.path() / "wrong.asm";
    write_content(text, "G01\n MOV Q, 1\n");
    const Ended wrong = run({"cordic", "run", text.string()});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.err, HasSubstr("wrong.asm:2:6: \"Q\" is no register"));
    const auto endless = folder.path() / "endless.asm";
    write_content(endless, "again: MOV PC, again\n");
    const Ended stopped = run({"cordic", "run", endless.string(), "--clocks", "1000"});
    EXPECT_EQ(stopped.exit_code, 1);
    EXPECT_THAT(stopped.err, HasSubstr("not at its end after 1000 clocks"));
    EXPECT_EQ(run({"cordic", "disasm", file.string() + ".bin"}).exit_code, 1);
}

TEST(Cordic, WritesHardwareForFixedPoint) {
    const ScratchFolder folder;
    const Ended ended =
        run({"cordic", "rtl", "--format", "q2.22", "--out", folder.path().string(), "--vectors", "10"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(folder.path() / "cordic_core.v"), HasSubstr("module cordic_core"));
    EXPECT_THAT(content_of(folder.path() / "cordic_pipeline.v"), HasSubstr("module cordic_pipeline"));
    EXPECT_THAT(content_of(folder.path() / "cordic_tb.v"), HasSubstr("vectors.hex"));
    const Ended floating = run({"cordic", "rtl", "--format", "f32", "--out", folder.path().string()});
    EXPECT_EQ(floating.exit_code, 1);
    EXPECT_THAT(floating.err, HasSubstr("hardware is made for fixed point"));
}

TEST(Cordic, ComparesWithTheMicrocontrollerOfTheThesis) {
    const Ended ended = run({"cordic", "compare"});
    EXPECT_EQ(ended.exit_code, 0);
    for (const char* figure : {"10696", "44876", "6486486", "99.308 %", "144.5", "6.685 %", "675"}) {
        EXPECT_THAT(ended.out, HasSubstr(figure));
    }
}

} // namespace
} // namespace millwright::test
