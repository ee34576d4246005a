#include "core/gcode/internal/codes.h"

#include <fmt/format.h>

#include <initializer_list>

namespace millwright::gcode::internal {

namespace {

constexpr int last_g = 999;
constexpr int last_m = 999;

using GTable = std::array<signed char, last_g + 1>;
using MTable = std::array<signed char, last_m + 1>;

template <class Table, class Group>
constexpr void enter(Table& table, Group group, std::initializer_list<int> codes) {
    for (const int code : codes) {
        table[static_cast<std::size_t>(code)] = static_cast<signed char>(group);
    }
}

constexpr GTable g_table() {
    GTable table{};
    table.fill(-1);
    enter(table, GGroup::non_modal, {40, 53, 100, 280, 281, 300, 301, 520, 530, 920, 921, 922, 923});
    enter(table, GGroup::motion, {0, 10, 20, 30, 50, 51, 52, 330, 331, 382, 383, 384, 385, 730, 740, 760});
    enter(table, GGroup::motion, {800, 810, 820, 830, 840, 850, 860, 870, 880, 890});
    enter(table, GGroup::plane, {170, 171, 180, 181, 190, 191});
    enter(table, GGroup::distance, {900, 910});
    enter(table, GGroup::arc_distance, {901, 911});
    enter(table, GGroup::feed_mode, {930, 940, 950});
    enter(table, GGroup::units, {200, 210});
    enter(table, GGroup::cutter_compensation, {400, 410, 411, 420, 421});
    enter(table, GGroup::tool_length, {430, 431, 432, 434, 490});
    enter(table, GGroup::retract, {980, 990});
    enter(table, GGroup::coordinate_system, {540, 550, 560, 570, 580, 590, 591, 592, 593});
    enter(table, GGroup::path_control, {610, 611, 640});
    enter(table, GGroup::spindle_mode, {960, 970});
    enter(table, GGroup::lathe_diameter, {70, 80});
    return table;
}

constexpr MTable m_table() {
    MTable table{};
    table.fill(-1);
    enter(table, MGroup::stopping, {0, 1, 2, 30, 60, 99});
    enter(table, MGroup::input_output, {62, 63, 64, 65, 66, 67, 68});
    enter(table, MGroup::tool_change, {6, 61});
    enter(table, MGroup::spindle, {3, 4, 5, 19, 70, 71, 72, 73});
    enter(table, MGroup::coolant, {7, 8, 9});
    enter(table, MGroup::overrides, {48, 49, 50, 51, 52, 53});
    for (int code = 100; code <= last_m; ++code) {
        enter(table, MGroup::user, {code});
    }
    return table;
}

} // namespace

int group_of_g(int code) {
    static constexpr GTable table = g_table();
    return code >= 0 && code <= last_g ? table[static_cast<std::size_t>(code)] : -1;
}

int group_of_m(int code) {
    static constexpr MTable table = m_table();
    return code >= 0 && code <= last_m ? table[static_cast<std::size_t>(code)] : -1;
}

std::string g_name(int code) {
    return code % 10 == 0 ? fmt::format("G{}", code / 10) : fmt::format("G{}.{}", code / 10, code % 10);
}

} // namespace millwright::gcode::internal
