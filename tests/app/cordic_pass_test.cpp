// The linear and the hyperbolic system, and raw passes, in every cordic command that has them.
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;

TEST(CordicPass, ComputesInEachSystem) {
    const auto answer = [](std::vector<std::string> words) {
        words.insert(words.begin(), "cordic");
        words.push_back("--json");
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        return nlohmann::json::parse(ended.out);
    };
    const auto hyperbola = answer({"rotate", "1", "0", "1", "--system", "hyperbolic"});
    EXPECT_EQ(hyperbola.at("x"), 1.543080554921752);
    EXPECT_EQ(hyperbola.at("y"), 1.1752011085361829);
    EXPECT_NEAR(hyperbola.at("exact_x").get<double>(), std::cosh(1.0), 1e-15);
    EXPECT_EQ(answer({"rotate", "3", "0", "1.5", "--system", "linear"}).at("y"), 4.500000178813934);
    EXPECT_EQ(answer({"vector", "3", "1", "--system", "linear"}).at("z"), 0.3333333134651184);
    EXPECT_NEAR(answer({"vector", "3", "1", "--system", "linear", "--z", "-2"}).at("z").get<double>(),
                1.0 / 3.0 - 2.0,
                6e-8);
    const auto root = answer({"vector", "2.25", "1.75", "--system", "hyperbolic", "--iterations", "40"});
    EXPECT_NEAR(root.at("x").get<double>(), std::sqrt(2.0), 1e-11);
    EXPECT_LT(root.at("z_error").get<double>(), 1e-11);
    const auto raw = answer({"rotate", "1", "0", "0.5", "--raw"}); // rad
    EXPECT_NEAR(raw.at("x").get<double>(), std::cos(0.5), 6e-8);
    const auto folded = answer({"vector", "-3", "4", "--raw", "--fold"});
    EXPECT_TRUE(folded.at("f1").get<bool>());
    EXPECT_EQ(folded.at("quarter_turns"), 1);
    EXPECT_NEAR(folded.at("z").get<double>(), std::atan2(3.0, 4.0), 6e-8);
}

// It was refused.
TEST(CordicPass, ARawRotationTakesAnyZAndSaysWhatIsLeft) {
    for (const bool folds : {false, true}) {
        std::vector<std::string> words{"cordic", "rotate", "1", "0", "3", "--raw"};
        if (folds) {
            words.emplace_back("--fold");
        }
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 0);
        EXPECT_THAT(ended.out, HasSubstr("\nz 1.2914"));
        EXPECT_THAT(ended.err,
                    HasSubstr("warning: z = 3 rad is outside the convergence range, |z| <= 1.70857 rad"));
    }
    EXPECT_THAT(run({"cordic", "rotate", "1", "0", "3", "--raw", "--json"}).out,
                HasSubstr("\"converged\": false"));
    EXPECT_THAT(run({"cordic", "rotate", "1", "0", "1.7", "--raw", "--json"}).out,
                HasSubstr("\"converged\": true"));
}

TEST(CordicPass, RefusesWhatIsBeyondTheRange) {
    const auto refusal = [](std::vector<std::string> words) {
        words.insert(words.begin(), "cordic");
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 1);
        return ended.err;
    };
    EXPECT_THAT(refusal({"rotate", "1", "0", "-1.9", "--system", "hyperbolic"}), HasSubstr("|z| <= 1.83745"));
    EXPECT_THAT(refusal({"vector", "1", "2", "--system", "linear"}), HasSubstr("|y/x| <= 1.76574"));
    EXPECT_THAT(refusal({"vector", "3", "1", "--z", "1"}), HasSubstr("apply only to a raw pass (add --raw)"));
    EXPECT_THAT(refusal({"vector", "3", "1", "--system", "linear", "--fold"}), HasSubstr("circular system"));
}

TEST(CordicPass, AccuracyAndHardwareKnowEachSystem) {
    const ScratchFolder folder;
    const std::string out = folder.path().string();
    const Ended measured =
        run({"cordic", "accuracy", "--out", out, "--system", "hyperbolic", "--random", "1000"});
    ASSERT_EQ(measured.exit_code, 0) << measured.err;
    EXPECT_THAT(content_of(folder.path() / "accuracy.csv"), HasSubstr("f64,ieee,thesis 29 hyperbolic,1000,"));
    EXPECT_THAT(run({"cordic", "accuracy", "--out", out, "--system", "hyperbolic", "--format", "q3.20"}).err,
                HasSubstr("use at least 4 bits before the point"));
    const Ended written = run({"cordic", "rtl", "--out", out, "--system", "linear", "--vectors", "10"});
    ASSERT_EQ(written.exit_code, 0) << written.err;
    EXPECT_THAT(content_of(folder.path() / "cordic_core.v"), HasSubstr("29 linear steps"));
    EXPECT_THAT(run({"cordic", "rtl", "--out", out, "--format", "f32"}).err,
                HasSubstr("aligns, normalises and rounds"));
}

} // namespace
} // namespace millwright::test
