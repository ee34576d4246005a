// V-carving in the window, with real mouse and keys.
#include "tests/ui/person/plot_person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace millwright::panels {
namespace {

using test::PlotPerson;

/// A ring of 40 mm with a hole of 20 mm, and a letter L of 30 mm.
std::filesystem::path drawing_in(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "logo.plt";
    std::ofstream(file) << "IN;SP1;PU1000,1000;CI800;CI400;PU2200,200;PD3400,200,3400,600,2600,600,2600,1800,"
                           "2200,1800,2200,200;PU;";
    return file;
}

TEST(PlotCarving, ADrawingIsCarvedAndColouredByItsDepth) {
    const test::ScratchFolder source;
    PlotPerson bench(drawing_in(source.path()), {1600, 1400});
    ASSERT_FALSE(bench.made().failure);
    EXPECT_FALSE(bench.made().carved);
    EXPECT_FALSE(bench.person.sees("inspector/source/largest_depth_mm"));
    bench.person.choose("inspector/source/use", "carving");
    bench.settle();
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    ASSERT_TRUE(bench.made().carved);
    EXPECT_EQ(bench.plot().settings().tip.kind, plot::TipKind::v);
    EXPECT_EQ(bench.made().carved->parts, 2);
    EXPECT_LT(bench.made().carved->deviation, 0.01);
    for (const char* path : {"inspector/source/tip_angle_deg",
                             "inspector/source/tip_end_mm",
                             "inspector/source/deepest",
                             "inspector/source/deviation"}) {
        EXPECT_TRUE(bench.person.sees(path)) << path;
    }
    EXPECT_FALSE(bench.person.sees("inspector/cutter/tool_mm")); // of the end mill
    EXPECT_TRUE(bench.person.app().look().in_file());            // its program can be played
    bench.person.click("inspector/plot_space");
    bench.settle();
    bench.person.keep("plot-carving");
    const double deepest = bench.made().carved->deepest;
    bench.person.fill_in("inspector/source/largest_depth_mm", "2");
    bench.settle();
    ASSERT_TRUE(bench.made().carved);
    EXPECT_LT(bench.made().carved->deepest, deepest);
    EXPECT_GT(bench.made().carved->floor_area, 10.0);
    EXPECT_TRUE(bench.person.sees("inspector/source/floor"));
    EXPECT_DOUBLE_EQ(bench.made().carved->floor_left, 0.0);
    bench.person.keep("plot-carving-floor");
    bench.person.click("inspector/source/clear_floor");
    bench.settle();
    EXPECT_GT(bench.made().carved->floor_left, 10.0);
    bench.person.choose("inspector/source/use", "strokes");
    bench.settle();
    EXPECT_FALSE(bench.made().carved);
    EXPECT_FALSE(bench.made().levels.empty());
}

TEST(PlotCarving, OfAPictureIsOneOfItsUses) {
    PlotPerson bench("assets/samples/pictures/boat.png", {1600, 1400});
    bench.person.choose("inspector/source/use", "carving");
    bench.settle();
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    ASSERT_TRUE(bench.made().carved);
    bench.person.fill_in("inspector/source/tip_angle_deg", "90");
    bench.settle();
    bench.person.fill_in("inspector/source/depth_per_pass_mm", "0.5");
    bench.settle();
    ASSERT_TRUE(bench.made().carved);
    EXPECT_LT(bench.made().carved->deviation, 0.01);
    bench.person.keep("plot-carving-picture");
}

} // namespace
} // namespace millwright::panels
