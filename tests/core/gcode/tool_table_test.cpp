#include "core/gcode/tool_table.h"

#include "core/base/error.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::gcode {
namespace {

TEST(ToolTableFile, ReadsEveryLetter) {
    const ToolTable table = parse_tool_table(
        "; a comment\nT1 P2 X1 Y2 Z3 A4 U7 D8.5 I10 J-20 Q3 ;end mill\n\n  t99 p1 z+.5\n", "t");
    ASSERT_EQ(table.tools.size(), 2U);
    const Tool& tool = table.tools[0];
    EXPECT_EQ(tool.number, 1);
    EXPECT_EQ(tool.pocket, 2);
    EXPECT_DOUBLE_EQ(tool.offset[Axis::x], 1.0);
    EXPECT_DOUBLE_EQ(tool.offset[Axis::z], 3.0);
    EXPECT_DOUBLE_EQ(tool.offset[Axis::a], 4.0);
    EXPECT_DOUBLE_EQ(tool.offset[Axis::u], 7.0);
    EXPECT_DOUBLE_EQ(tool.diameter, 8.5);
    EXPECT_DOUBLE_EQ(tool.front_angle, 10.0);
    EXPECT_DOUBLE_EQ(tool.back_angle, -20.0);
    EXPECT_EQ(tool.orientation, 3);
    EXPECT_EQ(table.row_of(99), 2);
    EXPECT_EQ(table.row_of(5), -1);
}

TEST(ToolTableFile, AByteOrderMarkIsSkipped) {
    const ToolTable table = parse_tool_table("\xEF\xBB\xBFT1 P2 Z3 D8.5\n", "t");
    ASSERT_EQ(table.tools.size(), 1U);
    EXPECT_EQ(table.tools[0].number, 1);
}

TEST(ToolTableFile, HasABoundOfItsOwn) {
    std::string fault;
    try {
        static_cast<void>(read_tool_table("/dev/zero"));
    } catch (const Error& error) {
        fault = error.what();
    }
    EXPECT_EQ(fault, "/dev/zero: larger than 4 MiB, the maximum that can be read");
}

TEST(ToolTableFile, RefusesWithThePlace) {
    const test::WithoutTraps numbers_that_are_none;
    const auto place_of = [](const char* text) {
        try {
            static_cast<void>(parse_tool_table(text, "t.tbl"));
        } catch (const Error& error) {
            return to_text(error.diagnostic());
        }
        return std::string("none");
    };
    EXPECT_EQ(place_of("T1 Z1\nT2 K5"), "t.tbl:2:4: 'K' is not a valid letter in a tool table");
    EXPECT_EQ(place_of("T1 Zx"), "t.tbl:1:5: a number is expected");
    EXPECT_EQ(place_of("T1.5"), "t.tbl:1:1: an integer from 0 to 99999 is expected");
    EXPECT_EQ(place_of("Z5"), "t.tbl:1:1: a tool needs a tool number, T");
    EXPECT_EQ(place_of("T1\nT1"), "t.tbl:2:1: tool 1 is in the table twice");
    EXPECT_EQ(place_of("T1 Znan"), "t.tbl:1:5: a number is expected");
}

} // namespace
} // namespace millwright::gcode
