#include "core/base/error.h"
#include "core/gcode/program_text.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace millwright::gcode {
namespace {

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> lines;
    std::string line;
    for (const char c : text) {
        if (c == '\n') {
            lines.push_back(std::exchange(line, {}));
        } else {
            line += c;
        }
    }
    if (!line.empty()) {
        lines.push_back(line);
    }
    return lines;
}

TEST(LineIndex, FindsEachLineOfAnyText) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> length(0, 4);
    for (const int count : {0, 1, 63, 64, 65, 128, 1000}) {
        for (const bool ends : {true, false}) {
            std::string text;
            for (int n = 0; n < count; ++n) {
                text += std::string(static_cast<std::size_t>(length(random)), 'x') + '\n';
            }
            text += ends ? "" : "last";
            const std::vector<std::string> lines = split(text);
            const LineIndex index(text);
            ASSERT_EQ(index.count(), std::ssize(lines));
            std::size_t begin = 0;
            for (std::ptrdiff_t n = 0; n < index.count(); ++n) {
                const std::string& line = lines[static_cast<std::size_t>(n)];
                ASSERT_EQ(index.line(n), line);
                ASSERT_EQ(index.begin_of(n), begin);
                ASSERT_EQ(index.line_at(begin), n);
                ASSERT_EQ(index.line_at(std::min(begin + line.size(), text.size() - 1)), n);
                begin += line.size() + 1;
            }
        }
    }
}

TEST(LineIndex, LeavesCarriageReturnsOut) {
    EXPECT_EQ(LineIndex("G0\r\nG1\r\n").line(1), "G1");
}

TEST(LineIndex, RefusesLinesThatAreNotThere) {
    const LineIndex index("a\n");
    EXPECT_THROW((void)index.line(1), Defect);
    EXPECT_THROW((void)index.line(-1), Defect);
    EXPECT_THROW((void)index.line_at(2), Defect);
}

} // namespace
} // namespace millwright::gcode
