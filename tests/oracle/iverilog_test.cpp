#include "core/cordic/rtl.h"
#include "tests/support/oracle.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
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

    /// What the test bench prints.
    [[nodiscard]] std::string simulated(const std::vector<RtlFile>& files) const {
        const test::ScratchFolder folder;
        std::vector<std::string> arguments = {"-g2001", "-Wall", "-o", (folder.path() / "sim").string()};
        for (const RtlFile& file : files) {
            const auto path = folder.path() / file.name;
            std::ofstream(path) << file.text;
            if (path.extension() == ".v") {
                arguments.push_back(path.string());
            }
        }
        const ProgramRun compiled = run(arguments);
        EXPECT_EQ(compiled.exit_code, 0) << compiled.output;
        EXPECT_EQ(compiled.output, "");
        return output_of("cd '" + folder.path().string() + "' && ./sim 2>&1 </dev/null");
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

TEST_F(Iverilog, GivesTheBitsOfTheModelForAHundredThousandVectors) {
    EXPECT_THAT(simulated(make_rtl(fixed_format(2, 22), thesis_sequence(), 100'000, 1)),
                HasSubstr("PASS 2000 iterative 100000 pipelined"));
}

TEST_F(Iverilog, GivesTheBitsOfTheModelInEveryRoundingSystemAndSequence) {
    for (const Rounding rounding :
         {Rounding::truncate, Rounding::toward_zero, Rounding::nearest, Rounding::nearest_even}) {
        for (const CoordinateSystem m :
             {CoordinateSystem::circular, CoordinateSystem::linear, CoordinateSystem::hyperbolic}) {
            const NumberFormat narrow = fixed_format(2, 14, rounding);
            const NumberFormat wide = fixed_format(5, 30, rounding);
            EXPECT_THAT(simulated(make_rtl(narrow, thesis_sequence(m), 150, 2)),
                        HasSubstr("PASS 150 iterative 150"));
            EXPECT_THAT(simulated(make_rtl(wide, classic_sequence(m, 24), 150, 3)),
                        HasSubstr("PASS 150 iterative 150"));
        }
    }
}

TEST_F(Iverilog, GivesTheBitsOfTheModelForTheWidestWord) {
    EXPECT_THAT(simulated(make_rtl(fixed_format(2, 62), thesis_sequence(), 500, 4)), HasSubstr("PASS"));
    EXPECT_THAT(simulated(make_rtl(fixed_format(4, 60, Rounding::nearest),
                                   classic_sequence(CoordinateSystem::circular, 40),
                                   500,
                                   5)),
                HasSubstr("PASS"));
}

// The bench must be able to fail: one wrong digit of one angle is found.
TEST_F(Iverilog, FindsAWrongAngle) {
    auto files = make_rtl(fixed_format(2, 22), thesis_sequence(), 200, 6);
    for (RtlFile& file : files) {
        const auto at = file.text.find("24'h1dac67");
        if (at != std::string::npos) {
            file.text.replace(at, 10, "24'h1dac66");
        }
    }
    EXPECT_THAT(simulated(files), HasSubstr("FAIL"));
}

} // namespace
} // namespace millwright
