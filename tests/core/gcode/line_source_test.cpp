#include "core/base/files.h"
#include "core/gcode/internal/source_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace millwright::gcode::internal {
namespace {

std::vector<std::string> lines_of_source(LineSource& source) {
    std::vector<std::string> lines;
    for (std::string_view line; source.next(line);) {
        lines.emplace_back(line);
    }
    return lines;
}

class LineSourceFile : public testing::Test {
protected:
    ~LineSourceFile() override { std::filesystem::remove(file_); }
    std::filesystem::path file_ =
        std::filesystem::path(testing::TempDir()) / ("line_source_" + std::to_string(getpid()) + ".txt");
};

TEST(LineSource, GivesLinesWithoutTheirEnds) {
    LineSource source("one\n\nthree", "text");
    EXPECT_EQ(lines_of_source(source), (std::vector<std::string>{"one", "", "three"}));
    EXPECT_EQ(source.line_number(), 3);
}

TEST(LineSource, ComesBackToAPlace) {
    LineSource source("one\ntwo\nthree\n", "text");
    std::string_view line;
    ASSERT_TRUE(source.next(line));
    const auto place = source.position();
    EXPECT_EQ(lines_of_source(source).size(), 2U);
    source.go_to(place);
    ASSERT_TRUE(source.next(line));
    EXPECT_EQ(line, "two");
    EXPECT_EQ(source.line_number(), 2);
}

TEST_F(LineSourceFile, ReadsMoreThanItsBufferAndComesBack) {
    std::string text;
    for (int n = 1; n <= 100'000; ++n) {
        text += "line " + std::to_string(n) + "\n";
    }
    write_file(file_, text);
    LineSource source(file_);
    std::string_view line;
    LineSource::Position place;
    for (int n = 1; n <= 100'000; ++n) {
        ASSERT_TRUE(source.next(line));
        ASSERT_EQ(line, "line " + std::to_string(n));
        if (n == 41) {
            place = source.position();
        }
    }
    EXPECT_FALSE(source.next(line));
    source.go_to(place);
    ASSERT_TRUE(source.next(line));
    EXPECT_EQ(line, "line 42");
    EXPECT_EQ(source.line_number(), 42);
}

TEST_F(LineSourceFile, CutsWhatIsTooLongAndGoesOnBehindIt) {
    write_file(file_, "a\n" + std::string(1'000'000, 'b') + "\nc\n");
    LineSource source(file_);
    std::string_view line;
    ASSERT_TRUE(source.next(line));
    EXPECT_FALSE(source.cut());
    ASSERT_TRUE(source.next(line));
    EXPECT_TRUE(source.cut());
    ASSERT_TRUE(source.next(line));
    EXPECT_FALSE(source.cut());
    EXPECT_EQ(line, "c");
    EXPECT_EQ(source.line_number(), 3);
}

} // namespace
} // namespace millwright::gcode::internal
