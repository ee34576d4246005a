// What the ends of lines between two digits mean, and files that begin or end in an unusual way.
#include "core/base/error.h"
#include "core/hpgl/reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace millwright::hpgl {
namespace {

using testing::HasSubstr;

/// A circle of 75 mm as one PD, numbers of three and four digits.
std::string circle() {
    std::string text = "IN;SP1;PU7000,4000;PD";
    constexpr int corners = 50;
    for (int n = 1; n <= corners; ++n) {
        const double angle = 2.0 * std::numbers::pi * n / corners;
        text += fmt::format("{}{:.0f},{:.0f}",
                            n == 1 ? "" : ",",
                            4000.0 + 3000.0 * std::cos(angle),
                            4000.0 + 3600.0 * std::sin(angle));
    }
    return text + ";PU;SP0;";
}

std::string wrapped(const std::string& text, std::size_t width, const std::string& line_end) {
    std::string lines;
    for (std::size_t at = 0; at < text.size(); at += width) {
        lines += (at == 0 ? "" : line_end) + text.substr(at, width);
    }
    return lines;
}

std::string refusal_of(const std::string& text) {
    try {
        (void)read_hpgl(text, "a.plt");
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "none";
}

// 1.94 m were drawn for .47 m, without a word.
TEST(HpglLineEnds, NumbersThatAreWrappedAnywhereStayWhole) {
    const plot::Strokes whole = read_hpgl(circle(), "a.plt").strokes;
    for (std::size_t width = 60; width <= 255; ++width) {
        for (const std::string line_end : {"\n", "\r\n", "\r"}) {
            const std::string text = wrapped(circle(), width, line_end);
            const std::string refused = refusal_of(text);
            if (refused != "none") { // better than another drawing
                EXPECT_THAT(refused, HasSubstr("not clear from the file")) << width;
                continue;
            }
            const Plot plot = read_hpgl(text, "a.plt");
            ASSERT_EQ(plot.strokes.size(), 1U) << width;
            EXPECT_EQ(plot.strokes.front().points, whole.front().points) << width;
            EXPECT_TRUE(plot.diagnostics.empty()) << width;
        }
    }
}

TEST(HpglLineEnds, TheUsualWidthsAreReadWithANotice) {
    const plot::Strokes whole = read_hpgl(circle(), "a.plt").strokes;
    for (const std::size_t width : {79U, 132U}) {
        const std::string text = wrapped(circle(), width, "\r\n");
        ASSERT_EQ(refusal_of(text), "none") << width;
        const Plot plot = read_hpgl(text, "a.plt");
        EXPECT_EQ(plot.strokes.front().points, whole.front().points) << width;
        ASSERT_TRUE(plot.line_ends) << width;
        EXPECT_THAT(plot.line_ends->message, HasSubstr("are read as wraps within numbers"));
        EXPECT_EQ(notices(plot, "a.plt").front(), *plot.line_ends);
        HpglSettings strict;
        strict.strictness = Strictness::strict; // it is no fault
        EXPECT_EQ(read_hpgl(text, "a.plt", strict).strokes.front().points, whole.front().points);
    }
}

TEST(HpglLineEnds, PairsOnLinesOfTheirOwnAreSeparate) {
    const Plot plot = read_hpgl("SP1;PU0,0;PD400,0\n400,1200\n8000,1200;PU;", "a.plt");
    ASSERT_EQ(plot.strokes.size(), 1U);
    EXPECT_EQ(plot.strokes.front().points.back(), Vec2(200.0, 30.0));
    EXPECT_EQ(plot.strokes.front().points.size(), 4U);
    ASSERT_TRUE(plot.line_ends); // two numbers of one fit, too
    EXPECT_THAT(plot.line_ends->message,
                HasSubstr("line ends between two digits are read as separators (2, this is the first)"));
    const Plot blanks = read_hpgl("SP1\nPU 0 0\nPD 4000 0\nPD 4000 2000\nPU\n", "a.plt");
    EXPECT_EQ(blanks.strokes.front().points.size(), 3U);
    EXPECT_FALSE(blanks.line_ends);
}

TEST(HpglLineEnds, ASignBeforeALineEndBelongsToTheDigitsBehindIt) {
    const Plot plot = read_hpgl("SP1;PU0,0;PD400,-\n400,0,800;PU;", "a.plt");
    EXPECT_TRUE(plot.diagnostics.empty());
    ASSERT_EQ(plot.strokes.size(), 1U);
    EXPECT_EQ(plot.strokes.front().points[1], Vec2(10.0, -10.0));
    EXPECT_TRUE(plot.line_ends);
}

TEST(HpglLineEnds, AFileThatDoesNotShowItIsRefused) {
    const std::string text = "SP1;PU0,0;PD40\n0,4\n00;PU;"; // 40 0, 4 0 or 400, 400
    EXPECT_THAT(
        refusal_of(text),
        HasSubstr("a.plt byte 14: it is not clear from the file whether line ends between two digits"));
    EXPECT_THAT(refusal_of(text), HasSubstr("--line-ends separate or join"));
    HpglSettings chosen;
    chosen.line_ends = LineEnds::separate;
    EXPECT_EQ(read_hpgl(text, "a.plt", chosen).strokes.front().points.back(), Vec2(0.1, 0.0));
    chosen.line_ends = LineEnds::join;
    EXPECT_EQ(read_hpgl(text, "a.plt", chosen).strokes.front().points.back(), Vec2(10.0, 10.0));
}

// The mark took the first command with it: an IP, and with it the scale.
TEST(HpglBeginAndEnd, AByteOrderMarkIsSkipped) {
    const std::string mark = "\xEF\xBB\xBF";
    for (const std::string text : {"IP0,0,4000,4000;SC0,100,0,100;PU0,0;PD100,0;PU;",
                                   "PU1000,1000;PD4000,1000;PU;",
                                   "IN\nSP1\nPU 0 0\nPD 4000 0\nPD 4000 2000\nPU\nSP0\n"}) {
        const Plot plain = read_hpgl(text, "a.plt");
        const Plot marked = read_hpgl(mark + text, "a.plt");
        EXPECT_TRUE(marked.diagnostics.empty()) << text;
        ASSERT_EQ(marked.strokes.size(), plain.strokes.size()) << text;
        EXPECT_EQ(marked.strokes.front().points, plain.strokes.front().points) << text;
        EXPECT_EQ(marked.strokes.front().byte, plain.strokes.front().byte + 3) << text; // of the file
    }
}

TEST(HpglBeginAndEnd, ALastCommandWithoutItsEndKeepsWhatIsCertain) {
    const Plot closed = read_hpgl("IN;SP1;PU0,0;PD4000,0,4000,2000,0,2000,0,0", "a.plt");
    ASSERT_EQ(closed.strokes.size(), 1U);
    EXPECT_EQ(closed.strokes.front().points.size(), 5U);
    ASSERT_EQ(closed.diagnostics.size(), 1U);
    EXPECT_THAT(closed.diagnostics.front().hint, HasSubstr("closes the stroke and is used"));
    // 20 may be the beginning of 2000.
    const Plot open = read_hpgl("IN;SP1;PU0,0;PD4000,0,4000,2000,0,20", "a.plt");
    ASSERT_EQ(open.strokes.size(), 1U);
    EXPECT_EQ(open.strokes.front().points.back(), Vec2(100.0, 50.0));
    EXPECT_THAT(open.diagnostics.front().hint, HasSubstr("may be incomplete and is ignored"));
    const Plot relative = read_hpgl("IN;SP1;PU0,0;PR;PD400,0,0,400,-400,0,0,-400", "a.plt");
    EXPECT_EQ(relative.strokes.front().points.size(), 5U);
    EXPECT_TRUE(read_hpgl("IN;SP1;PU0,0;PD4000,0", "a.plt").strokes.empty());
}

} // namespace
} // namespace millwright::hpgl
