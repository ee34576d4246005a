#include "core/gcode_programs/cut_program.h"

#include "core/base/files.h"
#include "core/base/units.h"
#include "core/gcode/tool_table.h"
#include "tests/core/gcode/thesis_programs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace millwright::gcode {
namespace {

using test::thesis_plate;
using test::thesis_simple;
using test::thesis_space;
using testing::HasSubstr;

CutProgram read_cut(const std::string& text, const CutProgramSettings& settings = {}) {
    return read_cut_program(text, "part.ngc", settings);
}

CutProgram by_chords(const std::string& file) {
    return read_cut(read_file(file), {.chord_length = 1.0});
}

Diagnostic cut_refusal(const std::string& text, const CutProgramSettings& settings = {}) {
    try {
        (void)read_cut(text, settings);
    } catch (const Error& error) {
        return error.diagnostic();
    }
    ADD_FAILURE() << text;
    return {};
}

std::vector<std::size_t> points_of(const CutProgram& program) {
    std::vector<std::size_t> counts;
    for (const plot::Stroke& stroke : program.strokes) {
        counts.push_back(stroke.points.size());
    }
    return counts;
}

// Lengths, chords and times that the listings of the thesis of 2006 have.
TEST(CutPrograms, OfTheThesisHaveTheirWaysAndTimes) {
    const CutProgram a = by_chords(thesis_simple);
    EXPECT_NEAR(plot::lengths(a.path).cut, 74.0, 1e-4);
    EXPECT_NEAR(plot::lengths(a.path).travel, 28.2842, 1e-4);
    EXPECT_NEAR(a.feed_time, 148.0, 1e-6);
    EXPECT_EQ(points_of(a), (std::vector<std::size_t>{5}));

    const CutProgram b = by_chords(thesis_space);
    EXPECT_NEAR(plot::lengths(b.path).cut, 438.2848, 0.02); // chords are shorter than their arcs
    EXPECT_NEAR(plot::lengths(b.path).travel, 80.2905, 1e-4);
    EXPECT_NEAR(b.feed_time, 81.828, 2e-3);
    EXPECT_EQ(points_of(b), (std::vector<std::size_t>{5, 41 + 15 + 27 + 17 + 1}));

    const CutProgram c = by_chords(thesis_plate);
    EXPECT_NEAR(plot::lengths(c.path).cut, 579.8006, 0.06);
    EXPECT_NEAR(plot::lengths(c.path).travel, 106.2665, 1e-4);
    EXPECT_NEAR(c.feed_time, 1159.601, 0.12);
    EXPECT_EQ(points_of(c), (std::vector<std::size_t>{4 * 32 + 4 + 1, 50 + 50 + 1}));
}

TEST(CutPrograms, TellsOfAHeightThatIsNotNamedAndCountsNoWayDownToIt) {
    const CutProgram program = read_cut("G21 G90\nG0 X1 Y1\nG1 X2 F100\nM2\n");
    ASSERT_EQ(program.notices.size(), 1U);
    EXPECT_EQ(program.notices[0].place.line, 3);
    EXPECT_THAT(program.notices[0].message, HasSubstr("no height is given before this feed move"));
    EXPECT_NEAR(plot::lengths(program.path).cut, 6.0, 1e-9) << "lowered all the same, from an unknown height";
    EXPECT_NEAR(named_lengths(program).cut, 1.0, 1e-9);
    EXPECT_NEAR(named_lengths(program).travel, std::sqrt(2.0), 1e-9);

    const CutProgram named = read_cut("G21 G90\nG0 Z0\nG0 X1 Y1\nG1 X2 F100\nM2\n");
    EXPECT_TRUE(named.notices.empty());
    EXPECT_NEAR(named_lengths(named).cut, 1.0, 1e-9);
}

TEST(CutPrograms, TellHowFarFeedsAreTakenForTravel) {
    const std::string text = "G21 G90\nG0 X0 Y0 Z0\nG1 X30 F100\nY40\nG0 X0\nG1 Z-1\nX10\nG0 Z0\nM2\n";
    const CutProgram program = read_cut(text);
    ASSERT_EQ(program.notices.size(), 1U);
    EXPECT_EQ(program.notices[0].place.line, 3);
    EXPECT_THAT(program.notices[0].message, HasSubstr("70.000 mm of feed moves at or above z 0.000 mm"));
    EXPECT_TRUE(read_cut(text, {.safe_height = 5.0}).notices.empty()) << "a person said so";
    EXPECT_EQ(read_cut(text, {.safe_height = 5.0}).strokes.size(), 2U);
    EXPECT_TRUE(read_cut(read_file(thesis_plate)).notices.empty());
}

TEST(CutPrograms, StrokesOfTheThesisAreClosedOutlinesAtOneHeight) {
    for (const auto& [file, z] :
         {std::pair(thesis_simple, -10.0), std::pair(thesis_space, 0.0), std::pair(thesis_plate, -2.0)}) {
        const CutProgram program = read_cut(read_file(file));
        EXPECT_EQ(program.safe_height, 10.0) << file;
        EXPECT_FALSE(program.uneven) << file;
        ASSERT_EQ(program.levels.size(), 1U) << file;
        EXPECT_EQ(program.levels[0].z, z);
        EXPECT_NEAR(to_mm_per_min(program.levels[0].plunging), 30.0, 1e-9);
        for (const plot::Stroke& stroke : program.strokes) {
            EXPECT_EQ(stroke.points.front(), stroke.points.back()) << file;
        }
    }
}

TEST(CutPrograms, ArcsKeepTheToleranceThatWasAskedFor) {
    for (const double tolerance : {0.2, 0.02, 0.002}) {
        const CutProgram program = read_cut(read_file(thesis_plate), {.chord_tolerance = tolerance});
        const std::vector<Vec2>& hole = program.strokes[1].points; // around 50, 50
        double farthest = 0.0;
        for (std::size_t n = 1; n < hole.size(); ++n) {
            farthest = std::max(farthest, 15.619 - (0.5 * (hole[n - 1] + hole[n]) - Vec2(50, 50)).norm());
        }
        EXPECT_LE(farthest, tolerance);
        EXPECT_GT(farthest, 0.2 * tolerance);
    }
}

// Before N5 the 3D program of the thesis has no height: across at zero would be through what lies there.
TEST(CutPrograms, BeginWhereAllThreeAxesAreNamed) {
    EXPECT_EQ(read_cut(read_file(thesis_space)).path.front(), (plot::CutPoint{.at = {10, 10, 10}}));
    EXPECT_EQ(read_cut(read_file(thesis_simple)).path.front(), (plot::CutPoint{.at = {10, 10, 0}}));
    const CutProgram low = read_cut("G0 X10 Y20\nG1 Z-1 F60\nX30\nG0 Z8\nX0\nM2\n");
    ASSERT_GE(low.path.size(), 3U);
    EXPECT_EQ(low.path[0], (plot::CutPoint{.at = {10, 20, 8}}));
    EXPECT_EQ(low.path[1], (plot::CutPoint{{10, 20, 0}, 1.0, plot::CutMove::plunge}));
    EXPECT_EQ(low.path[2], (plot::CutPoint{{10, 20, -1}, 1.0, plot::CutMove::plunge}));
}

TEST(CutPrograms, ACutFromWhereXOrYIsNotKnownHasNoPlace) {
    const auto unplaced = [](const std::string& text) {
        std::string all;
        for (const Diagnostic& found : read_cut("G21 G90\n" + text + "G0 Z5\nM2\n").unplaced) {
            all += to_text(found) + "\n";
        }
        return all;
    };
    EXPECT_EQ(unplaced("G0 Z5\nG1 Z-1 F100\nG1 X50\n"),
              "part.ngc:3: this cut starts before the program has stated where X and Y are (add a rapid move "
              "with X and Y before the first cut)\n");
    EXPECT_THAT(unplaced("G0 Z5\nG1 Z-1 F100\nG1 X50 Y50\n"), HasSubstr("part.ngc:3: this cut starts"));
    EXPECT_THAT(unplaced("G0 X0 Z5\nG1 Z-1 F100\nG1 X50\n"),
                HasSubstr("where Y is (add a rapid move with Y"));
    EXPECT_THAT(unplaced("G0 Y0\nG0 Z-1\nG1 X50 F100\n"), HasSubstr("part.ngc:4: this cut starts"));
    EXPECT_THAT(unplaced("G1 X50 Y50 Z-1 F100\n"), HasSubstr("where X and Y are"));
    EXPECT_EQ(unplaced("G0 X0 Y0\nZ5\nG1 Z-1 F100\nX50\n"), "") << "named, though at zero";
    EXPECT_EQ(unplaced("G1 Z5 F900\nG0 X0 Y0\nX3\nG1 Z-1 F100\nX50\n"), "") << "cuts nothing on its way up";
    EXPECT_EQ(unplaced("G0 Z5\nG1 X1 Y1 F900\nG0 X3\nG1 Z-1 F100\nX50\n"), "") << "in the air";
}

TEST(CutPrograms, AnAxisNamedAtZeroIsNamed) {
    const CutProgram program = read_cut("G0 X0 Y0 Z0\nX10\nG1 X20 F60\nM2\n");
    ASSERT_EQ(program.path.size(), 3U);
    EXPECT_EQ(program.path[0], (plot::CutPoint{.at = {0, 0, 0}}));
    EXPECT_EQ(program.path[1], (plot::CutPoint{.at = {10, 0, 0}}));
}

TEST(CutPrograms, FeedsAtTheHeightOfTravelAreInTheAir) {
    const std::string text =
        "G0 X0 Y0 Z5\nX10\nG1 Z-1 F60\nX20 F120\nZ5\nX40 F600\nZ-1 F60\nX50 F120\nZ5\nM2\n";
    const CutProgram program = read_cut(text);
    EXPECT_EQ(points_of(program), (std::vector<std::size_t>{2, 2}));
    EXPECT_EQ(std::ranges::count_if(program.path,
                                    [](const plot::CutPoint& point) {
                                        return point.move == plot::CutMove::rapid && point.speed > 0.0;
                                    }),
              1);
    EXPECT_EQ(points_of(read_cut(text, {.safe_height = 6.0})), (std::vector<std::size_t>{2, 2, 2}));
    EXPECT_THAT(cut_refusal(text, {.safe_height = -2.0}).message, HasSubstr("no cuts below z -2.000"));
    // A pen plotter's: all in one plane.
    EXPECT_EQ(points_of(read_cut("G0 Z0\nG0 X5 Y5\nX0\nG1 X10 F60\nY10\nM2\n")),
              (std::vector<std::size_t>{3}));
}

TEST(CutPrograms, HeightsAndToolsAreLevels) {
    const CutProgram program = read_cut("T3 M6\nG0 X0 Y0 Z5\nG1 Z-1 F60\nX10 F300\nZ-2 F30\nX0 F200\nG0 Z5\n"
                                        "T7 M6\nG0 X3\nG1 Z-1 F90\nX20\nG0 Z5\nX1\nM2\n");
    ASSERT_EQ(program.levels.size(), 3U);
    EXPECT_EQ(program.levels[0], (CutLevel{1, 3, -1.0, 5.0, 1.0}));
    EXPECT_EQ(program.levels[1], (CutLevel{2, 3, -2.0, from_mm_per_min(200.0), 0.5}));
    EXPECT_EQ(program.levels[2], (CutLevel{3, 7, -1.0, 1.5, 1.5}));
    EXPECT_EQ(std::ranges::count(program.path, plot::CutMove::tool_change, &plot::CutPoint::move), 1);
    EXPECT_EQ(program.path.front().tool, 3);
    EXPECT_EQ(program.path.back().tool, 7);
    EXPECT_EQ(program.end, Vec2(1, 0));
}

TEST(CutPrograms, HolesAreDotsAtTheirDeepest) {
    const CutProgram program =
        read_cut("G0 X0 Y0 Z5\nG81 X5 Y5 Z-3 R1 F60\nX9\nG80\nG0 X20\nG1 Z1\nZ-1\nZ0\nZ-2\nG0 Z5\nX0\nM2\n");
    EXPECT_EQ(points_of(program), (std::vector<std::size_t>{1, 1, 1}));
    EXPECT_EQ(program.strokes[0].points[0], Vec2(5, 5));
    EXPECT_EQ(program.strokes[2].points[0], Vec2(20, 5));
    ASSERT_EQ(program.levels.size(), 2U);
    EXPECT_EQ(program.levels[0].z, -3.0);
    EXPECT_EQ(program.levels[1].z, -2.0);
}

TEST(CutPrograms, HeightsThatChangeAlongACutAreToldWithTheLine) {
    const CutProgram program = read_cut("G0 X0 Y0 Z5\nX1\nG1 Z0 F60\nX10 Z-2\nX20\nG0 Z5\nM2\n");
    ASSERT_TRUE(program.uneven);
    EXPECT_EQ(program.uneven->place.line, 4);
    EXPECT_EQ(program.uneven->message, "this cut changes height from z 0.000 to -2.000 mm");
    EXPECT_FALSE(program.levels[0].z);
    EXPECT_EQ(program.path[program.path.size() - 3].at, Vec3(10, 0, -2));
}

TEST(CutPrograms, WhatHasNoMeaningAsAPathIsRefusedWithItsLine) {
    const auto at_line = [](const std::string& text) {
        const Diagnostic found = cut_refusal(text);
        return std::to_string(found.place.line) + ": " + found.message;
    };
    EXPECT_EQ(at_line("G0 X0 Y0 Z5\nG1 Z-1 F60\nG1 X10 A90\nM2\n"), "3: the machine 'X, Y, Z' has no axis A");
    EXPECT_THAT(at_line("G0 X0 Y0 Z5\nG1 Z-1\nM2\n"), HasSubstr("2: "));
    EXPECT_THAT(at_line("G0 X0 Y0 Z5\nG38.2 Z-1 F60\nM2\n"), HasSubstr("2: probing (G38) is not possible"));
    EXPECT_THAT(at_line("G0 X0 Y0 Z5\nG2 X10 Y0 I9 F60\nM2\n"), HasSubstr("2: "));
    EXPECT_THAT(at_line("G0 X0 Y0 Z5\nM2\n"), HasSubstr("the program has no cuts"));
    EXPECT_THAT(at_line(""), HasSubstr("the program is empty"));
}

// Without a diameter the contour itself was cut.
TEST(CutPrograms, CompensationNeedsTheToolsDiameter) {
    const std::string text = "T1 M6\nG0 X0 Y0 Z5\nG1 Z-1 F100\nG41 D1 X10\nX20\nY10\nG40 X30\nM2\n";
    const Diagnostic found = cut_refusal(text);
    EXPECT_EQ(found.place.line, 4);
    EXPECT_THAT(found.hint, HasSubstr("--tools"));
    CutProgramSettings settings;
    settings.tools = parse_tool_table("T1 P1 D4\n", "tools.tbl");
    EXPECT_EQ(read_cut(text, settings).strokes[0].points[1], Vec2(10, 2));
}

// It was cut with another speed, and the notice said that the program named none.
TEST(CutPrograms, ASpindleThatIsOnlySetTurnsAtThatSpeed) {
    const CutProgram program = read_cut("S1500\nG0 X0 Y0 Z5\nG1 Z-1 F60\nX5\nM2\n");
    EXPECT_EQ(program.spindle_rpm, 1500.0);
    ASSERT_EQ(program.notices.size(), 1U);
    EXPECT_EQ(program.notices[0].message,
              "the program sets a spindle speed, 1500 1/min, but never starts the spindle (M3); here the "
              "spindle is started");
    EXPECT_EQ(read_cut("S1500\nG0 X0 Y0 Z5\nS2000 M3\nG1 Z-1 F60\nX5\nM2\n").spindle_rpm, 2000.0);
}

TEST(CutPrograms, ALaterSpindleSpeedIsReportedWithItsLineWithOrWithoutM3) {
    for (const std::string change : {"S800", "S800 M3", "M4 S1500"}) {
        const CutProgram program =
            read_cut("S1500 M3\nG0 X0 Y0 Z5\nG1 Z-1 F60\nX20\n" + change + "\nX30\nM2\n");
        EXPECT_EQ(program.spindle_rpm, 1500.0);
        ASSERT_EQ(program.notices.size(), 1U) << change;
        EXPECT_EQ(program.notices[0].place.line, 5) << change;
        EXPECT_THAT(
            program.notices[0].message,
            HasSubstr(change[0] == 'S' ? "a second spindle speed: ignored" : "reverse spindle rotation"));
        ASSERT_EQ(program.strokes.size(), 1U);
        EXPECT_EQ(program.strokes[0].points.back(), Vec2(30, 0));
    }
    EXPECT_TRUE(
        read_cut("S1500 M3\nG0 X0 Y0 Z5\nG1 Z-1 F60\nX20\nS1500\nX30\nM5\nS800\nM2\n").notices.empty())
        << "the same speed, and one while the spindle stands";
}

TEST(CutPrograms, AProgramWithoutAnEndIsReadToItsLastLine) {
    const CutProgram program = read_cut("S1500 M3\nG0 X0 Y0 Z5\nG1 Z-1 F60\nX5");
    ASSERT_EQ(program.strokes.size(), 1U);
    EXPECT_EQ(program.strokes[0].points.back(), Vec2(5, 0));
    ASSERT_EQ(program.notices.size(), 1U);
    EXPECT_EQ(program.notices[0].message,
              "the program does not end with M2, M30 or %; it was read to its last line");
    EXPECT_THAT(cut_refusal("%\nG0 X0 Y0 Z5\nG1 Z-1 F60\nX5\n").message, HasSubstr("starts with %"));
}

TEST(CutPrograms, WhatAPathHasNoRecordOfIsToldOnce) {
    const CutProgram program =
        read_cut("S8000 M3\nM8\nG0 X0 Y0 Z5\nG4 P2\nG1 Z-1 F60\nG4 P0.5\nX5\nM0\nM2\n");
    EXPECT_EQ(program.spindle_rpm, 8000.0);
    EXPECT_EQ(program.dwell_time, 2.5);
    std::string told;
    for (const Diagnostic& notice : program.notices) {
        told += to_text(notice) + "\n";
    }
    EXPECT_EQ(told,
              "part.ngc:2: a path cannot contain coolant: ignored\n"
              "part.ngc:4: a path cannot contain dwells: ignored 2 times\n"
              "part.ngc:8: a path cannot contain operator stops: ignored\n");
}

// It ended as an internal error.
TEST(CutPrograms, AnArcOfTooManyChordsIsRefusedWithItsLine) {
    const std::string text = "G0 X0 Y0 Z5\nX1\nG1 Z-1 F9\nG2 X1 Y0 I900000\nM2\n";
    for (const CutProgramSettings& settings :
         {CutProgramSettings{.chord_length = 0.001}, CutProgramSettings{.chord_tolerance = 1e-12}}) {
        const Diagnostic found = cut_refusal(text, settings);
        EXPECT_EQ(found.place.line, 4);
        EXPECT_EQ(found.message, "this arc would need more than ten million chords");
    }
}

TEST(CutPrograms, AreKnownByTheirFirstWord) {
    EXPECT_TRUE(is_gcode("%\n(a plate)\n\n/N1 G21\n"));
    EXPECT_TRUE(is_gcode("x10 y5 f200\n"));
    EXPECT_TRUE(is_gcode("#1=5\n"));
    EXPECT_TRUE(is_gcode("%\n;c\n  #<_depth> = 3\nG21\n"));
    EXPECT_TRUE(is_gcode(":1000\nG21\n"));
    EXPECT_FALSE(is_gcode("#\n"));
    EXPECT_FALSE(is_gcode(":PU0,0;"));
    EXPECT_FALSE(is_gcode("IN;SP1;PU0,0;PD400,0;"));
    EXPECT_FALSE(is_gcode("; nothing\n"));
}

} // namespace
} // namespace millwright::gcode
