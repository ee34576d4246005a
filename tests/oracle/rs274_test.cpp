// LinuxCNC's interpreter as the judge of our programs: first that it can say yes and no at all.
#include "tests/support/oracle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace millwright {
namespace {

class Rs274 : public OracleTest {
protected:
    Rs274() : OracleTest("rs274", "linuxcnc-uspace") {}
    ~Rs274() override { std::filesystem::remove(file_); }

    ProgramRun interpret(std::string_view program) {
        std::ofstream(file_) << program;
        return run({"-g", file_.string()});
    }

private:
    std::filesystem::path file_ =
        std::filesystem::path(::testing::TempDir()) / ("rs274_test_" + std::to_string(getpid()) + ".ngc");
};

TEST_F(Rs274, AcceptsAStraightLineAndSaysWhereItEnds) {
    const ProgramRun answer = interpret("G21 G90 G94\nG1 X1 Y2 F100\nM2\n");
    EXPECT_EQ(answer.exit_code, 0) << answer.output;
    EXPECT_THAT(answer.output, ::testing::HasSubstr("STRAIGHT_FEED(1.0000, 2.0000, 0.0000"));
}

TEST_F(Rs274, RefusesAnArcWithoutACentre) {
    const ProgramRun answer = interpret("G21 G90 G94\nG1 X1 Y2 F100\nG2 X5 Y5\nM2\n");
    EXPECT_NE(answer.exit_code, 0);
    EXPECT_THAT(answer.output, ::testing::HasSubstr("words all missing for arc"));
}

} // namespace
} // namespace millwright
