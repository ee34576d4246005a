// What the cordic commands make of their options: none is passed over in silence, no number is none.
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;

const std::string arc = "assets/samples/thesis-arc.ngc";

class CordicOptions : public ::testing::Test {
protected:
    std::string written(const std::string& name, const std::string& text) const {
        const auto file = folder_.path() / name;
        write_content(file, text);
        return file.string();
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

private:
    ScratchFolder folder_;
};

TEST_F(CordicOptions, RefuseArcsThatTheFormatCannotKeepWithinTheTolerance) {
    const std::string file = written("f10.ngc", "G21 G90\nF60\nG2 X0 Y0 I10 J0\nM2\n");
    const Ended coarse = run({"cordic", "run", file, "--format", "q24.8", "--tolerance", "1e-7"});
    EXPECT_EQ(coarse.exit_code, 1);
    EXPECT_EQ(coarse.out, "");
    EXPECT_THAT(coarse.err, HasSubstr("f10.ngc:3:1: q24.8 holds the end of a chord 0.00"));
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
    const std::vector<std::vector<std::string>> uses{{"cordic", "run", arc, "--clock"},
                                                     {"cordic", "run", arc, "--tolerance"},
                                                     {"cordic", "run", arc, "--rapid"},
                                                     {"cordic", "run", arc, "--acceleration"},
                                                     {"cordic", "run", arc, "--jerk"},
                                                     {"cordic", "run", arc, "--period"},
                                                     {"cordic", "run", arc, "--steps"},
                                                     {"cordic", "run", arc, "--timer"},
                                                     {"cordic", "run", arc, "--plc", "x", "--scan"},
                                                     {"cordic", "sew", arc, "--needle-rpm"},
                                                     {"cordic", "sew", arc, "--needle-down"},
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
    EXPECT_THAT(run({"cordic", "run", arc, "--clock", "nan"}).err,
                HasSubstr("--clock: \"nan\" is no finite number"));
}

TEST_F(CordicOptions, OfGCodeAreRefusedForProgramsThatAreMadeAlready) {
    const std::string image = path("arc.bin");
    ASSERT_EQ(run({"cordic", "asm", arc, "--out", image, "--format", "q10.22"}).exit_code, 0);
    const std::string text = written("p.asm", ".format q10.22\nHLT\n");
    for (const std::string& file : {image, text}) {
        EXPECT_EQ(run({"cordic", "run", file, "--format", "q10.22"}).exit_code, 0);
        const Ended other = run({"cordic", "run", file, "--format", "f64"});
        EXPECT_EQ(other.exit_code, 1);
        EXPECT_THAT(other.err, HasSubstr("the program is in q10.22, not in f64"));
        const Ended chords = run({"cordic", "run", file, "--tolerance", "0.1"});
        EXPECT_EQ(chords.exit_code, 1);
        EXPECT_THAT(chords.err, HasSubstr("--tolerance is for G-code"));
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
    EXPECT_FALSE(points.back().contains("z")); // level
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
    const Ended large = run({"cordic", "run", file, "--ram", written("large.ram", std::string(0x4001, 'x'))});
    EXPECT_EQ(large.exit_code, 1);
    EXPECT_THAT(large.err, HasSubstr("large.ram: 16385 bytes, the RAM holds 16384"));
}

TEST_F(CordicOptions, TellThePlaceWhereAMicroprogramOrTheLogicHasNoAnswer) {
    const std::string halt = written("h.asm", "HLT\n");
    const Ended empty = run({"cordic", "run", halt, "--microprogram", written("empty.micro", "")});
    EXPECT_EQ(empty.exit_code, 1);
    EXPECT_THAT(empty.err, HasSubstr("empty.micro:1:1: the microprogram has no words"));
    const Ended off = run({"cordic", "run", halt, "--microprogram", written("off.micro", "CONT\n\nCONT\n")});
    EXPECT_EQ(off.exit_code, 1);
    EXPECT_THAT(off.err, HasSubstr("off.micro:3:1: the microprogram ran behind its last word"));
    const std::string own = written("own.asm", "MOV P, 50\n  MUSER\nHLT\n");
    const Ended user = run({"cordic", "run", own, "--plc", "assets/samples/interlock.plc"});
    EXPECT_EQ(user.exit_code, 1);
    EXPECT_THAT(user.err, HasSubstr("own.asm:2:3: M50 is none of the machine's own commands"));
}

TEST_F(CordicOptions, WarnOfRunsThatAreNotAsPromised) {
    const auto warnings = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"cordic", "run"});
        words.emplace_back("--json");
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        const auto found = nlohmann::json::parse(ended.out).at("warnings");
        EXPECT_EQ(found.empty(), ended.err.find("warning: ") == std::string::npos) << ended.err;
        return found.dump();
    };
    EXPECT_EQ(warnings({arc}), "[]");
    EXPECT_THAT(warnings({arc, "--thesis-direction"}), HasSubstr("arcs turn the other way"));
    const std::string image = path("arc.bin");
    ASSERT_EQ(run({"cordic", "asm", arc, "--out", image}).exit_code, 0);
    EXPECT_EQ(warnings({image}), "[]");
    EXPECT_THAT(warnings({image, "--iterations", "9"}), HasSubstr("was made for 29 steps"));
    const std::string slow = written("slow.ngc", "G21 G90\nF1\nG1 X10 Y7\nM2\n");
    EXPECT_THAT(warnings({slow, "--format", "q10.6", "--acceleration", "50"}), HasSubstr("beside the feed"));
}

TEST_F(CordicOptions, ShowBytesThatAreNoTextAsNumbers) {
    const Ended ended = run({"cordic", "run", written("raw.asm", "MOV \x1b[31m\x07\xff, 1\n")});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("raw.asm:1:5: \"\\x1b[31m\\x07\\xff\" is no register"));
    const Ended umlaut = run({"cordic", "run", written("word.asm", "MOV \xc3\x84, 1\n")});
    EXPECT_THAT(umlaut.err, HasSubstr("\"\xc3\x84\" is no register"));
}

} // namespace
} // namespace millwright::test
