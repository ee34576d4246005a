// The plot files that are printed in the KMITL master's thesis of 2006 (forming software for wood and
// plastic), as far as their print is whole: points, lengths, gaps. Plotter units of 0.025 mm.
#include "core/hpgl/reader.h"
#include "tests/core/hpgl/thesis_drawings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <span>

namespace millwright::hpgl {
namespace {

constexpr double printed = 1e-4; // mm

plot::Strokes clean_strokes_of(const std::string& hpgl) {
    const Plot plot = read_hpgl(hpgl, "thesis.plt");
    EXPECT_TRUE(plot.diagnostics.empty()) << to_text(plot.diagnostics.front());
    return plot.strokes;
}

/// Points of one run, as printed in plotter units.
void expect_points(const plot::Stroke& stroke, std::initializer_list<test::At> units) {
    ASSERT_EQ(stroke.points.size(), units.size());
    for (std::size_t n = 0; n < units.size(); ++n) {
        const test::At at = *(units.begin() + n);
        EXPECT_NEAR(stroke.points[n].x(), at.x / 40.0, printed) << n;
        EXPECT_NEAR(stroke.points[n].y(), at.y / 40.0, printed) << n;
    }
}

/// Hatch lines at the printed levels between two X; every other one runs backwards.
void expect_levels(std::span<const plot::Stroke> lines, std::initializer_list<int> levels) {
    ASSERT_EQ(lines.size(), levels.size());
    bool forwards = true;
    for (std::size_t n = 0; n < lines.size(); ++n) {
        const int y = *(levels.begin() + n);
        expect_points(lines[n], {{forwards ? 1509 : 1961, y}, {forwards ? 1961 : 1509, y}});
        forwards = !forwards;
    }
}

TEST(ThesisPlots, FirstExampleIsOneRunOfFourPoints) {
    const Plot plot = read_hpgl(test::first_example(), "thesis.plt");
    ASSERT_EQ(plot.strokes.size(), 1U);
    // As HPGL has it; the prose of the thesis lowers the pen a point later and ends at 4165.
    expect_points(plot.strokes.front(), {{2994, 4197}, {3093, 4165}, {3047, 4144}, {3000, 4100}});
    EXPECT_NEAR(draw_length(plot.strokes), 5.4748, printed);
    const Vec2 end = plot.strokes.front().points.back();
    EXPECT_NEAR((plot.end - end).norm(), 2.4296, printed);
}

TEST(ThesisPlots, SecondExampleIsTwoPensWithOneRunEach) {
    const plot::Strokes strokes = clean_strokes_of(test::second_example());
    ASSERT_EQ(strokes.size(), 2U);
    EXPECT_EQ(strokes[0].pen, 0);
    EXPECT_EQ(strokes[1].pen, 1);
    expect_points(strokes[0], {{2994, 4197}, {3093, 4165}});
    expect_points(strokes[1], {{3540, 4684}, {3200, 4505}});
}

TEST(ThesisPlots, OutlineOfTheEngravingHasItsLength) {
    const plot::Strokes strokes = clean_strokes_of(test::outline_fa());
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_NEAR(draw_length(strokes), 14.4582, printed);
    expect_points(strokes[0],
                  {{893, 692}, {893, 800}, {1039, 800}, {1154, 811}, {1254, 844}, {1340, 899}, {1341, 900}});
}

TEST(ThesisPlots, HatchesOfTheEngravingHaveTheirLengths) {
    const plot::Strokes fb = clean_strokes_of(test::hatch_fb());
    EXPECT_EQ(fb.size(), 6U);
    EXPECT_NEAR(draw_length(fb), 67.8, printed);
    expect_levels(fb, {2984, 3048, 3111, 3175, 3238, 3302});
    const plot::Strokes fcd = clean_strokes_of(test::hatch_fc_fd());
    ASSERT_EQ(fcd.size(), 13U);
    EXPECT_NEAR(draw_length(fcd), 230.35, printed);
    expect_levels(std::span(fcd).first(9), {2095, 2159, 2222, 2286, 2349, 2413, 2476, 2540, 2603});
    expect_points(fcd[9], {{1509, 2667}, {3393, 2667}});
    expect_points(fcd[10], {{3496, 2730}, {1509, 2730}});
    expect_points(fcd[11], {{2768, 4445}, {3461, 4445}});
    expect_points(fcd[12], {{3634, 4381}, {3052, 4381}});
}

TEST(ThesisPlots, PlotListingHasItsLengths) {
    const plot::Strokes first = clean_strokes_of(test::listing_start());
    ASSERT_EQ(first.size(), 1U);
    EXPECT_NEAR(draw_length(first), 14.4114, printed);
    const plot::Strokes later = clean_strokes_of(test::listing_later_part());
    ASSERT_EQ(later.size(), 2U);
    EXPECT_NEAR(length(later[0]), 8.9952, printed);
    EXPECT_NEAR((later[1].points.front() - later[0].points.back()).norm(), 2.7104, printed);
    EXPECT_NEAR(length(later[1]), 19.9363, printed);
}

// The head of AutoCAD's driver for the HP 7475, with its escape sequences full of semicolons.
TEST(ThesisPlots, HeadOfAutocadIsPassedOverAndItsPenKept) {
    const Plot plot =
        read_hpgl(test::autocad_head().append("PU;PA893,692;PD;PA893,800;PU;PA0,0;SP;"), "thesis.plt");
    EXPECT_TRUE(plot.diagnostics.empty());
    EXPECT_TRUE(plot.left_out.empty());
    ASSERT_EQ(plot.strokes.size(), 1U);
    EXPECT_EQ(plot.strokes.front().pen, 1);
    EXPECT_DOUBLE_EQ(plot.pens.at(1).speed, 360.0);
    EXPECT_EQ(plot.end, Vec2(0.0, 0.0));
}

TEST(ThesisPlots, WrappedListingReadsLikeTheWholeOne) {
    const std::string whole = test::autocad_head() + test::hatch_fc_fd();
    const Plot plain = read_hpgl(whole, "thesis.plt");
    for (std::size_t width = 17; width < 80; ++width) {
        std::string wrapped;
        for (std::size_t n = 0; n < whole.size(); n += width) {
            wrapped += whole.substr(n, width) + "\r\n";
        }
        const Plot plot = read_hpgl(wrapped, "thesis.plt");
        ASSERT_TRUE(plot.diagnostics.empty()) << width << to_text(plot.diagnostics.front());
        ASSERT_EQ(plot.strokes.size(), plain.strokes.size()) << width;
        for (std::size_t n = 0; n < plain.strokes.size(); ++n) {
            ASSERT_EQ(plot.strokes[n].points, plain.strokes[n].points) << width;
        }
    }
}

// Experiment of the thesis on the decoder: sizes of 1 to 950 mm in steps of 0.5 mm, decoded to two decimals.
double worst_size_error(const PlotterUnit& unit) {
    double worst = 0.0;
    for (int n = 0; n < 1899; ++n) {
        const double size = 1.0 + 0.5 * n;
        const auto units = static_cast<int>(std::lround(size / unit.x));
        HpglSettings settings;
        settings.unit = unit;
        const Plot plot =
            read_hpgl("IN;SP1;PU0,0;PD" + std::to_string(units) + ",0;PU;", "size.plt", settings);
        const double decoded = std::round(plot.strokes.at(0).points.at(1).x() * 100.0) / 100.0;
        worst = std::max(worst, std::abs(decoded - size));
    }
    return worst;
}

TEST(ThesisPlots, SizesOfTheDecoderComeBackWithinTheErrorOfTheThesis) {
    EXPECT_LT(worst_size_error(nominal_unit), 1e-9);
    const double worst = worst_size_error(table_unit);
    EXPECT_LT(worst, 0.01 + 1e-9);
    EXPECT_GT(worst, 0.01 - 1e-9);
}

} // namespace
} // namespace millwright::hpgl
