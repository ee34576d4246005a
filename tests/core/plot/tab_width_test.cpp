#include "core/plot/cut_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::plot {
namespace {

// What the tool takes away below the top of the tabs is a slot of its own width around its way: of a tab that
// is 6 mm wide 6 mm stay, whatever the tool. Measured on the cut itself: how far the ends of the deep way are
// apart.
TEST(StandingTabs, AreAsWideAsAskedForBesideTheTool) {
    const Strokes square = {
        {.pen = 1, .points = {{0.0, 0.0}, {100.0, 0.0}, {100.0, 100.0}, {0.0, 100.0}, {0.0, 0.0}}}};
    constexpr double diameter = 6.0;
    const Level level = {.pen = 1, .depth = 3.0, .tabs = {.count = 4, .width = 6.0, .height = 1.0}};
    const CutPath path = cut_path(square, {.levels = with_tab_widths({level}, diameter)});
    int tabs = 0;
    for (std::size_t n = 1; n < path.size(); ++n) {
        const bool on_tab =
            std::abs(path[n].at.z() + 2.0) < 1e-12 && std::abs(path[n - 1].at.z() + 2.0) < 1e-12;
        if (on_tab) {
            ++tabs;
            EXPECT_NEAR((path[n].at - path[n - 1].at).norm() - diameter, 6.0, 1e-9);
        }
    }
    EXPECT_EQ(tabs, 4);
}

TEST(StandingTabs, LevelsWithoutTabsStayAsTheyAre) {
    const std::vector<Level> levels{{.pen = 1, .depth = 2.0}};
    EXPECT_EQ(with_tab_widths(levels, 6.0), levels);
}

} // namespace
} // namespace millwright::plot
