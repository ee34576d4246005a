#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

} // namespace
} // namespace millwright::test
