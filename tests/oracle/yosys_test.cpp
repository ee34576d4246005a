// The processor's Verilog through synthesis: what a simulation does not see.
#include "core/cordic_rtl/processor_rtl.h"
#include "tests/support/oracle.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>

namespace millwright {
namespace {

using namespace cordic;
using testing::HasSubstr;

class Yosys : public OracleTest {
protected:
    Yosys() : OracleTest("yosys", "yosys") {}

    /// Reads every module of the processor, one of them without `left_out`, then does `commands`.
    [[nodiscard]] ProgramRun synthesized(const NumberFormat& format,
                                         const ProcessorSettings& settings,
                                         const std::string& commands,
                                         const std::string& left_out = "nothing") const {
        const test::ScratchFolder folder;
        std::string script;
        for (RtlFile& file : make_processor_rtl(settings, rtl_test_programs(format, 1, 1))) {
            if (file.name.ends_with(".v") && !file.name.ends_with("_tb.v")) {
                if (const auto at = file.text.find(left_out); at != std::string::npos) {
                    file.text.erase(at, left_out.size());
                }
                std::ofstream(folder.path() / file.name) << file.text;
                script += "read_verilog " + (folder.path() / file.name).string() + "; ";
            }
        }
        return run(
            {"-p", script + "hierarchy -check -top gcode_processor; proc; flatten; opt_clean; " + commands});
    }
};

const std::string no_latch = "check -assert; select -assert-none t:$dlatch t:$_DLATCH_*";

// Each register is a flip-flop, each wire has one driver, nothing goes round without one.
TEST_F(Yosys, FindsNoLatchNoLoopAndNothingUndrivenInTheProcessor) {
    ProcessorSettings over_bus;
    over_bus.publishing = Publishing::bus;
    over_bus.rounding = Rounding::nearest_even;
    over_bus.sequence = classic_sequence(CoordinateSystem::circular, 24);
    for (const auto& [format, settings] :
         {std::pair(fixed_format(12, 20), ProcessorSettings()), std::pair(fixed_format(2, 14), over_bus)}) {
        const ProgramRun ran = synthesized(format, settings, no_latch);
        EXPECT_EQ(ran.exit_code, 0) << ran.output;
        EXPECT_THAT(ran.output, HasSubstr("Found and reported 0 problems"));
    }
}

TEST_F(Yosys, FindsALatch) {
    const ProgramRun ran = synthesized(fixed_format(2, 14), {}, no_latch, "        stored = 0;\n");
    EXPECT_NE(ran.exit_code, 0);
    EXPECT_THAT(ran.output, HasSubstr("Assertion failed"));
}

} // namespace
} // namespace millwright
