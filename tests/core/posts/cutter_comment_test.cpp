// The comment that names a cutter: written by every post, read by the reader of tool comments.
#include "core/base/units.h"
#include "core/gcode/tool_comments.h"
#include "core/plot/plot_program.h"
#include "core/posts/post_file.h"
#include "core/posts/writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace millwright::program {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Program program_with(std::vector<ProgramCutter> cutters) {
    Program program;
    program.axes = {{'X'}, {'Y'}, {'Z'}};
    program.start = kinematics::AxisPositions::Zero(3);
    program.cutters = std::move(cutters);
    Block& end = program.blocks.emplace_back();
    end.kind = BlockKind::end;
    end.target = program.start;
    return program;
}

std::string text_of(const Program& program, const posts::PostFormat& format) {
    return write_text(program, posts::axis_program_words(program), format, {}).text;
}

TEST(CutterComment, IsWrittenAsFusionDoes) {
    const auto only = [](ProgramCutter cutter) {
        const std::string text = posts::write_gcode(program_with({std::move(cutter)}), {}).text;
        return text.substr(0, text.find('\n'));
    };
    EXPECT_EQ(only({.number = 1, .diameter = 6.0, .corner_radius = 0.0, .kind = "flat end mill"}),
              "(T1 D=6. CR=0. - FLAT END MILL)");
    EXPECT_EQ(only({.number = 12, .diameter = 3.175, .corner_radius = 1.5, .kind = "ball end mill"}),
              "(T12 D=3.175 CR=1.5 - BALL END MILL)");
    EXPECT_EQ(only({.number = 2, .diameter = 6.0, .corner_radius = 0.0, .half_angle = from_degrees(22.5)}),
              "(T2 D=6. CR=0. TAPER=22.5DEG)");
    EXPECT_EQ(only({.number = 1,
                    .diameter = 12.0,
                    .corner_radius = 0.0,
                    .half_angle = from_degrees(45.0),
                    .tip_diameter = 0.2,
                    .kind = "engraving tool"}),
              "(T1 D=12. CR=0. TAPER=45DEG TIP=0.2 - ENGRAVING TOOL)");
    EXPECT_EQ(only({.number = 0, .diameter = 6.35}), "(D=6.35)");
}

TEST(CutterComment, OfEveryPostIsReadAsItWasMeant) {
    int posts = 0;
    for (const auto& entry : std::filesystem::directory_iterator("assets/posts")) {
        const posts::PostFormat format = posts::read_post(entry.path());
        const std::string text = text_of(
            program_with({{.number = 1, .diameter = 3.175, .corner_radius = 0.0, .kind = "flat end mill"},
                          {.number = 2, .diameter = 0.5, .corner_radius = 0.25, .kind = "ball end mill"}}),
            format);
        const auto tools = gcode::tools_in_comments(text);
        ASSERT_EQ(tools.size(), 2U) << entry.path() << "\n" << text;
        EXPECT_EQ(tools[0].number, 1) << entry.path();
        constexpr double digits = 2e-5; // mm: six decimals of an inch
        EXPECT_NEAR(tools[0].diameter, 3.175, digits) << entry.path();
        EXPECT_EQ(tools[1].number, 2) << entry.path();
        EXPECT_NEAR(tools[1].diameter, 0.5, digits) << entry.path();
        ++posts;
    }
    EXPECT_GE(posts, 8);
}

TEST(CutterComment, CountsInTheUnitOfTheProgram) {
    posts::PostFormat format;
    format.inches = true;
    format.blocks.head = {"G20 G90 G17 G40 G49 G80"};
    const std::string text = text_of(program_with({{.number = 1, .diameter = 6.35}}), format);
    EXPECT_THAT(text, HasSubstr("(T1 D=0.25)\n"));
    ASSERT_EQ(gcode::tools_in_comments(text).size(), 1U);
    EXPECT_NEAR(gcode::tools_in_comments(text)[0].diameter, 6.35, 1e-9);
}

TEST(CutterComment, NamesTheToolsOfAPlotAndNoPoint) {
    plot::CutPath path{{.at = {0.0, 0.0, 5.0}},
                       {.at = {0.0, 0.0, -1.0}, .speed = 1.0, .move = plot::CutMove::plunge},
                       {.at = {0.0, 0.0, 5.0}, .move = plot::CutMove::retract},
                       {.at = {0.0, 0.0, 25.0}, .move = plot::CutMove::tool_change, .tool = 4},
                       {.at = {9.0, 0.0, 5.0}, .tool = 4}};
    plot::ToolTips tips{{.kind = plot::TipKind::v, .diameter = 6.0, .angle = from_degrees(60.0)},
                        {{4, {.kind = plot::TipKind::ball, .diameter = 2.0}}}};
    const Program program = plot::plot_program(path, {.tips = tips});
    EXPECT_THAT(posts::write_gcode(program, {}).text,
                HasSubstr("(T1 D=6. CR=0. TAPER=30DEG - ENGRAVING TOOL)\n(T4 D=2. CR=1. - BALL END MILL)\n"));
    tips.usual.end_width = 0.25;
    EXPECT_THAT(posts::write_gcode(plot::plot_program(path, {.tips = tips}), {}).text,
                HasSubstr("(T1 D=6. CR=0. TAPER=30DEG TIP=0.25 - ENGRAVING TOOL)"));
    tips.usual.kind = plot::TipKind::point;
    const auto without = plot::plot_program(path, {.tips = tips}).cutters;
    ASSERT_EQ(without.size(), 1U);
    EXPECT_EQ(without[0].number, 4);
    EXPECT_TRUE(plot::plot_program(path).cutters.empty());
}

} // namespace
} // namespace millwright::program
