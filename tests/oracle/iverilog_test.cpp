#include "core/cordic_rtl/processor_rtl.h"
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
#include <utility>
#include <vector>

namespace millwright {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using namespace cordic;

class Iverilog : public OracleTest {
protected:
    Iverilog() : OracleTest("iverilog", "iverilog") {}

    /// What the test bench of `module` prints; its exit code is 0 exactly if that is PASS.
    [[nodiscard]] std::string simulated(const std::vector<RtlFile>& files, const std::string& module) const {
        const test::ScratchFolder folder;
        std::vector<std::string> arguments = {
            "-g2001", "-Wall", "-s", module + "_tb", "-o", (folder.path() / "sim").string()};
        for (const RtlFile& file : files) {
            std::ofstream(folder.path() / file.name) << file.text;
            if (file.name.ends_with(".v")) {
                arguments.push_back((folder.path() / file.name).string());
            }
        }
        const ProgramRun compiled = run(arguments);
        EXPECT_EQ(compiled.exit_code, 0) << compiled.output;
        EXPECT_EQ(compiled.output, "");
        std::string said =
            output_of("cd '" + folder.path().string() + "' && ./sim 2>&1 </dev/null; echo exit code $?");
        const std::string passed = "exit code 0\n";
        EXPECT_EQ(said.starts_with("PASS"), said.ends_with(passed)) << said;
        return said.substr(0, said.rfind("exit code"));
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

    /// Programs of about so many random instructions in `format`, and all ways to stop, through the whole
    /// processor.
    void expect_processor_passes(const NumberFormat& format,
                                 const ProcessorSettings& settings,
                                 std::int64_t instructions,
                                 std::uint64_t seed) const {
        const std::string said = simulated(
            make_processor_rtl(settings, rtl_test_programs(format, instructions, seed)), "gcode_processor");
        const std::string passed = "PASS ";
        ASSERT_THAT(said, StartsWith(passed)) << to_text(format);
        EXPECT_GE(std::stoll(said.substr(passed.size())), instructions) << "the random program stopped early";
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

// Each clock of each instruction: pins, registers, records, clocks of CORDIC, and why it stops.
TEST_F(Iverilog, ProcessorGivesTheModelsBitsAndPinsInEveryClock) {
    expect_processor_passes(fixed_format(12, 20), {}, 300, 1);
}

TEST_F(Iverilog, ProcessorGivesThemOverTheBusWithWaitStatesAndOtherSettings) {
    ProcessorSettings settings;
    settings.publishing = Publishing::bus;
    settings.wait_states = 2;
    settings.sense = ArcSense::thesis;
    settings.halves_acceleration = false;
    settings.rounding = Rounding::nearest_even;
    settings.sequence = classic_sequence(CoordinateSystem::circular, 24);
    expect_processor_passes(fixed_format(10, 38), settings, 150, 2);
}

TEST_F(Iverilog, ProcessorGivesThemForTheNarrowestAndTheWidestWord) {
    for (const Rounding rounding : {Rounding::truncate, Rounding::toward_zero, Rounding::nearest}) {
        ProcessorSettings settings;
        settings.rounding = rounding;
        expect_processor_passes(fixed_format(3, 5), settings, 100, 3);
        expect_processor_passes(fixed_format(3, 61), settings, 100, 4);
    }
}

TEST_F(Iverilog, SequencerDoesItsSixteenOperationsAsTheModel) {
    EXPECT_EQ(
        simulated(make_processor_rtl({}, rtl_test_programs(fixed_format(2, 14), 10, 5)), "micro_sequencer"),
        "PASS 4000 operations\n");
}

// The bench of the processor must be able to fail: one wrong digit of an angle, a flag of Pre, a clock of the
// bus, and a signal of the micro-ROM are found.
TEST_F(Iverilog, ProcessorsBenchFindsWhatIsWrong) {
    const auto files = make_processor_rtl({}, rtl_test_programs(fixed_format(12, 20), 60, 6));
    const std::vector<std::pair<std::string, std::string>> faults = {
        {"32'h00076b1a", "32'h00076b1b"},
        {"assign f2 = xq[W-1];", "assign f2 = 1'b0;"},
        {"waits <= WAIT_STATES", "waits <= 1"},
        {"count_chord = control[7]", "count_chord = 1'b0"}};
    for (const auto& [right, wrong] : faults) {
        auto spoilt = files;
        int count = 0;
        for (RtlFile& file : spoilt) {
            for (auto at = file.text.find(right); at != std::string::npos;
                 at = file.text.find(right, at + 1)) {
                file.text.replace(at, right.size(), wrong);
                ++count;
            }
        }
        EXPECT_GT(count, 0) << right;
        EXPECT_THAT(simulated(spoilt, "gcode_processor"), HasSubstr("FAIL")) << right;
    }
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

TEST_F(IverilogInFull, ProcessorGivesTheModelsBitsAndPinsForTenThousandInstructions) {
    expect_processor_passes(fixed_format(12, 20), {}, 10'000, 7);
}

} // namespace
} // namespace millwright
