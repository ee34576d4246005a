#include "core/plot/cut_path.h"

#include "core/base/error.h"
#include "core/hpgl/reader.h"
#include "tests/core/hpgl/thesis_drawings.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::plot {
namespace {

Strokes six_colours() {
    Strokes strokes;
    for (int pen = 0; pen < 6; ++pen) {
        strokes.push_back({.pen = pen, .points = {{10.0 * pen, 0.0}, {10.0 * pen, 5.0}}});
    }
    return strokes;
}

std::vector<int> pens_in_order(const CutPath& path) {
    std::vector<int> pens;
    for (const CutPoint& point : path) {
        if (point.move == CutMove::cut) {
            pens.push_back(static_cast<int>(std::lround(point.at.x() / 10.0)));
        }
    }
    return pens;
}

TEST(Levels, AreCutInTheOrderOfTheUser) {
    CutSettings settings;
    settings.levels = levels_for(six_colours());
    const int order[] = {4, 2, 0, 5, 1, 3};
    for (std::size_t n = 0; n < 6; ++n) {
        settings.levels[n].order = order[n];
    }
    EXPECT_EQ(pens_in_order(cut_path(six_colours(), settings)), (std::vector<int>{2, 4, 1, 5, 0, 3}));
}

// A drawing of two colours whose strokes alternate, read from its file: each pen is cut whole, in either
// order.
TEST(Levels, OfADrawingOfTwoColoursAreCutWholeInTheirOrder) {
    std::string hpgl;
    for (int n = 0; n < 6; ++n) {
        hpgl += "SP" + std::to_string(1 + n % 2) + ";" + test::run({{400 * (1 + n % 2), 40 * n}, {400, 400}});
    }
    const Strokes strokes = hpgl::read_hpgl(hpgl, "two.plt").strokes;
    ASSERT_EQ(strokes.size(), 6U);
    for (const int first : {1, 2}) {
        CutSettings settings;
        settings.levels = levels_for(strokes);
        ASSERT_EQ(settings.levels.size(), 2U);
        settings.levels[0].order = first == 1 ? 0 : 1;
        settings.levels[1].order = first == 1 ? 1 : 0;
        std::vector<double> begins; // x of where the tool goes down: 10 mm of pen 1, 20 mm of pen 2
        for (const CutPoint& point : cut_path(strokes, settings)) {
            if (point.move == CutMove::plunge) {
                begins.push_back(point.at.x());
            }
        }
        const double other = 30.0 - 10.0 * first;
        EXPECT_EQ(begins,
                  (std::vector<double>{10.0 * first, 10.0 * first, 10.0 * first, other, other, other}));
    }
}

TEST(Levels, CanBeLeftOutAndRepeated) {
    CutSettings settings;
    settings.levels = {{.pen = 1, .order = 0, .depth = 1.0},
                       {.pen = 2, .enabled = false, .order = 1},
                       {.pen = 1, .order = 2, .depth = 3.0, .passes = 2}};
    const CutPath path = cut_path(six_colours(), settings);
    EXPECT_EQ(pens_in_order(path), (std::vector<int>{1, 1, 1}));
    std::vector<double> depths;
    for (const CutPoint& point : path) {
        if (point.move == CutMove::cut) {
            depths.push_back(point.at.z());
        }
    }
    EXPECT_EQ(depths, (std::vector<double>{-1.0, -1.5, -3.0}));
}

TEST(Levels, TravelIsNeverBelowTheSafeHeightAndCutsAreAtTheirSpeed) {
    CutSettings settings;
    settings.levels = levels_for(six_colours(), {.depth = 2.0, .passes = 3, .cutting = 7.0, .plunging = 1.5});
    settings.levels[2].tool = 2;
    settings.levels[3].tool = 2;
    const CutPath path = cut_path(six_colours(), settings);
    int changes = 0;
    for (std::size_t n = 1; n < path.size(); ++n) {
        const CutPoint& from = path[n - 1];
        const CutPoint& to = path[n];
        const bool across = (to.at - from.at).head<2>().norm() > 0.0;
        if (across && to.move != CutMove::cut) {
            EXPECT_GE(std::min(from.at.z(), to.at.z()), settings.safe_height);
        }
        EXPECT_EQ(to.speed > 0.0, to.move == CutMove::cut || to.move == CutMove::plunge);
        if (to.move == CutMove::cut) {
            EXPECT_DOUBLE_EQ(to.speed, 7.0);
            EXPECT_LT(to.at.z(), 0.0);
        }
        changes += to.move == CutMove::tool_change ? 1 : 0;
    }
    EXPECT_EQ(changes, 2); // to tool 2 and back
    EXPECT_DOUBLE_EQ(path.back().at.z(), settings.safe_height);
}

TEST(Levels, ADotIsAHole) {
    const CutPath path =
        cut_path({{.pen = 1, .points = {{3.0, 4.0}}}}, {.levels = {{.pen = 1, .depth = 2.0}}});
    ASSERT_EQ(path.size(), 3U);
    EXPECT_EQ(path[1].at, Vec3(3.0, 4.0, -2.0));
    EXPECT_EQ(path[2].at, Vec3(3.0, 4.0, 5.0));
}

// Four tabs of 6 mm on a square of 100 mm: 24 mm of the way around are cut at the tabs' height in the last
// pass, and nothing of it in the pass above.
TEST(Tabs, StandOnTheWayAround) {
    const Strokes square = {
        {.pen = 1, .points = {{0.0, 0.0}, {25.0, 0.0}, {25.0, 25.0}, {0.0, 25.0}, {0.0, 0.0}}}};
    const Level level = {
        .pen = 1, .depth = 3.0, .passes = 2, .tabs = {.count = 4, .width = 6.0, .height = 1.0}};
    const CutPath path = cut_path(square, {.levels = {level}});
    double at_tabs = 0.0;
    double at_depth = 0.0;
    double at_first_pass = 0.0;
    for (std::size_t n = 1; n < path.size(); ++n) {
        const Vec3 step = path[n].at - path[n - 1].at;
        const double across = step.head<2>().norm();
        EXPECT_TRUE(std::abs(step.z()) < 1e-12 || across < 1e-12); // never aslant
        const double z = path[n].at.z();
        at_tabs += std::abs(z + 2.0) < 1e-12 ? across : 0.0;
        at_depth += std::abs(z + 3.0) < 1e-12 ? across : 0.0;
        at_first_pass += std::abs(z + 1.5) < 1e-12 ? across : 0.0;
    }
    EXPECT_NEAR(at_tabs, 24.0, 1e-9);
    EXPECT_NEAR(at_depth, 76.0, 1e-9);
    EXPECT_NEAR(at_first_pass, 100.0, 1e-9);
}

TEST(Tabs, AreRefusedWhereTheyDoNotFit) {
    const Strokes small = {{.pen = 1, .points = {{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}, {0.0, 0.0}}}};
    EXPECT_THROW(static_cast<void>(cut_path(small, {.levels = {{.pen = 1, .tabs = {.count = 3}}}})), Error);
    const Strokes open = {{.pen = 1, .points = {{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}}}};
    EXPECT_EQ(cut_path(open, {.levels = {{.pen = 1, .tabs = {.count = 3}}}}),
              cut_path(open, {.levels = {{.pen = 1}}}));
}

TEST(Levels, PensOfTheThesisAreTakenAsTheyAreNumbered) {
    const hpgl::Plot plot = hpgl::read_hpgl(test::second_example(), "thesis.plt");
    const std::vector<Level> levels = levels_for(plot.strokes);
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_EQ(levels[0].pen, 0);
    EXPECT_EQ(levels[1].pen, 1);
}

TEST(Levels, GoNoDeeperThanThePlate) {
    const CutPath path{{.at = {0.0, 0.0, 5.0}},
                       {.at = {0.0, 0.0, -3.0}, .speed = 1.0, .move = CutMove::plunge}};
    EXPECT_DOUBLE_EQ(deepest(path), 3.0);
    EXPECT_DOUBLE_EQ(deepest({}), 0.0);
    EXPECT_NO_THROW(expect_within_plate(path, 3.0));
    EXPECT_THROW(expect_within_plate(path, 2.99), Error);
}

TEST(Levels, RefuseWhatCannotBeCut) {
    const millwright::test::WithoutTraps no_traps;
    const Strokes strokes = six_colours();
    const auto cut = [&](const Level& level) { static_cast<void>(cut_path(strokes, {.levels = {level}})); };
    EXPECT_THROW(cut({.depth = -1.0}), Error);
    EXPECT_THROW(cut({.passes = 0}), Error);
    EXPECT_THROW(cut({.cutting = 0.0}), Error);
    EXPECT_THROW(cut({.plunging = std::nan("")}), Error);
    EXPECT_THROW(static_cast<void>(cut_path(strokes, {.safe_height = 0.0})), Error);
    EXPECT_THROW(static_cast<void>(cut_path(strokes, {.safe_height = 50.0})), Error);
}

TEST(Levels, OfMorePointsThanMemoryIsKeptForAreRefusedBeforeTheyAreMade) {
    const Strokes stroke{{.pen = 1, .points = std::vector<Vec2>(most_path_points / 1000)}};
    EXPECT_NO_THROW(expect_not_too_long(most_path_points));
    EXPECT_THROW(expect_not_too_long(most_path_points + 1), Error);
    EXPECT_NO_THROW(static_cast<void>(cut_path(stroke, {.levels = {{.pen = 1, .passes = 2}}})));
    try {
        static_cast<void>(cut_path(stroke, {.levels = {{.pen = 1, .passes = 1000}}}));
        FAIL() << "nothing was refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().message, "the path has more than 20 million points");
        EXPECT_NE(error.diagnostic().hint, "");
    }
}

} // namespace
} // namespace millwright::plot
