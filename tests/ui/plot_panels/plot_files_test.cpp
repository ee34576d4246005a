// One file after another in the Plot & Picture workspace: what is shown, reported and sent is of the open
// one.
#include "core/base/files.h"
#include "core/plot/decode.h"
#include "core/plot/point_file.h"
#include "tests/ui/person/plot_person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::panels {
namespace {

namespace fs = std::filesystem;
using test::PlotPerson;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string with_s = "G21 G90\nM3 S8000\nG0 Z5\nG0 X1 Y1\nG1 Z-1 F100\nG1 X20\nG0 Z5\nM2\n";

std::vector<std::string> split_lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

fs::path file_in(const PlotPerson& bench, const std::string& name, const std::string& text) {
    std::ofstream(bench.folder / name) << text;
    return bench.folder / name;
}

const std::string cam_program = "(T1 D=6. CR=0. - FLAT END MILL)\n" + with_s;

// The 6 mm of one file's comment offset the outlines of the next one.
TEST(PlotFiles, TheToolOfACommentIsThatOfItsFileAlone) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    const auto diameter = [&bench] { return bench.plot().settings().strokes.tool_diameter; };
    bench.person.fill_in("inspector/cutter/tool_mm", "2");
    bench.settle();
    bench.drop(file_in(bench, "cam.ngc", cam_program));
    EXPECT_DOUBLE_EQ(diameter(), 6.0);
    EXPECT_THAT(bench.person.app().view_state().log.back(),
                HasSubstr("line 1 gives a tool diameter of 6 mm"));
    bench.drop("assets/samples/plot/everyday.plt");
    EXPECT_DOUBLE_EQ(diameter(), 2.0) << "as it was before";
    bench.person.press_key(render::Key::z, true);
    ASSERT_EQ(bench.plot().file().filename(), "cam.ngc");
    bench.drop("assets/samples/plot/everyday.plt");
    EXPECT_DOUBLE_EQ(diameter(), 2.0) << "behind undo, too";

    bench.drop(file_in(bench, "cam2.ngc", cam_program));
    bench.person.fill_in("inspector/cutter/tool_mm", "4");
    bench.settle();
    bench.drop("assets/samples/plot/everyday.plt");
    EXPECT_DOUBLE_EQ(diameter(), 4.0) << "what a person typed stays";
}

TEST(PlotFiles, TheProgramsOwnSpindleCountsUntilAPersonTypesAnother) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    EXPECT_THAT(bench.made().program->listing->text, HasSubstr("S10000"));
    bench.drop(file_in(bench, "turns.ngc", with_s));
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    EXPECT_THAT(bench.made().program->listing->text, HasSubstr("S8000"));
    EXPECT_TRUE(bench.made().notices.empty());
    bench.person.keep("plot-spindle");
    bench.person.fill_in("inspector/work/spindle_rpm", "10000");
    bench.settle();
    EXPECT_THAT(bench.made().program->listing->text, HasSubstr("S10000"));
    ASSERT_EQ(bench.made().notices.size(), 1U);
    EXPECT_THAT(bench.made().notices[0].message, HasSubstr("8000 rpm, but here it is set to 10000"));
    bench.person.fill_in("inspector/work/spindle_rpm", "8000");
    bench.settle();
    EXPECT_FALSE(bench.plot().settings().spindle_rpm);
    EXPECT_TRUE(bench.made().notices.empty());
}

// The figures and the buttons of the file before were alive until those of this one came.
TEST(PlotFiles, NothingOfTheFileBeforeIsShownOrSentForThisOne) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    EXPECT_THAT(bench.person.refusal("inspector/plot_to_machine"), IsEmpty());
    std::string strokes = "IN;SP1;";
    for (int n = 0; n < 50'000; ++n) {
        const int at = (n * 7919) % 10'000;
        strokes += "PU" + std::to_string(at) + "," + std::to_string(n % 9973) + ";PD" +
                   std::to_string(at + 5) + "," + std::to_string(n % 9973) + ";";
    }
    bench.person.app().receive({file_in(bench, "many.plt", strokes)});
    bench.person.app().edit( // takes its time where there is much to order
        "Order",
        [](project::Project& draft) { draft.plot.settings.strokes.order = true; },
        {});
    bench.plot().cancel(); // before anything of it is there
    bench.plot().wait_idle();
    bench.person.frames(3);
    EXPECT_FALSE(bench.plot().latest());
    EXPECT_FALSE(bench.person.sees("layers/figures"));
    for (const char* button :
         {"inspector/plot_to_machine", "inspector/plot_write_program", "inspector/plot_write_path"}) {
        EXPECT_THAT(bench.person.refusal(button), HasSubstr("was cancelled")) << button;
    }
    bench.person.keep("plot-cancelled");
    bench.drop(file_in(bench, "turns.ngc", with_s));
    EXPECT_THAT(bench.person.refusal("inspector/plot_to_machine"), IsEmpty());
    EXPECT_NEAR(bench.made().lengths.cut, 25.0, 1e-9);
}

TEST(PlotFiles, FiguresOfOtherSettingsAreNotShownForThese) {
    PlotPerson bench("assets/samples/plot/thesis-sign.plt");
    // The figures may be there before they are cancelled: then once more, with another setting.
    constexpr int tries = 100;
    bool cancelled = false;
    for (int n = 0; n < tries && !cancelled; ++n) {
        bench.person.app().edit(
            "Change depth", [n](project::Project& draft) { draft.plot.settings.safe_height = 7.0 + n; }, {});
        bench.plot().cancel();
        bench.plot().wait_idle();
        ASSERT_TRUE(bench.plot().latest());
        cancelled = !bench.plot().is_current(*bench.plot().latest());
    }
    ASSERT_TRUE(cancelled);
    bench.person.frames(3);
    EXPECT_THAT(bench.person.refusal("inspector/plot_write_path"), HasSubstr("was cancelled"));
    EXPECT_TRUE(bench.person.sees("inspector/given_up"));
    bench.person.keep("plot-other-settings");
    bench.person.click("inspector/again");
    bench.settle();
    EXPECT_FALSE(bench.person.sees("inspector/given_up"));
    EXPECT_TRUE(bench.plot().is_current(bench.made()));
}

TEST(PlotFiles, WhatWasSetForOneDrawingIsNotDoneToTheNext) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.person.app().edit("Shape",
                            [](project::Project& draft) {
                                project::PlotSettings& set = draft.plot.settings;
                                set.strokes.link = 3.0;
                                set.strokes.hatch_pitch = 1.0;
                                set.strokes.tool_diameter = 2.0;
                                set.origin = {5.0, 5.0};
                                set.through = true;
                                set.plate = 4.0;
                            },
                            {});
    bench.drop(file_in(bench, "line.plt", "IN;SP1;PU0,0;PD400,0;PU;"));
    const project::PlotSettings& set = bench.plot().settings();
    EXPECT_EQ(set.strokes, (plot::StrokePlan{.tool_diameter = 2.0}));
    EXPECT_EQ(set.origin, Vec2(0.0, 0.0));
    EXPECT_FALSE(set.through);
    EXPECT_EQ(set.plate, 4.0);
    bench.person.press_key(render::Key::z, true);
    EXPECT_EQ(bench.plot().file().filename(), "everyday.plt");
    EXPECT_EQ(bench.plot().settings().strokes.link, 3.0);
}

TEST(PlotFiles, WhatIsWrongWithAFileStandsUnderNoticesAndItsNameBelow) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.drop(file_in(bench, "turns.ngc", with_s));
    bench.drop(file_in(bench, "scaled.ngc", "G21 G90\nG0 Z5\nG68 R20\nG1 Z-1 F100\nM2\n"));
    ASSERT_TRUE(bench.made().failure);
    bench.person.click("lower/tabs/notices");
    bench.person.frames(3);
    EXPECT_TRUE(bench.person.sees("lower/what_is_wrong"));
    bench.person.keep("plot-wrong-program");
}

TEST(PlotFiles, AnotherFileIsPlayedFromItsBeginning) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.person.click("timeline/timeline/last");
    bench.person.frames(3);
    ASSERT_GT(bench.person.app().look().time(), 0.0);
    bench.drop(file_in(bench, "turns.ngc", with_s));
    ASSERT_GT(bench.person.app().look().duration(), 0.0);
    EXPECT_DOUBLE_EQ(bench.person.app().look().time(), 0.0);
}

TEST(PlotFiles, ThePointsThatATableIsSentAreWritten) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    actions::TableChoice choice = bench.person.app().look().plot.table_choice();
    choice.decoding.velocity = 12.0;
    choice.decoding.period = 0.05;
    bench.person.app().plot().set_table(choice);
    bench.person.click("lower/tabs/table");
    bench.person.click("lower/plot_write_points");
    bench.settle();
    const fs::path written = bench.folder / "everyday.csv";
    ASSERT_TRUE(fs::exists(written));
    const auto read = plot::read_points(read_file(written), written);
    EXPECT_TRUE(read.diagnostics.empty());
    const std::vector<Vec3> whole =
        plot::decode_path(*bench.made().path, choice.decoding, std::nullopt, std::nullopt).points;
    ASSERT_EQ(read.points.size(), whole.size());
    for (std::size_t n = 0; n < whole.size(); ++n) {
        EXPECT_LT((read.points[n] - whole[n]).norm(), 1e-4);
    }
    bench.drop(written);
    EXPECT_TRUE(bench.made().points);
}

/// Rule of the thesis of 2006 on forming software: equal chords, no longer than that along the arc.
TEST(PlotFiles, TheChordLengthOfArcsIsTypedInTheWindow) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.drop(file_in(
        bench, "circle.ngc", "G21 G90\nG0 Z5\nG0 X10 Y20\nG1 Z-1 F100\nG2 X10 Y20 I10 J0\nG0 Z5\nM2\n"));
    const auto chords = [&] { // of a circumference of 62.83 mm; one line more leads to the circle
        const std::string text = bench.made().program->listing->text;
        return std::ranges::count_if(
                   split_lines(text),
                   [](const std::string& line) { return line.starts_with('X') || line.starts_with('Y'); }) -
               1;
    };
    EXPECT_EQ(bench.plot().settings().chord_length, std::nullopt);
    EXPECT_GT(chords(), 100) << "within 0.002 mm";
    bench.person.fill_in("inspector/source/chord_length_mm", "5");
    bench.settle();
    EXPECT_EQ(bench.plot().settings().chord_length, 5.0);
    EXPECT_EQ(chords(), 13);
    bench.person.keep("plot-chord-length");
    bench.person.fill_in("inspector/source/chord_length_mm", "2.22");
    bench.settle();
    EXPECT_EQ(chords(), 29);
    bench.person.fill_in("inspector/source/chord_length_mm", "0");
    bench.settle();
    EXPECT_EQ(bench.plot().settings().chord_length, std::nullopt);
    EXPECT_GT(chords(), 100);
}

} // namespace
} // namespace millwright::panels
