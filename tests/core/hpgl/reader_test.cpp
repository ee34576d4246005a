#include "core/hpgl/reader.h"

#include "core/base/files.h"
#include "core/base/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace millwright::hpgl {
namespace {

Plot read(const std::string& text, const HpglSettings& settings = {}) {
    Plot plot = read_hpgl(text, "test.plt", settings);
    EXPECT_TRUE(plot.diagnostics.empty()) << to_text(plot.diagnostics.front());
    return plot;
}

TEST(HpglReader, UnitsAreSetForEachAxis) {
    HpglSettings settings;
    settings.unit = {.x = 0.02, .y = 0.03};
    const Plot plot = read("SP1;PU0,0;PD100,100;", settings);
    EXPECT_LT((plot.strokes.at(0).points.back() - Vec2(2.0, 3.0)).norm(), 1e-12);
}

TEST(HpglReader, CircleWithoutARadiusIsADotAndReadingGoesOn) {
    HpglSettings strict;
    strict.strictness = Strictness::strict;
    for (const char* line_type : {"", "LT2;"}) {
        SCOPED_TRACE(line_type);
        const std::string text = std::string("SP1;") + line_type + "PU400,800;CI0;LT;CI400;PD800,800;PU;";
        const Plot plot = read_hpgl(text, "dot.plt", strict);
        EXPECT_TRUE(plot.diagnostics.empty());
        ASSERT_EQ(plot.strokes.size(), 3U);
        EXPECT_EQ(plot.strokes[0].points, (std::vector<Vec2>{{10.0, 20.0}}));
        EXPECT_EQ(plot.strokes[1].points.size(), 73U); // chords of 5 degrees
        EXPECT_EQ(plot.strokes[2].points, (std::vector<Vec2>{{10.0, 20.0}, {20.0, 20.0}}));
    }
    const Plot down = read_hpgl("SP1;PU400,800;PD;CI0;PU;", "dot.plt", strict);
    EXPECT_EQ(down.strokes.size(), 1U); // not the pen's own dot beside it
    const Plot polygon = read_hpgl("SP1;PU0,0;PM0;PD400,0,400,400;CI0;PM2;EP;", "dot.plt", strict);
    EXPECT_NEAR(draw_length(polygon.strokes), 20.0 + std::hypot(10.0, 10.0), 1e-12);
}

TEST(HpglReader, PenThatGoesDownAndUpLeavesADot) {
    const Plot plot = read("SP1;PU400,800;PD;PU;PA0,0;");
    ASSERT_EQ(plot.strokes.size(), 1U);
    EXPECT_EQ(plot.strokes[0].points, std::vector<Vec2>{Vec2(10.0, 20.0)});
}

TEST(HpglReader, SelectingAPenWithoutNumberPutsItAway) {
    const Plot plot = read("SP3;PU0,0;PD100,0;SP;PD200,0;PU;");
    ASSERT_EQ(plot.strokes.size(), 1U);
    EXPECT_EQ(plot.strokes[0].pen, 3);
    const Plot zero = read("SP0;PU0,0;PD100,0;");
    ASSERT_EQ(zero.strokes.size(), 1U);
    EXPECT_EQ(zero.strokes[0].pen, 0);
}

TEST(HpglReader, AFileWithoutPenDrawsWithPenOne) {
    EXPECT_EQ(read("IN;PU0,0;PD100,0;").strokes.at(0).pen, 1);
}

TEST(HpglReader, StrokesKnowTheirCommand) {
    const Plot plot = read("SP1;PU0,0;PD100,0;PU5,5;PD9,9;");
    EXPECT_EQ(plot.strokes.at(0).byte, 10);
    EXPECT_EQ(plot.strokes.at(1).byte, 24);
}

TEST(HpglReader, AirIsTheStraightWayBetweenStrokes) {
    const Plot plot = read("SP1;PU400,0;PU400,400;PD800,400;PU0,400;");
    EXPECT_NEAR(air_length(plot.strokes, Vec2::Zero(), plot.end), std::hypot(10.0, 10.0) + 20.0, 1e-12);
}

TEST(HpglReader, CommandsThatAMachineCannotFollowAreListed) {
    const Plot plot = read("IN;NP8;PC1,255,0,0;PC2,0,0,0;OI;SP1;PU0,0;PD1,1;");
    ASSERT_EQ(plot.left_out.size(), 3U);
    EXPECT_EQ(plot.left_out[1].name, "PC");
    EXPECT_EQ(plot.left_out[1].count, 2);
    EXPECT_EQ(plot.left_out[1].byte, 7);
    EXPECT_EQ(plot.commands, 8);
}

TEST(HpglReader, NoticesHaveWhatIsWrongAndWhatIsLeftOut) {
    HpglSettings settings;
    settings.most_diagnostics = 1;
    const Plot plot = read_hpgl("IN;QX;QY;PC1;PC2;SP1;PU0,0;PD1,1;", "a.plt", settings);
    std::vector<std::string> lines;
    for (const Diagnostic& notice : notices(plot, "a.plt")) {
        lines.push_back(to_text(notice));
    }
    EXPECT_EQ(lines,
              (std::vector<std::string>{
                  "a.plt byte 3: QX is not an HPGL command",
                  "a.plt: and 1 more",
                  "a.plt byte 9: 2 PC ignored: colours of pens and paper have no effect on cutting"}));
}

TEST(HpglReader, CommentsAreNoCommands) {
    EXPECT_TRUE(read("SP1;CO\"one; PD999,999;\";CO two PD5,5;PU;").strokes.empty());
}

TEST(HpglReader, LineEndsSeparateNumbersWhereTheyCan) {
    EXPECT_EQ(read("SP1;PU0,0;PD400,0\n400,400\n;PU;").strokes.at(0).points.size(), 3U);
    EXPECT_EQ(read("SP1;PU0,0;PD40\n0,0;PU;").strokes.at(0).points.back(), Vec2(10.0, 0.0));
    HpglSettings join;
    join.line_ends = LineEnds::join;
    EXPECT_EQ(read("SP1;PU0,0;PD40\n0,4\n00;PU;", join).strokes.at(0).points.back(), Vec2(10.0, 10.0));
}

TEST(HpglReader, RotationTurnsAboutTheOrigin) {
    const Vec2 turned[] = {{-10.0, 40.0}, {-40.0, -10.0}, {10.0, -40.0}, {40.0, 10.0}};
    int degrees = 90;
    for (const Vec2& end : turned) {
        const std::string ro = "RO" + std::to_string(degrees % 360) + ";";
        EXPECT_EQ(read("SP1;RO270;" + ro + "PU0,0;PD1600,400;").strokes.at(0).points.back(), end) << ro;
        degrees += 90;
    }
}

TEST(HpglReader, ThreePointsGiveTheArcThatAngleAndCentreGive) {
    const auto by_angle = read("SP1;PU7000,1000;PD;AA8000,1000,-180;PU;").strokes.at(0).points;
    const auto by_points = read("SP1;PU7000,1000;PD;AT8000,2000,9000,1000;PU;").strokes.at(0).points;
    const auto by_steps = read("SP1;PU7000,1000;PD;RT1000,1000,2000,0;PU;").strokes.at(0).points;
    ASSERT_EQ(by_points.size(), by_angle.size());
    ASSERT_EQ(by_steps.size(), by_angle.size());
    for (std::size_t n = 0; n < by_angle.size(); ++n) {
        EXPECT_LT((by_points[n] - by_angle[n]).norm(), 1e-9);
        EXPECT_LT((by_steps[n] - by_angle[n]).norm(), 1e-9);
    }
    const Plot straight = read("SP1;PU0,0;PD;AT500,500,1000,1000;PU;");
    EXPECT_EQ(straight.strokes.at(0).points.size(), 2U);
}

TEST(HpglReader, ChordsByDeviationStayWithinIt) {
    const auto points = read("SP1;CT1;PU0,0;CI4000,40;").strokes.at(0).points; // 1 mm from a circle of 100 mm
    const double gap = 100.0 - ((points[0] + points[1]) / 2.0).norm();
    EXPECT_LE(gap, 1.0 + 1e-9);
    EXPECT_GT(gap, 0.7);
}

TEST(HpglReader, FinerArcsStayWithinTheTolerance) {
    HpglSettings settings;
    settings.arc_tolerance = 0.001;
    const Plot plot = read("SP1;PU2000,2000;CI1000;", settings);
    const Vec2 centre(50.0, 50.0);
    const auto& points = plot.strokes.at(0).points;
    for (std::size_t n = 1; n < points.size(); ++n) {
        EXPECT_NEAR((points[n] - centre).norm(), 25.0, 1e-9);
        EXPECT_GT(((points[n] + points[n - 1]) / 2.0 - centre).norm(), 25.0 - 0.001);
    }
    EXPECT_NEAR(draw_length(plot.strokes), 2.0 * pi * 25.0, 0.01);
}

TEST(HpglReader, PolylineWithFractionsIsDecoded) {
    // 0.5, 0.25 with two fractional bits: 2, 1; shifted one for the sign: 4, 2.
    const std::string text = std::string("SP1;PE>") + char(191 + 4) + char(191 + 4) + char(191 + 2) + ";PU;";
    const Plot plot = read(text);
    EXPECT_LT((plot.strokes.at(0).points.back() - Vec2(0.5, 0.25) * 0.025).norm(), 1e-15);
}

TEST(HpglReader, FillsAreHatchedAtTheirPitch) {
    // 80 lines of 50 mm, 40 units = 1 mm apart, none on the upper edge.
    const Plot plot = read("IP0,0,10000,7200;SP1;PU0,20;FT3,40,0;RA2000,3220;");
    EXPECT_EQ(plot.strokes.size(), 80U);
    EXPECT_NEAR(draw_length(plot.strokes), 80 * 50.0, 1e-9);
    HpglSettings none;
    none.fill = FillMode::none;
    EXPECT_TRUE(read("SP1;PU0,20;FT3,40,0;RA2000,3220;", none).strokes.empty());
}

TEST(HpglReader, PolygonsHaveHolesByTheEvenOddRule) {
    const Plot plot = read("SP1;FT3,40,0;PU0,20;PM0;PD2000,20,2000,2020,0,2020;PM1;PU500,520;PD1500,520,1500,"
                           "1520,500,1520;PM2;FP;");
    EXPECT_NEAR(draw_length(plot.strokes), 50 * 50.0 - 25 * 25.0, 1e-9);
}

TEST(HpglReader, LabelsAreDrawnInTheirSize) {
    const Plot plot = read("SP1;SI0.5,1;PU4000,4000;LBH\x03");
    const auto box = extents(plot.strokes);
    ASSERT_TRUE(box);
    EXPECT_LT((box->lower - Vec2(100.0, 100.0)).norm(), 1e-9);
    EXPECT_LT((box->upper - Vec2(105.0, 110.0)).norm(), 1e-9);
    EXPECT_NEAR(draw_length(plot.strokes), 10.0 + 10.0 + 5.0, 1e-9);
    EXPECT_LT((plot.end - Vec2(107.5, 100.0)).norm(), 1e-9);
}

TEST(HpglReader, CharactersBeyondAsciiAreListed) {
    const Plot plot = read("SP1;PU0,0;LBa\xE4o\x03");
    ASSERT_EQ(plot.left_out.size(), 1U);
    EXPECT_THAT(plot.left_out[0].why, ::testing::HasSubstr("not ASCII"));
}

TEST(HpglReader, EverySampleIsReadStrictly) {
    HpglSettings strict;
    strict.strictness = Strictness::strict;
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("assets/samples/plot")) {
        if (entry.path().extension() != ".plt") {
            continue; // what made one of them
        }
        SCOPED_TRACE(entry.path());
        EXPECT_FALSE(read_hpgl_file(entry.path(), strict).strokes.empty());
        ++count;
    }
    EXPECT_GE(count, 12);
}

// VS without a pen is of all pens; that of the head, before SP1, too.
TEST(HpglReader, ASpeedWithoutAPenIsOfAllPens) {
    const Plot plot = read_hpgl("IN;VS36;SP1;PD400,0;PU;SP2;PD0,0;VS10,3;PU;SP3;PD0,400;PU;SP;", "speed.plt");
    EXPECT_DOUBLE_EQ(plot.pens.at(1).speed, 360.0);
    EXPECT_DOUBLE_EQ(plot.pens.at(2).speed, 360.0);
    EXPECT_DOUBLE_EQ(plot.pens.at(3).speed, 100.0);
}

} // namespace
} // namespace millwright::hpgl
