#include "core/plan/opened_program.h"

#include "core/base/files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

namespace millwright::plan {
namespace {

namespace fs = std::filesystem;

class ProgramReaderTest : public ::testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    std::shared_ptr<const OpenedProgram> read(const std::string& text, const ReadingChoice& choice = {}) {
        write_file(folder_ / "a.ngc", text);
        reader_.open(folder_ / "a.ngc", choice, "assets");
        reader_.wait_idle();
        return reader_.latest();
    }

    fs::path folder_ = fs::temp_directory_path() / ("millwright_opened_" + std::to_string(::getpid()));
    ProgramReader reader_{[] {}};
};

TEST_F(ProgramReaderTest, ReadsTextPathStateAndMotion) {
    const auto opened = read("G21 G90 F600\nG1 X60\nM2\n");
    ASSERT_TRUE(opened && opened->finished && opened->text && opened->execution && opened->motion);
    EXPECT_EQ(opened->text->lines().count(), 3);
    EXPECT_EQ(opened->path.point_count(), 2);
    EXPECT_NEAR(opened->length, 60.0, 1e-9);
    EXPECT_NEAR(opened->seconds, 6.0, 1e-6);
    EXPECT_GT(opened->motion->trajectory->duration(), 6.0); // starting and braking take time
    EXPECT_EQ(opened->motion->step_of_block.front(), 1U);
}

TEST_F(ProgramReaderTest, GivesBlocksOfLoopsTheStepThatMadeThem) {
    const auto opened = read("F600 G21\no1 repeat [3]\nG1 X1\nG1 X0\no1 endrepeat\nM2\n");
    ASSERT_TRUE(opened->motion);
    const auto& steps = opened->motion->step_of_block;
    ASSERT_EQ(steps.size(), opened->motion->program->blocks.size());
    for (std::size_t n = 0; n < steps.size(); ++n) {
        const program::Block& block = opened->motion->program->blocks[n];
        EXPECT_EQ(opened->execution->line_of(steps[n]), block.source_line);
        if (n > 0 && block.moves()) {
            EXPECT_GT(steps[n], steps[n - 1]);
        }
    }
}

TEST_F(ProgramReaderTest, ShowsALongProgramWithoutAPlanAndSaysSo) {
    const auto opened = read("F600 G21\no1 repeat [600000]\nG1 X1\nG1 X0\no1 endrepeat\nM2\n");
    EXPECT_FALSE(opened->motion);
    EXPECT_FALSE(opened->no_motion.empty());
    EXPECT_EQ(opened->path.point_count(), 1'200'001);
}

TEST_F(ProgramReaderTest, TellsWhatIsWrongWithItsPlace) {
    const auto opened = read("G21 F100\nG1 X[1/0]\nG1 X2\nM2\n");
    ASSERT_EQ(opened->errors.size(), 1U);
    EXPECT_EQ(opened->errors.front().place.line, 2);
    EXPECT_EQ(opened->errors_by_line().count(2), 1U);
    EXPECT_FALSE(opened->motion);
    EXPECT_EQ(opened->path.point_count(), 2); // the line behind it is still shown
}

TEST_F(ProgramReaderTest, ReadsByTheChosenRules) {
    EXPECT_TRUE(read("G21 G90 F100\nG1 X1\n", {gcode::Dialect::grbl, "router-xyz"})->errors.empty());
    EXPECT_FALSE(read("G21 G90 F100\nG1 X1\n")->errors.empty()); // LinuxCNC wants M2
}

TEST_F(ProgramReaderTest, FindsSubroutinesBesideTheFile) {
    write_file(folder_ / "part.ngc", "o<part> sub\nG1 X5\no<part> endsub\nM2\n");
    const auto opened = read("G21 F100\no<part> call\nM2\n");
    ASSERT_TRUE(opened->errors.empty()) << to_text(opened->errors.front());
    EXPECT_EQ(opened->path.point_count(), 2);
    EXPECT_EQ(opened->execution->line_of(opened->path.point(1).step()), 2); // where it is called from
}

TEST_F(ProgramReaderTest, AMachineThatIsNotThereIsAFaultAndNoEnd) {
    const auto opened = read("G21 F100\nG1 X1\nM2\n", {gcode::Dialect::linuxcnc, "nowhere"});
    EXPECT_EQ(opened->faults.size(), 1U);
    EXPECT_EQ(opened->path.point_count(), 2);
    EXPECT_FALSE(opened->motion);
}

TEST_F(ProgramReaderTest, RefusesWhatIsNoFile) {
    EXPECT_THROW(reader_.open(folder_ / "missing.ngc", {}, "assets"), Error);
    EXPECT_THROW(reader_.open(folder_, {}, "assets"), Error);
    EXPECT_EQ(reader_.latest(), nullptr);
}

TEST_F(ProgramReaderTest, SurvivesBytesThatAreNoProgram) {
    std::string bytes;
    for (int n = 0; n < 50'000; ++n) {
        bytes += static_cast<char>(n * 37 % 251);
    }
    const auto opened = read(bytes);
    EXPECT_TRUE(opened->finished);
    EXPECT_FALSE(opened->errors.empty());
}

TEST_F(ProgramReaderTest, CancelsAndClosesWhileItReads) {
    write_file(folder_ / "a.ngc", "F600 G21\no1 repeat [4000000]\nG1 X1\nG1 X0\no1 endrepeat\nM2\n");
    reader_.open(folder_ / "a.ngc", {}, "assets");
    reader_.cancel();
    reader_.wait_idle();
    reader_.open(folder_ / "a.ngc", {}, "assets");
    reader_.close();
    EXPECT_EQ(reader_.latest(), nullptr);
}

} // namespace
} // namespace millwright::plan
