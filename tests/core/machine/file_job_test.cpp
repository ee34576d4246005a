#include "core/machine/file_job.h"

#include "core/plot/path_file.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace millwright::machine {
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
        const gcode::Block& block = job.program->blocks[n];
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

TEST(FileJob, SaysWhatIsWrongAndWhere) {
    const test::ScratchFolder folder;
    expect_error(written(folder / "bad.ngc", "G21\nG1 X5\n"), "bad.ngc:2");
    expect_error(written(folder / "bad.path", "# millwright path 9\n1,2,3\n"), "bad.path:1");
    expect_error(written(folder / "empty.ngc", "G21\nM2\n"), "moves nothing");
    expect_error(written(folder / "axis.ngc", "G21 G0 A5\nM2\n"), "A");
    expect_error(folder / "missing.ngc", "missing.ngc");
}

} // namespace
} // namespace millwright::machine
