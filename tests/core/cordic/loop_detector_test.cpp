#include "core/cordic/assembler.h"
#include "core/cordic/run_report.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::cordic {
namespace {

Processor loop_processor(const std::string& text) {
    const Assembled made = assemble(text, "loop.asm");
    EXPECT_TRUE(made.errors.empty());
    return {{}, made.image};
}

const std::string to_and_fro = "MOV Vmax, 1\nMOV Amax, 1\nL: MOV XI, 1\nG01\nMOV XI, 2\nG01\nMOV PC, L\n";

TEST(LoopDetector, SeesALoopBeforeItHasFilledTheMemory) {
    Processor processor = loop_processor(to_and_fro);
    EXPECT_TRUE(run_watched(processor, usual_most_clocks));
    EXPECT_EQ(processor.state().stop, Stop::none);
    EXPECT_LT(processor.state().clocks.total, 3'000'000);
    EXPECT_LT(processor.published().size(), 30'000U);
}

// Longer than many looks are apart.
TEST(LoopDetector, SeesALongLoop) {
    std::string text = "MOV Vmax, 1\nMOV Amax, 1\nL: NOP\n";
    for (int n = 0; n < 200; ++n) {
        text += "MOV XI, " + std::to_string(n) + ".5\nG01\n";
    }
    Processor processor = loop_processor(text + "MOV PC, L\n");
    EXPECT_TRUE(run_watched(processor, usual_most_clocks));
    EXPECT_LT(processor.state().clocks.total, 10'000'000);
}

TEST(LoopDetector, LetsProgramsGoToTheirEnd) {
    // A full turn of 4,000 chords is in another state at each of them.
    Processor processor = loop_processor("MOV Vmax, 1\nMOV Amax, 1\nMOV XI, 5\nG01\nMOV XI, 0\nMOV YJ, 0\n"
                                         "MOV Dz, 0.00157079632679\nMOV N, 4000\nG03\nHLT\n");
    EXPECT_FALSE(run_watched(processor, usual_most_clocks));
    EXPECT_EQ(processor.state().stop, Stop::halted);
    EXPECT_EQ(processor.published().size(), 4001U);
}

TEST(LoopDetector, StopsAtTheLastClock) {
    Processor processor = loop_processor(to_and_fro);
    EXPECT_FALSE(run_watched(processor, 300));
    EXPECT_EQ(processor.state().clocks.total, 300);
}

} // namespace
} // namespace millwright::cordic
