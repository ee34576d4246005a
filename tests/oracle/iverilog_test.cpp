#include "core/cordic/rtl.h"
#include "tests/support/oracle.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace millwright {
namespace {

using testing::HasSubstr;
using namespace cordic;

class Iverilog : public OracleTest {
protected:
    Iverilog() : OracleTest("iverilog", "iverilog") {}

    /// What the test bench of `module` prints.
    [[nodiscard]] std::string simulated(const std::vector<RtlFile>& files, const std::string& module) const {
        const test::ScratchFolder folder;
        for (const RtlFile& file : files) {
            std::ofstream(folder.path() / file.name) << file.text;
        }
        const ProgramRun compiled = run({"-g2001",
                                         "-Wall",
                                         "-o",
                                         (folder.path() / "sim").string(),
                                         (folder.path() / (module + ".v")).string(),
                                         (folder.path() / (module + "_tb.v")).string()});
        EXPECT_EQ(compiled.exit_code, 0) << compiled.output;
        EXPECT_EQ(compiled.output, "");
        return output_of("cd '" + folder.path().string() + "' && ./sim 2>&1 </dev/null");
    }

    void expect_both_pass(const NumberFormat& format,
                          const Sequence& sequence,
                          std::int64_t count,
                          std::uint64_t seed) const {
        const auto files = make_rtl(format, sequence, count, seed);
        for (const char* module : {"cordic_core", "cordic_pipeline"}) {
            EXPECT_EQ(simulated(files, module), fmt::format("PASS {} vectors\n", count))
                << module << " of " << to_text(format) << ", " << sequence.step_count << " steps";
        }
    }

private:
    static std::string output_of(const std::string& command) {
        FILE* pipe = popen(command.c_str(), "r");
        if (pipe == nullptr) {
            throw std::runtime_error("cannot start " + command);
        }
        std::string text;
        std::array<char, 4096> buffer{};
        while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
            text.append(buffer.data(), count);
        }
        pclose(pipe);
        return text;
    }
};

TEST_F(Iverilog, GivesTheBitsOfTheModelForTheThesisFormat) {
    expect_both_pass(fixed_format(2, 22), thesis_sequence(), 2000, 1);
}

TEST_F(Iverilog, GivesTheBitsOfTheModelInEveryRoundingSystemAndSequence) {
    for (const Rounding rounding :
         {Rounding::truncate, Rounding::toward_zero, Rounding::nearest, Rounding::nearest_even}) {
        for (const CoordinateSystem m :
             {CoordinateSystem::circular, CoordinateSystem::linear, CoordinateSystem::hyperbolic}) {
            expect_both_pass(fixed_format(2, 14, rounding), thesis_sequence(m), 150, 2);
            expect_both_pass(fixed_format(5, 30, rounding), classic_sequence(m, 24), 150, 3);
        }
    }
}

TEST_F(Iverilog, GivesTheBitsOfTheModelForTheWidestWord) {
    expect_both_pass(fixed_format(2, 62), thesis_sequence(), 500, 4);
    expect_both_pass(
        fixed_format(4, 60, Rounding::nearest), classic_sequence(CoordinateSystem::circular, 40), 500, 5);
}

// The benches must be able to fail: one wrong digit of one angle is found.
TEST_F(Iverilog, FindsAWrongAngle) {
    auto files = make_rtl(fixed_format(2, 22), thesis_sequence(), 200, 6);
    int spoilt = 0;
    for (RtlFile& file : files) {
        const auto at = file.text.find("24'h1dac67");
        if (at != std::string::npos) {
            file.text.replace(at, 10, "24'h1dac66");
            ++spoilt;
        }
    }
    EXPECT_EQ(spoilt, 2);
    EXPECT_THAT(simulated(files, "cordic_core"), HasSubstr("FAIL"));
    EXPECT_THAT(simulated(files, "cordic_pipeline"), HasSubstr("FAIL"));
}

// Two tests, so that both run at a time: half a minute and nearly one.
using IverilogInFull = Iverilog;

TEST_F(IverilogInFull, CoreGivesTheBitsOfTheModelForAHundredThousandVectors) {
    EXPECT_EQ(simulated(make_rtl(fixed_format(2, 22), thesis_sequence(), 100'000, 1), "cordic_core"),
              "PASS 100000 vectors\n");
}

TEST_F(IverilogInFull, PipelineGivesTheBitsOfTheModelForAHundredThousandVectors) {
    EXPECT_EQ(simulated(make_rtl(fixed_format(2, 22), thesis_sequence(), 100'000, 1), "cordic_pipeline"),
              "PASS 100000 vectors\n");
}

} // namespace
} // namespace millwright
