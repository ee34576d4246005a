// millwright cordic compare with a program of an MCS-51, and Tmin.
#include "tests/app/program.h"
#include "tests/app/scratch_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;

using CordicCompare = ScratchFiles;

// CLR P1.0; SETB P1.0; NOP; NOP; CLR P1.0; SJMP here
constexpr const char* blinking = ":0A000000C290D2900000C29080FE72\n:00000001FF\n";

TEST_F(CordicCompare, ExecutesAProgramOfAnMcs51ForEachLine) {
    const std::string file = written("blink.ihx", blinking);
    const Ended ended =
        run({"cordic", "compare", "--mcs51", file, "--line", "5,7,4,8", "--line", "0,0,-1,2", "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto answer = nlohmann::json::parse(ended.out);
    EXPECT_EQ(answer.at("mcs51").at("clocks"), 10'696) << "the thesis's";
    const auto& executed = answer.at("mcs51_executed");
    ASSERT_EQ(executed.size(), 2U);
    EXPECT_EQ(executed[1].at("from"), (nlohmann::json{0, 0}));
    EXPECT_EQ(executed[1].at("to"), (nlohmann::json{-1, 2}));
    EXPECT_EQ(executed[1].at("clocks"), 36);
    EXPECT_THAT(run({"cordic", "compare", "--mcs51", file}).out, HasSubstr("(5, 7) to (4, 8)"));
}

TEST_F(CordicCompare, SaysWhatIsWrongWithAProgramOrALine) {
    const std::string file = written("blink.ihx", blinking);
    const auto fault = [](const std::vector<std::string>& words) {
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 1);
        return ended.err;
    };
    EXPECT_THAT(fault({"cordic", "compare", "--mcs51", written("bad.ihx", ":00\n")}),
                HasSubstr("bad.ihx:1:1: "));
    EXPECT_THAT(fault({"cordic", "compare", "--mcs51", file, "--line", "1,2,3"}),
                HasSubstr("\"1,2,3\" is not a line"));
    EXPECT_THAT(fault({"cordic", "compare", "--line", "1,2,3,4"}), HasSubstr("--mcs51"));
}

TEST_F(CordicCompare, RunTellsTmin) {
    const std::string file = written("line.ngc", "G21\nG1 X10 Y5 F600\nM2\n"); // 10 mm/s
    for (const bool whole : {false, true}) {
        std::vector<std::string> words{
            "cordic", "run", file, "--acceleration", "100", "--format", "f64", "--json"};
        if (whole) {
            words.emplace_back("--whole-acceleration");
        }
        const Ended ended = run(words);
        ASSERT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_NEAR(nlohmann::json::parse(ended.out).at("points").at(0).at("t_min").get<double>(), 0.2, 1e-7);
    }
}

} // namespace
} // namespace millwright::test
