// The Plot & Picture workspace with real mouse and keys in real OpenGL.
#include "tests/support/scratch_folder.h"
#include "tests/ui/panels/person.h"
#include "ui/panels/window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <ranges>
#include <string>

namespace millwright::panels {
namespace {

using actions::PlotBench;
using actions::Workbench;
using actions::Workspace;
using test::Person;
using testing::HasSubstr;

namespace fs = std::filesystem;

/// A person who has dropped a file on the window.
struct Bench {
    explicit Bench(const fs::path& file, const render::PixelSize& screen = {1280, 800}) : person(screen) {
        fs::copy_file(file, folder / file.filename());
        drop(folder / file.filename());
    }
    void drop(const fs::path& file) {
        person.workshop().receive({file}); // as the window does it for what is dropped on it
        settle();
    }
    /// Until everything is derived and looked at.
    void settle() {
        person.wait_idle();
        person.frames(3);
    }
    [[nodiscard]] PlotBench& plot() { return person.workshop().plot(); }
    [[nodiscard]] const project::PlotResult& made() {
        result = plot().latest();
        return *result;
    }
    /// Pixels of the window that are like it.
    [[nodiscard]] int pixels_like(const std::function<bool(int r, int g, int b)>& wanted) {
        const render::Picture picture = person.picture();
        return static_cast<int>(std::ranges::count_if(
            picture.pixels, [&](const render::Pixel& at) { return wanted(at[0], at[1], at[2]); }));
    }

    test::ScratchFolder folder;
    Person person;
    std::shared_ptr<const project::PlotResult> result;
};

TEST(PlotWorkspace, OpensWhatIsDroppedAndShowsEveryPart) {
    Bench bench("assets/samples/plot/hatched-sign.plt");
    EXPECT_EQ(bench.person.workshop().session().workspace, Workspace::plot);
    ASSERT_FALSE(bench.made().failure);
    for (const char* path : {"layers/levels",
                             "layers/level/depth_mm",
                             "layers/figures/compared/thesis",
                             "inspector/cutter/tool_mm",
                             "inspector/fill/hatch_mm",
                             "inspector/travel/link_mm",
                             "lower/materials",
                             "timeline/timeline/play"}) {
        EXPECT_TRUE(bench.person.sees(path)) << path;
    }
    EXPECT_TRUE(bench.person.workshop().look().in_file()); // its program can be played
    EXPECT_GT(bench.person.workshop().look().duration(), 60.0);
    bench.person.keep("plot");
}

TEST(PlotWorkspace, PlayingShowsWhereTheToolIsHowFarItHasGoneAndWhatRemains) {
    Bench bench("assets/samples/plot/everyday.plt", {1600, 1200});
    for (const char* path : {"layers/position/gone", "layers/position/left", "layers/position"}) {
        EXPECT_TRUE(bench.person.sees(path)) << path;
    }
    const Workbench begun = bench.person.workshop().look();
    ASSERT_GT(begun.duration(), 0.0);
    EXPECT_DOUBLE_EQ(begun.time(), 0.0);
    bench.person.click("timeline/timeline/last");
    bench.person.frames(3);
    const Workbench done = bench.person.workshop().look();
    EXPECT_NEAR(done.time(), begun.duration(), 1e-6);
    const motion::Trajectory& way = *done.opened->motion->trajectory;
    EXPECT_NEAR(way.part_length_at(done.time()), way.part_length(), 1e-6);
    EXPECT_GT(way.part_length(), 250.0); // what the plot draws, and travel
}

// "Has gone ... of" and "Way": one number, of the program that is played.
TEST(PlotWorkspace, TheWayThatIsToldIsTheOneThatIsGone) {
    Bench bench("assets/samples/plot/hatched-sign.plt");
    const auto differ = [&] {
        const motion::Trajectory& gone = *bench.person.workshop().look().opened->motion->trajectory;
        const plot::PathLengths told = bench.made().lengths;
        return std::abs(told.cut + told.travel - gone.part_length());
    };
    EXPECT_LT(differ(), 0.1); // targets have four decimals
    bench.person.fill_in("inspector/work/origin_x_mm", "30");
    bench.settle();
    EXPECT_LT(differ(), 0.1);
}

TEST(PlotWorkspace, LinkingAndShorteningAreSeenAtOnceInLiftsAndTime) {
    Bench bench("assets/samples/plot/hatched-sign.plt");
    const plot::WorkTime before = bench.made().as_planned;
    bench.person.fill_in("inspector/travel/link_mm", "3");
    bench.settle();
    const plot::WorkTime linked = bench.made().as_planned;
    EXPECT_LT(linked.runs, before.runs);
    EXPECT_LT(linked.seconds, before.seconds);
    EXPECT_NEAR(linked.distance(), before.distance(), 1e-6); // as in the thesis
    bench.person.click("inspector/travel/order");
    bench.settle();
    EXPECT_LT(bench.made().as_planned.seconds, linked.seconds);
}

TEST(PlotWorkspace, EachAxisHasItsUnit) {
    Bench bench("assets/samples/plot/everyday.plt");
    const auto width = [&] { return extents(*bench.made().strokes)->upper.x(); };
    const auto height = [&] { return extents(*bench.made().strokes)->upper.y(); };
    const double x = width();
    const double y = height();
    bench.person.fill_in("inspector/source/unit_y_mm", "0.05");
    bench.settle();
    EXPECT_NEAR(width(), x, 1e-9);
    EXPECT_NEAR(height(), 2.0 * y, 1e-9);
}

TEST(PlotWorkspace, LevelsAreEnabledOrderedAndRepeatedByHand) {
    Bench bench("assets/samples/plot/hatched-sign.plt", {1600, 1200});
    const auto levels = bench.plot().levels();
    ASSERT_GE(levels.size(), 2U);
    bench.person.fill_in("layers/level/depth_mm", "2.5");
    bench.settle();
    EXPECT_DOUBLE_EQ(bench.made().levels.front().depth, 2.5);
    const double cut = bench.made().lengths.cut;
    bench.person.click("layers/level/enabled");
    bench.settle();
    EXPECT_FALSE(bench.made().levels.front().enabled);
    EXPECT_LT(bench.made().lengths.cut, cut);
    bench.person.click("layers/level/enabled");
    bench.settle();
    bench.person.click("layers/level/again");
    bench.settle();
    EXPECT_EQ(bench.made().levels.size(), levels.size() + 1);
    EXPECT_GT(bench.made().lengths.cut, cut);
}

TEST(PlotWorkspace, PicturesBecomeReliefsWithALivePreview) {
    Bench bench("assets/samples/pictures/snail.png");
    ASSERT_FALSE(bench.made().failure);
    EXPECT_TRUE(bench.made().picture);
    ASSERT_TRUE(bench.made().look);
    bench.person.fill_in("inspector/source/width_mm", "60");
    bench.settle();
    bench.person.fill_in("inspector/source/depth_mm", "2");
    bench.settle();
    EXPECT_NEAR(static_cast<double>(std::ranges::min(bench.made().look->z)), -2.0, 0.3);
    bench.person.click("inspector/plot_space");
    bench.settle();
    bench.person.keep("plot-relief");
    const auto gray = [&] {
        return bench.pixels_like(
            [](int r, int g, int b) { return std::abs(r - g) < 3 && std::abs(g - b) < 3 && r > 60; });
    };
    const int lit = gray();
    bench.person.click("inspector/light");
    bench.settle();
    EXPECT_GT(gray(), 2 * lit + 1000);
    bench.person.keep("plot-light");
}

TEST(PlotWorkspace, ARegionOfThePictureIsCutAloneAndInItsSize) {
    Bench bench("assets/samples/pictures/snail.png", {1600, 1200});
    bench.person.click("inspector/source/size");
    bench.person.frames();
    bench.person.fill_in("inspector/source/size/pixel_mm", "0.5");
    bench.settle();
    bench.person.fill_in("inspector/source/size/region_width_px", "40");
    bench.settle();
    bench.person.fill_in("inspector/source/size/region_height_px", "20");
    bench.settle();
    ASSERT_FALSE(bench.made().failure);
    const auto x = [](const plot::CutPoint& point) { return point.at.x(); };
    const auto y = [](const plot::CutPoint& point) { return point.at.y(); };
    EXPECT_NEAR(std::ranges::max(*bench.made().path | std::views::transform(x)), 39 * 0.5, 1e-9);
    EXPECT_NEAR(std::ranges::max(*bench.made().path | std::views::transform(y)), 19 * 0.5, 1e-9);
}

TEST(PlotWorkspace, EveryChangeIsAStepThatIsUndoneAndSaved) {
    Bench bench("assets/samples/plot/hatched-sign.plt");
    const fs::path plot = bench.plot().file();
    const double before = bench.made().as_planned.seconds;
    bench.person.fill_in("inspector/travel/link_mm", "3");
    bench.settle();
    bench.person.fill_in("layers/level/depth_mm", "2.5");
    bench.settle();
    EXPECT_EQ(bench.person.workshop().look().undo_title, "Change Depth");
    const project::PlotInput set = bench.person.project().plot;
    EXPECT_TRUE(bench.person.workshop().look().changed());
    bench.person.workshop().save(bench.folder / "sign.json");
    EXPECT_FALSE(bench.person.workshop().look().changed());

    bench.person.press_key(render::Key::z, true);
    bench.settle();
    EXPECT_DOUBLE_EQ(bench.made().levels.front().depth, 1.0);
    EXPECT_LT(bench.made().as_planned.seconds, before);
    bench.person.press_key(render::Key::z, true);
    bench.settle();
    EXPECT_DOUBLE_EQ(bench.made().as_planned.seconds, before);
    EXPECT_EQ(bench.person.workshop().look().undo_title, "Open hatched-sign.plt");
    bench.person.press_key(render::Key::z, true);
    bench.settle();
    EXPECT_TRUE(bench.plot().file().empty());

    bench.person.open(bench.folder / "sign.json");
    bench.settle();
    EXPECT_EQ(bench.person.project().plot, set);
    EXPECT_EQ(bench.plot().file(), plot);
    EXPECT_DOUBLE_EQ(bench.made().levels.front().depth, 2.5);
}

TEST(PlotWorkspace, MaterialsGiveTheirValuesAndTheirSources) {
    Bench bench("assets/samples/plot/everyday.plt");
    bench.person.click("lower/materials/material0");
    bench.settle();
    // Hardwood: 0.003 in for 1/8 inch, in proportion for 3 mm, two edges, 10,000 a minute.
    EXPECT_NEAR(bench.plot().settings().level.cutting, 24.0, 1e-9);
    EXPECT_NEAR(bench.made().levels.front().plunging, 8.0, 1e-9);
    EXPECT_NEAR(bench.plot().settings().spindle_rpm, 10'000.0, 1e-9);
}

TEST(PlotWorkspace, ToTheMachineWritesTheProgramAndReplacesNoFile) {
    Bench bench("assets/samples/plot/everyday.plt");
    std::ofstream(bench.folder / "everyday.ngc") << "mine\n";
    bench.person.click("inspector/plot_to_machine");
    bench.settle();
    EXPECT_EQ(bench.person.workshop().session().workspace, Workspace::machine);
    EXPECT_TRUE(fs::exists(bench.folder / "everyday-2.ngc"));
    EXPECT_EQ(fs::file_size(bench.folder / "everyday.ngc"), 5U);
    EXPECT_EQ(bench.person.workshop().look().opened->file.filename(), "everyday-2.ngc");
    EXPECT_TRUE(bench.person.workshop().look().opened->findings.empty());
}

TEST(PlotWorkspace, PointsArePlayedWithTheirReadOutAndStoppedAtOnce) {
    Bench bench("assets/samples/plot/everyday.plt");
    bench.person.click("lower/tabs/table");
    bench.person.frames();
    bench.person.click("lower/plot_play_table");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.plot().table().view().status.points > 3; }));
    EXPECT_TRUE(bench.person.sees("lower/read_out/X"));
    EXPECT_TRUE(bench.person.sees("lower/histogram"));
    bench.person.keep("plot-table");
    bench.person.click("emergency/machine_emergency_stop");
    ASSERT_TRUE(bench.person.live_until([&] { return !bench.plot().table().playing(); }));
    const auto stopped = bench.plot().table().view();
    EXPECT_EQ(stopped.status.state, machine::PlayState::emergency_stop);
    EXPECT_LT(stopped.status.points, stopped.total);
    EXPECT_THAT(stopped.status.sentence, HasSubstr("emergency stop"));
}

TEST(PlotWorkspace, SaysWhatIsWrongWithAFileAndKeepsWorking) {
    Bench bench("assets/samples/plot/everyday.plt");
    std::ofstream(bench.folder / "junk.png") << "this is no picture";
    bench.drop(bench.folder / "junk.png");
    ASSERT_TRUE(bench.made().failure);
    EXPECT_THAT(to_text(*bench.made().failure), HasSubstr("junk.png"));
    EXPECT_THAT(bench.person.refusal("inspector/plot_to_machine"), HasSubstr("junk.png"));
    bench.drop(bench.folder / "everyday.plt");
    EXPECT_FALSE(bench.made().failure);
}

} // namespace
} // namespace millwright::panels
