// The motion behind the CORDIC processor on the command line: the program's own limits hold in it, and pulses
// that no timer can give are refused.
#include "tests/app/program.h"
#include "tests/app/scratch_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class CordicMotion : public ScratchFiles {
protected:
    /// A long line of 45 degrees with Amax = 100 mm/s2, of which the axes get half, then one with 40.
    [[nodiscard]] std::string two_lines() const {
        return written("lines.asm",
                       "MOV Vmax, 20\nMOV Amax, 100\nMOV XI, 50\nMOV YJ, 50\nG01\n"
                       "MOV Amax, 40\nMOV XI, 100\nMOV YJ, 50\nG01\nHLT\n");
    }
};

struct Motion {
    double acceleration = 0.0, seconds = 0.0;
    std::string warnings;
};

Motion motion_of(std::vector<std::string> words) {
    words.insert(words.begin(), {"cordic", "run"});
    words.insert(words.end(), {"--profile", "trapezoid", "--json"});
    const Ended ended = run(words);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto answer = nlohmann::json::parse(ended.out);
    const auto& motion = answer.at("motion");
    return {motion.at("max_acceleration_mm_s2").get<double>(),
            motion.at("time_s").get<double>(),
            answer.at("warnings").dump()};
}

constexpr double of_single_precision = 1e-3;

TEST_F(CordicMotion, AcceleratesAsTheProgramSaysWhateverItIsWrittenIn) {
    const std::string text = two_lines();
    const std::string image = path("lines.bin");
    ASSERT_EQ(run({"cordic", "asm", text, "--out", image}).exit_code, 0);
    // A ramp up to 20 mm/s at 50 mm/s2, one down at 20 mm/s2; the corner between takes next to no time.
    const double way = std::hypot(50.0, 50.0) + 50.0;
    const double ramps = 0.5 * 20.0 / 50.0 + 0.5 * 20.0 / 20.0;
    for (const std::string& file : {text, image}) {
        const Motion motion = motion_of({file});
        EXPECT_NEAR(motion.acceleration, 50.0, of_single_precision);
        EXPECT_GE(motion.seconds, way / 20.0 + ramps - of_single_precision);
        EXPECT_EQ(motion.warnings, "[]");
    }
    EXPECT_NEAR(motion_of({text, "--whole-acceleration"}).acceleration, 100.0, of_single_precision);
}

TEST_F(CordicMotion, IsMadeSlowerByAnOptionNeverFaster) {
    const std::string text = two_lines();
    EXPECT_NEAR(motion_of({text, "--acceleration", "30"}).acceleration, 15.0, of_single_precision);
    const Motion held = motion_of({text, "--acceleration", "1000"});
    EXPECT_NEAR(held.acceleration, 50.0, of_single_precision);
    EXPECT_THAT(held.warnings, HasSubstr("the program's own Amax, which applies: 50 mm/s2"));
    const Ended meaningless = run({"cordic", "run", text, "--acceleration", "30"});
    EXPECT_EQ(meaningless.exit_code, 1);
    EXPECT_THAT(meaningless.err, HasSubstr("--acceleration applies only to G-code and to a motion"));
}

TEST_F(CordicMotion, OfPulsesThatTheTimerCannotGiveIsRefusedWithTheLine) {
    const std::string file = written("fast.asm",
                                     "MOV Vmax, 5\nMOV Amax, 1000\nMOV XI, 10\nG01\n"
                                     "MOV Vmax, 50\nMOV XI, 60\nG01\nHLT\n");
    const std::string pulses = path("pulses.csv");
    const std::vector<std::string> words = {
        "cordic", "run", file, "--profile", "trapezoid", "--pulses", pulses};
    const auto with = [&](const char* steps) {
        std::vector<std::string> all = words;
        all.insert(all.end(), {"--timer", "1e5", "--steps", steps});
        return run(all);
    };
    const Ended late = with("2000"); // 10,000 and 100,000 per second; the timer gives 50,000
    EXPECT_EQ(late.exit_code, 1);
    EXPECT_EQ(late.out, "");
    EXPECT_THAT(late.err,
                HasSubstr("fast.asm:7: the timer cannot generate the pulses of X: 100000 per second are "
                          "needed, 50000 are possible"));
    EXPECT_FALSE(std::filesystem::exists(pulses));
    const Ended given = with("900"); // 45,000: every 2.22 ticks, so that some come after 2
    EXPECT_EQ(given.exit_code, 0) << given.err;
    EXPECT_THAT(given.out,
                HasSubstr("X: 54000 pulses up to 45000 Hz, output at up to 50000 Hz, 0 reversals"));
}

TEST_F(CordicMotion, IsThatOfTheImageBehindItsAssemblerText) {
    const std::string image = path("plain.bin");
    ASSERT_EQ(run({"cordic", "asm", two_lines(), "--out", image}).exit_code, 0);
    const Ended text = run({"cordic", "disasm", image});
    EXPECT_THAT(text.out,
                HasSubstr(".format f32\n        .iterations thesis\n        .rounding truncate\n"
                          "        .direction iso\n        .zero positive\n"));
    const std::string again = written("again.asm", text.out);
    const std::string made_again = path("again.bin");
    ASSERT_EQ(run({"cordic", "asm", again, "--out", made_again}).exit_code, 0);
    EXPECT_EQ(content_of(made_again), content_of(image));
    const Ended refused = run({"cordic", "run", again, "--iterations", "8"});
    EXPECT_EQ(refused.exit_code, 1) << "the text says what it is made for";
    EXPECT_THAT(refused.err, HasSubstr("the program is made for the thesis's 29 steps"));
}

} // namespace
} // namespace millwright::test
