// scripts/check-cases: a table of right results beside a folder of inputs.
#include "tests/app/program.h"
#include "tests/app/shell.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace millwright::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CheckCases : public ::testing::Test {
protected:
    [[nodiscard]] ShellRun check(const std::string& table, const std::string& more = {}) const {
        write_content(folder / "part.ngc", "G21 G90\nG0 X1 Y1 Z1\nG1 X10 F100\nM2\n");
        write_content(folder / "expected.txt", table);
        const auto script = std::filesystem::current_path() / "scripts" / "check-cases";
        return shell(folder.path(),
                     script.string() + " --program '" + program_file().string() + "' . " + more);
    }

    const ScratchFolder folder;
};

TEST_F(CheckCases, AnswersThatAreRightPass) {
    const ShellRun run =
        check("# right\n"
              "case check\nrun gcode check {in}/part.ngc\nhas 2 moves?, 0 errors\nlacks warning\n"
              "case time\nrun gcode time {in}/part.ngc --machine router-xyz\nvalue 5 6 \\(\n"
              "case convert\nrun gcode convert {in}/part.ngc --machine router-xyz --post grbl --out "
              "{out}/o.nc\nrun gcode check {out}/o.nc\nfile o.nc X10\nnofile o.nc X11\n"
              "case refused\nwrite bad.ngc G1 X10\\nM2\\n\nrun gcode check {out}/bad.ngc\nexit 1\n"
              "case sent\nemulate grbl --speed 20\nrun send {in}/part.ngc --driver grbl --port {port} "
              "--log {out}/log\nhas All [0-9]+ blocks were executed\n");
    EXPECT_EQ(run.exit_code, 0) << run.output;
    EXPECT_THAT(run.output, HasSubstr("ok      convert\n"));
    EXPECT_THAT(run.output, HasSubstr("5 cases, 0 differ"));
}

TEST_F(CheckCases, EachKindOfDifferenceIsFound) {
    const std::string check_it = "run gcode check {in}/part.ngc\n";
    const ShellRun run =
        check("case code\n" + check_it + "exit 1\ncase text\n" + check_it + "has 3 moves\ncase other\n" +
              check_it + "lacks 2 moves\ncase number\n" + check_it + "value 7 9 lines,\ncase file\n" +
              check_it + "file none.ngc X\ncase right\n" + check_it +
              "case earlier\nrun gcode check {in}/none.ngc\n" + check_it);
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.output,
                AllOf(HasSubstr("DIFFERS code: exit code 0, not 1"),
                      HasSubstr("DIFFERS text: lacks /3 moves/"),
                      HasSubstr("DIFFERS other: has /2 moves/"),
                      HasSubstr("DIFFERS number: 2 behind /lines,/, not 7 to 9"),
                      HasSubstr("DIFFERS file: none.ngc is not there"),
                      HasSubstr("of an earlier command"),
                      HasSubstr("ok      right\n")));
    EXPECT_THAT(run.output, HasSubstr("7 cases, 6 differ"));
    EXPECT_THAT(check("case a\n" + check_it + "case b\n" + check_it, "--only b").output,
                AllOf(HasSubstr("1 cases, 0 differ"), Not(HasSubstr("ok      a"))));
    EXPECT_EQ(check("case a\nruns x\n").exit_code, 2);
    EXPECT_EQ(check("case a\n" + check_it + "lacks (\n").exit_code, 2);
    EXPECT_EQ(check("case a\n" + check_it, "--only b").exit_code, 2);
}

TEST_F(CheckCases, FoldersMayHaveSpacesQuotesAndAmpersands) {
    std::filesystem::create_directory(folder / "R & D's");
    write_content(folder / "R & D's" / "a b.ngc", "G0 X1 Y1 Z3.5\nM2\n");
    write_content(folder / "R & D's" / "expected.txt",
                  "case a\nrun gcode check '{in}/a b.ngc'\nvalue 1 1 nothing|lines,\n");
    const auto script = std::filesystem::current_path() / "scripts" / "check-cases";
    const ShellRun named =
        shell(folder.path(), script.string() + " --program '" + program_file().string() + "' \"R & D's\"");
    EXPECT_EQ(named.exit_code, 0) << named.output;
}

} // namespace
} // namespace millwright::test
