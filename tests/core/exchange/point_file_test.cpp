#include "core/exchange/point_file.h"

#include "core/exchange/point_rows.h"
#include "tests/support/reason.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::exchange {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

MeasuredPoints points_in(const std::string& text) {
    return parse_measured_points(text, "probe.csv", {});
}

std::string why_no_points(const std::string& text) {
    return test::reason([&] { (void)points_in(text); });
}

std::string why_no_rows(const std::string& text) {
    return test::reason([&] { (void)rows_of(points_in(text), "probe.csv"); });
}

TEST(MeasuredPoints, AreReadWhateverSeparatesThem) {
    for (const char* text : {"1 2 3\n4 5 6.5\n",
                             "1,2,3\r\n4,5,6.5",
                             "1;2;3\n4;5;6.5\n",
                             "1\t2\t3\n\t4\t5\t6.5\n",
                             "1, 2, 3\n4, 5, 6.5\n",
                             "\xEF\xBB\xBF# probe\n+1 2e0 3\n// next\n4 5 65e-1\n",
                             "2\n1 2 3\n4 5 6.5\n"}) {
        const MeasuredPoints read = points_in(text);
        ASSERT_EQ(read.points.size(), 2U) << text;
        EXPECT_EQ(read.points[0], Vec3(1.0, 2.0, 3.0)) << text;
        EXPECT_EQ(read.points[1], Vec3(4.0, 5.0, 6.5)) << text;
        EXPECT_TRUE(read.notes.empty());
    }
    EXPECT_THAT(points_in("\n# a\n1 2 3\n\n\n4 5 6\n7 8 9\n\n").begins, ElementsAre(0U, 1U));
    EXPECT_THAT(points_in("\n# a\n1 2 3\n\n\n4 5 6\n7 8 9\n\n").lines, ElementsAre(3, 6, 7));
}

TEST(MeasuredPoints, TakeTheirColumnsFromTheFirstLineOfNames) {
    const MeasuredPoints read = points_in("no,Y [mm],z_mm,X,quality\n1,2,3,4,5\n2,3,4,5,6\n");
    EXPECT_EQ(read.points[1], Vec3(5.0, 3.0, 4.0));
    EXPECT_THAT(read.notes, ElementsAre("only x, y and z of 5 columns are used"));
    EXPECT_EQ(points_in("1 2 3 255 0 0\n4 5 6 255 0 0\n").points[1], Vec3(4.0, 5.0, 6.0));
    EXPECT_THAT(why_no_points("a,b,c\n1,2,3\n"), HasSubstr("probe.csv:1: there is no column named x"));
}

TEST(MeasuredPoints, SayWhereTheFileIsWrong) {
    EXPECT_THAT(why_no_points("1 2 3\n1 nan 3\n"), HasSubstr("probe.csv:2: 'nan' is not a finite number"));
    EXPECT_THAT(why_no_points("1 2 3\n1 2 -inf\n"), HasSubstr("probe.csv:2: '-inf' is not a finite number"));
    EXPECT_THAT(why_no_points("1 2 3\n1 2 1e999\n"), HasSubstr("probe.csv:2: '1e999' is not a number"));
    EXPECT_THAT(why_no_points("1 2 3\n1 2 3mm\n"), HasSubstr("probe.csv:2: '3mm' is not a number"));
    EXPECT_THAT(why_no_points("1,2,3\n1,,3\n"), HasSubstr("probe.csv:2: '' is not a number"));
    EXPECT_THAT(why_no_points("1 2 3\n1 2\n"),
                HasSubstr("probe.csv:2: this line has 2 numbers, but needs three"));
    EXPECT_THAT(why_no_points("1 2 3\n1 2 3 4\n"),
                HasSubstr("probe.csv:2: this line has 4 numbers, but the lines before have 3"));
    EXPECT_THAT(why_no_points("3\n1 2 3\n1 2 4\n"),
                HasSubstr("probe.csv:1: the file declares 3 points, but contains 2"));
    EXPECT_THAT(why_no_points("# nothing\n\n"), HasSubstr("probe.csv: the file contains no points"));
}

TEST(MeasuredPoints, KnowDecimalCommas) {
    for (const char* text : {"1,5;2,5;3\n", "1,5 2,5 3,5\n", "1,5\t2,5\t3,5\n", "-1,5; 2;3\n"}) {
        EXPECT_THAT(why_no_points(text), HasSubstr("probe.csv:1: '")) << text;
        EXPECT_THAT(why_no_points(text), HasSubstr("1,5' has a decimal comma")) << text;
    }
    EXPECT_THAT(
        why_no_points("1,5,2,5,3,0\n"),
        HasSubstr("probe.csv:1: 6 numbers are separated by commas, but only x, y and z are expected"));
    EXPECT_THAT(why_no_points("1 2 3\n1 2 3,5\n"), HasSubstr("probe.csv:2: "));
}

/// Rows of n points along y, 10 mm apart; `fro`: every second one is measured backwards.
std::string raster(int rows, int columns, bool fro, const char* between) {
    std::string text;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const int at = fro && i % 2 == 1 ? columns - 1 - j : j;
            for (const int coordinate : {10 * i, 10 * at, i * i + at}) {
                text += std::to_string(coordinate) + " ";
            }
            text += "\n";
        }
        text += between;
    }
    return text;
}

TEST(PointRows, AreFoundWithAndWithoutBlankLines) {
    for (const bool fro : {false, true}) {
        for (const char* between : {"", "\n", "\n\n"}) {
            const auto grid = rows_of(points_in(raster(3, 7, fro, between)), "probe.csv");
            ASSERT_TRUE(grid);
            EXPECT_EQ(grid->rows, 3);
            EXPECT_EQ(grid->columns, 7);
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 7; ++j) {
                    EXPECT_EQ(grid->at(i, j), Vec3(10.0 * i, 10.0 * j, i * i + j));
                }
            }
        }
    }
    EXPECT_FALSE(rows_of(points_in("0 0 0\n1 5 0\n-3 2 0\n4 4 1\n7 -2 0\n1 1 1\n"), "probe.csv"));
    EXPECT_FALSE(rows_of(points_in("0 0 0\n1 0 0\n2 0 0\n3 0 0\n"), "probe.csv")); // one row
}

TEST(PointRows, SayWhereARowIsWrong) {
    EXPECT_THAT(why_no_rows("0 0 0\n0 1 0\n0 2 0\n\n1 0 0\n1 1 0\n"),
                HasSubstr("probe.csv:5: row 2 has 2 points, but the first row has 3"));
    EXPECT_THAT(why_no_rows("0 0 0\n0 1 0\n\n1 0 0\n0 1 0\n"),
                HasSubstr("probe.csv:5: the point of line 2 is repeated here"));
    EXPECT_THAT(why_no_rows("0 0 0\n\n1 0 0\n\n2 0 0\n"), HasSubstr("probe.csv:1: a row has only one point"));
}

TEST(PointRows, ACloudLeavesOutWhatIsThereTwice) {
    const PointCloud cloud = cloud_of(points_in("0 0 0\n1 0 0\n0 0 -0.0\n0 1 0\n1 0 0\n"));
    EXPECT_THAT(cloud.lines, ElementsAre(1, 2, 4));
    EXPECT_THAT(cloud.repeated, ElementsAre(3, 5));
}

} // namespace
} // namespace millwright::exchange
