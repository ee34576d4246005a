#include "core/project/level_settings.h"

#include "core/project/internal/people_number.h"

#include <array>

namespace millwright::project {

namespace {

using internal::As;
using internal::count;
using internal::maybe;
using internal::number;
using plot::Level;
using plot::Tabs;

constexpr std::array<NumberSetting<Level>, 10> of_level{{
    {"order",
     "Order",
     "",
     "Levels with lower numbers are cut first",
     -1'000'000,
     1'000'000,
     0,
     count<&Level::order>},
    {"depth_mm", "Depth", "mm", "Below the top surface", 0.0, 150.0, 3, number<As::it_is, &Level::depth>},
    {"passes", "Passes", "", "Number of passes of equal depth", 1, 1000, 0, count<&Level::passes>},
    {"feed_mm_per_min",
     "Feed rate",
     "mm/min",
     "Feed rate along the strokes",
     1.0,
     1e5,
     1,
     number<As::mm_per_min, &Level::cutting>},
    {"plunge_mm_per_min",
     "Plunge feed",
     "mm/min",
     "Feed rate into the material",
     1.0,
     1e5,
     1,
     number<As::mm_per_min, &Level::plunging>},
    {"tool",
     "Tool",
     "",
     "Tool number; where it changes, the tool is changed by hand",
     0,
     1000,
     0,
     count<&Level::tool>},
    {"cutter_mm",
     "Cutter diameter",
     "mm",
     "Diameter of the level's tool; 0 = as set under Cutter",
     0.0,
     50.0,
     2,
     maybe<&Level::tool_diameter>},
    {"tabs",
     "Tabs",
     "",
     "Number of bridges on each closed stroke",
     0,
     1000,
     0,
     count<&Level::tabs, &Tabs::count>},
    {"tab_width_mm",
     "Tab width",
     "mm",
     "Width of the material left standing, excluding the tool diameter",
     0.1,
     100.0,
     1,
     number<As::it_is, &Level::tabs, &Tabs::width>},
    {"tab_height_mm",
     "Tab height",
     "mm",
     "Above the bottom of the level's cut",
     0.01,
     100.0,
     2,
     number<As::it_is, &Level::tabs, &Tabs::height>},
}};

} // namespace

std::span<const NumberSetting<Level>> level_numbers() {
    return of_level;
}

const NumberSetting<Level>& level_number(std::string_view id) {
    return internal::number_row(level_numbers(), id);
}

} // namespace millwright::project
