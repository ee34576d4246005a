#include "core/jobs/file_job.h"

#include "core/plot/path_file.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace millwright::jobs {
namespace {

using testing::HasSubstr;

std::shared_ptr<const kinematics::MachineModel> table() {
    return std::make_shared<const kinematics::MachineModel>(test::machine("forming-table"));
}

std::filesystem::path written(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
    return file;
}

void expect_error(const std::filesystem::path& file, const std::string& text) {
    try {
        (void)file_job(file, table());
        ADD_FAILURE() << text;
    } catch (const Error& error) {
        EXPECT_THAT(to_text(error.diagnostic()), HasSubstr(text));
    }
}

// The axes of the table are Y, X, Z in its file.
TEST(FileJob, OfAPathFileTellsTheLineOfEachMove) {
    const test::ScratchFolder folder;
    const plot::CutPath path{{.at = {470.0, 20.0, 5.0}},
                             {.at = {470.0, 20.0, -1.0}, .speed = 2.0, .move = plot::CutMove::plunge},
                             {.at = {480.0, 545.0, -1.0}, .speed = 8.0, .move = plot::CutMove::cut},
                             {.at = {480.0, 545.0, 5.0}, .move = plot::CutMove::retract}};
    const Job job = file_job(written(folder / "sign.path", plot::path_file_text(path)), table());
    EXPECT_TRUE(preflight(job).empty());
    std::vector<int> lines;
    for (std::size_t n = 0; n < job.program->blocks.size(); ++n) {
        const program::Block& block = job.program->blocks[n];
        if (block.moves()) {
            lines.push_back(job.listing->line_of_block[n]);
            if (lines.back() == 4) {
                EXPECT_DOUBLE_EQ(block.target[job.machine->axis_index('X')], 480.0);
                EXPECT_DOUBLE_EQ(block.target[job.machine->axis_index('Y')], 545.0);
                EXPECT_DOUBLE_EQ(block.feed, 8.0);
            }
        }
    }
    EXPECT_THAT(lines, testing::ElementsAre(1, 2, 3, 4, 5));
}

TEST(FileJob, BeyondTheTravelOfTheThesisIsFoundBefore) {
    const test::ScratchFolder folder;
    for (const char* move : {"X480.1", "Y550.1", "Z75.1", "X-0.1"}) {
        const Job job =
            file_job(written(folder / "far.ngc", std::string("G21 G90\nG0 ") + move + "\nM2\n"), table());
        const auto faults = preflight(job);
        ASSERT_EQ(faults.size(), 1U) << move;
        EXPECT_EQ(faults.front().place.line, 2);
        EXPECT_THAT(faults.front().message, HasSubstr("outside"));
    }
    EXPECT_TRUE(
        preflight(file_job(written(folder / "corner.ngc", "G21 G90\nG0 X480 Y550 Z75\nM2\n"), table()))
            .empty());
}

// What is unknown was executed as 0: a G53 in the middle of work positions, a second system.
TEST(FileJob, OfPositionsThatNobodyCanKnowIsRefused) {
    const test::ScratchFolder folder;
    const auto file = written(folder / "down.ngc", "G21 G90\nG0 X9 Y9 Z20\nG1 Z10 F100\nG53 G0 Z0\nM2\n");
    expect_error(file, "down.ngc:4:1: G53 moves to a machine position");
    expect_error(written(folder / "two.ngc", "G21 G90\nG0 X9 Z9\nG55 X9\nM2\n"),
                 "X moves in two coordinate systems, but the offset of G55 is unknown");
    expect_error(written(folder / "read.ngc", "G21 G90\nG0 X#5221\nM2\n"), "its value is unknown");
    expect_error(written(folder / "step.ngc", "G21 G91\nG0 X5\nM2\n"),
                 "X moves from its present position, but the program has not set it yet");
    const auto model = table();
    const Job job = file_job(file, model, {.origin = gcode::WorkOrigin(Vec3(5.0, 0.0, 7.0))});
    const int z = model->axis_index('Z');
    std::vector<double> heights;
    for (const program::Block& block : job.program->blocks) {
        if (block.moves()) {
            heights.push_back(block.target[z]);
        }
    }
    EXPECT_THAT(heights, testing::ElementsAre(27.0, 17.0, 0.0));
    try { // Z is unknown
        (void)file_job(file, model, {.origin = gcode::WorkOrigin(5.0, 0.0)});
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_THAT(error.diagnostic().message, HasSubstr("is unknown in Z"));
    }
    EXPECT_NO_THROW((void)file_job(written(folder / "step.ngc", "G21 G91\nG0 X5\nM2\n"),
                                   model,
                                   {.start = kinematics::AxisPositions::Zero(3)}));
}

TEST(FileJob, TellsWhatIsExecutedInAnotherWay) {
    const test::ScratchFolder folder;
    const auto file = written(folder / "other.ngc", "G21 G90 G55\nM7\nG0 X9 Y9 Z20\nM2\n");
    const Job job = file_job(file, table());
    ASSERT_EQ(job.notices.size(), 2U);
    EXPECT_THAT(to_text(job.notices[0]), HasSubstr("other.ngc:1"));
    EXPECT_THAT(to_text(job.notices[0]), HasSubstr("the offset of G55 is unknown and is taken as 0"));
    EXPECT_THAT(to_text(job.notices[1]), HasSubstr("mist coolant (M7)"));
}

TEST(FileJob, SaysWhatIsWrongAndWhere) {
    const test::ScratchFolder folder;
    expect_error(written(folder / "bad.ngc", "G21\nG1 X5\n"), "bad.ngc:2");
    expect_error(written(folder / "bad.path", "# millwright path 9\n1,2,3\n"), "bad.path:1");
    expect_error(written(folder / "empty.ngc", "G21\nM2\n"), "contains no motion");
    expect_error(written(folder / "axis.ngc", "G21 G0 A5\nM2\n"), "A");
    expect_error(folder / "missing.ngc", "missing.ngc");
}

} // namespace
} // namespace millwright::jobs
