// What a setting says about itself; tables of these feed fields, tips and the reset button.
// Bare numbers are in the unit that people see (`unit`), not in the unit of the core.
#pragma once

#include <limits>
#include <string_view>

namespace millwright::widgets {

struct FieldInfo {
    std::string_view id = {};    ///< last part of the widget's path, never shown
    std::string_view label = {}; ///< for people, at the left of the row
    std::string_view unit = {};  ///< shown inside the box; empty for a bare number
    std::string_view tip = {};   ///< what it is, its range, which formula
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    double default_value = std::numeric_limits<double>::quiet_NaN(); ///< NaN: none, so no reset button
    int decimals = 3;
    double step = 0.0; ///< of the arrow keys; 0 means one unit of the first decimal shown
};

} // namespace millwright::widgets
