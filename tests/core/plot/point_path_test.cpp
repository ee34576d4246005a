// Points of a table as what they cut.
#include "core/plot/decode.h"
#include "core/plot/point_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace millwright::plot {
namespace {

TEST(PointPath, WhatAPlotWasDecodedToIsCutWhereThePlotDraws) {
    const Strokes drawn{{.pen = 1, .points = {{10.0, 10.0}, {20.0, 10.0}, {20.0, 15.0}}},
                        {.pen = 1, .points = {{0.0, 30.0}, {5.0, 30.0}}}};
    const std::vector<Vec3> points =
        decode(drawn, {.velocity = 5.0, .period = 0.1, .pen_up_z = 2.0, .pen_down_z = -1.0});
    const Strokes found = strokes_of_points(points);
    ASSERT_EQ(found.size(), 2U);
    for (std::size_t n = 0; n < 2; ++n) {
        EXPECT_NEAR(length(found[n]), length(drawn[n]), 1e-9);
        EXPECT_LT((found[n].points.front() - drawn[n].points.front()).norm(), 1e-9);
        EXPECT_LT((found[n].points.back() - drawn[n].points.back()).norm(), 1e-9);
    }
    const CutPath path = path_of_points(points, {.cutting = 7.0, .plunging = 3.0, .safe_height = 6.0});
    EXPECT_EQ(path.front().at, Vec3(0.0, 0.0, 6.0));
    EXPECT_EQ(path.back().at.z(), 6.0);
    for (std::size_t n = 1; n < path.size(); ++n) {
        const bool in_work = path[n].at.z() <= 0.0 && path[n - 1].at.z() <= 0.0;
        EXPECT_EQ(in_work && path[n].at.head<2>() != path[n - 1].at.head<2>(), path[n].move == CutMove::cut)
            << n;
        EXPECT_EQ(path[n].speed,
                  path[n].move == CutMove::cut      ? 7.0
                  : path[n].move == CutMove::plunge ? 3.0
                                                    : 0.0);
    }
    // Every point is on it.
    for (const Vec3& point : points) {
        EXPECT_TRUE(std::ranges::any_of(path, [&](const CutPoint& at) { return at.at == point; }));
    }
}

// The thesis has one height for both.
TEST(PointPath, PointsOfOneHeightAreAllCut) {
    const std::vector<Vec3> points{{0.0, 0.0, 3.0}, {1.0, 0.0, 3.0}, {1.0, 1.0, 3.0}};
    const Strokes strokes = strokes_of_points(points);
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_EQ(strokes[0].points.size(), 3U);
    EXPECT_TRUE(path_of_points({}).empty());
}

TEST(PointFile, IsKnownByItsFirstLine) {
    EXPECT_TRUE(is_point_file("0.00,0.00,5.00\r\n1,2,3\n"));
    EXPECT_TRUE(is_point_file("\n \n-1,2e1, 3\n"));
    EXPECT_TRUE(is_point_file("\xEF\xBB\xBF"
                              "1,2,3"));
    for (const char* text : {"",
                             "IN;SP1;",
                             "G0 X1\n",
                             "1,2\n",
                             "y,x,z\n1,2,3\n",
                             "x,y,z\nG0\n",
                             "# millwright path 1\n",
                             "1,2,3,4\n",
                             "PA;PD;PU;\n",
                             "1;2\n"}) {
        EXPECT_FALSE(is_point_file(text)) << text;
    }
}

// As spreadsheets write them; they were taken for HPGL.
TEST(PointFile, MayHaveSemicolonsAndNamesOfItsColumns) {
    for (const char* text : {"1.5;-2;3\n4;5;6\n",
                             "1,5;-2,0;3\n4;5;6\n",
                             "1.5\t-2\t3\n4\t5\t6\n",
                             "X,Y,Z\r\n1.5,-2,3\r\n4,5,6\r\n",
                             "\"x\";\"y\";\"z\"\n1,5;-2;3\n4;5;6\n",
                             "\n# X (mm), Y (mm), Z (mm)\n1.5, -2, 3\n4, 5, 6\n"}) {
        EXPECT_TRUE(is_point_file(text)) << text;
        const PointFile read = read_points(text, "points.csv");
        EXPECT_TRUE(read.diagnostics.empty()) << text;
        ASSERT_EQ(read.points.size(), 2U) << text;
        EXPECT_EQ(read.points[0], Vec3(1.5, -2.0, 3.0)) << text;
        EXPECT_EQ(read.points[1], Vec3(4.0, 5.0, 6.0)) << text;
    }
    EXPECT_EQ(read_points("x,y,z\n1,2,3\n", "p.csv").lines, std::vector<int>{2});
    const PointFile twice = read_points("1,2,3\nx,y,z\n1,5,2,3\n", "points.csv");
    ASSERT_EQ(twice.diagnostics.size(), 2U);
    EXPECT_EQ(to_text(twice.diagnostics[0]),
              "points.csv:2: 'x,y,z' is not a point (write three numbers separated by commas or semicolons: "
              "X, Y, Z)");
}

} // namespace
} // namespace millwright::plot
