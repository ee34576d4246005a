#include "core/base/files.h"
#include "core/jobs/job.h"
#include "core/jobs/recovery.h"
#include "core/jobs/run_from_line.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::jobs {
namespace {

using testing::HasSubstr;

struct Way : testing::Test {
    test::ScratchFolder folder;
    std::filesystem::path file = folder / "part.ngc";

    /// Of a job that ended before `next_line`.
    [[nodiscard]] JobStory story(const std::string& text, int next_line, const std::string& driver) const {
        write_file(file, text);
        JobStory result;
        result.start.project = file.string();
        result.start.driver = driver;
        result.start.program_hash = program_hash(text);
        result.start.blocks = 100;
        result.end = JobEnd::fault;
        result.next_line = next_line;
        return result;
    }
    static std::string program(const std::string& head, int lines) {
        std::string text = head;
        for (int n = 0; n < lines; ++n) {
            text += "G1 X" + std::to_string(n) + " Y0 F100\n";
        }
        return text + "M2\n";
    }
};

TEST_F(Way, LeadsToTheLineWhereThatCanBeBegun) {
    const std::string text = program("G21 G90\nG0 Z5\n", 30);
    for (const char* driver : {"grbl", "linuxcnc", "virtual", "stream", "records"}) {
        for (int line = 1; line <= 30; ++line) {
            const ResumePoint way = resume_point(story(text, line, driver));
            const bool text_is_sent =
                std::string_view(driver) == "grbl" || std::string_view(driver) == "linuxcnc";
            const bool has_room = line > (text_is_sent ? fewest_approach_lines : approach_lines);
            EXPECT_EQ(way.line, has_room ? line : 1) << driver;
            EXPECT_EQ(way.why_the_beginning.empty(), has_room) << way.why_the_beginning;
            EXPECT_FALSE(way.needs_clearance);
        }
    }
    EXPECT_THAT(resume_point(story(text, 5, "grbl")).why_the_beginning, HasSubstr("ended at line 5"));
    EXPECT_THAT(resume_point(story(text, 0, "grbl")).why_the_beginning, HasSubstr("not known"));
    EXPECT_THAT(resume_point(story(text, 20, "cordic")).why_the_beginning, HasSubstr("cordic"));
}

TEST_F(Way, AsksForTheClearanceThatNoLineTells) {
    const ResumePoint way = resume_point(story(program("G21 G90\nG1 Z-1 F50\n", 30), 20, "grbl"));
    EXPECT_EQ(way.line, 20);
    EXPECT_TRUE(way.needs_clearance);
}

TEST_F(Way, LeadsToTheBeginningOfProgramsThatHaveNoMiddle) {
    const ResumePoint way = resume_point(story(program("G21 G90\nG0 Z5\n#1=3\n", 30), 20, "linuxcnc"));
    EXPECT_EQ(way.line, 1);
    EXPECT_THAT(way.why_the_beginning, HasSubstr("part.ngc:3: a program with parameters"));
    // One that is planned here is begun at any block.
    EXPECT_EQ(resume_point(story(program("G21 G90\nG0 Z5\n#1=3\n", 30), 20, "virtual")).line, 20);
}

TEST_F(Way, LeadsToTheBeginningOfProgramsThatWereChanged) {
    const JobStory before = story(program("G21 G90\nG0 Z5\n", 30), 20, "grbl");
    write_file(file, program("G21 G90\nG0 Z5\n", 31));
    EXPECT_THAT(resume_point(before).why_the_beginning, HasSubstr("changed"));
    std::filesystem::remove(file);
    EXPECT_THAT(resume_point(before).why_the_beginning, HasSubstr("part.ngc"));
}

} // namespace
} // namespace millwright::jobs
