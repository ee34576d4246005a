// One line of G-code as an emulated Grbl reads it: which commands it holds, and the values of its words.
#pragma once

#include "core/emulators/grbl/internal/eeprom.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <optional>
#include <string_view>

namespace millwright::emulators::internal {

/// What the axis words of a line belong to.
enum class AxisUse { none, motion, non_modal, tool_length };

/// Commands as ten times their number: G38.2 is 382. Of each modal group at most one; -1: not in the line.
struct Words {
    int motion = -1, plane = -1, distance = -1, feed_mode = -1, units = -1, tool_length = -1,
        coordinates = -1;
    int non_modal = -1, flow = -1, spindle = -1, coolant = -1;
    bool changes_tool = false;                                         ///< M6
    bool arc_distance = false, cutter_off = false, exact_path = false; ///< G91.1, G40, G61
    AxisUse axis_use = AxisUse::none;
    std::array<std::optional<double>, 26> values; ///< by letter

    [[nodiscard]] const std::optional<double>& value(char letter) const {
        return values[static_cast<std::size_t>(letter - 'A')];
    }
    [[nodiscard]] bool has(char letter) const { return value(letter).has_value(); }
    [[nodiscard]] bool has_axes(std::string_view axes) const {
        return std::ranges::any_of(axes, [this](char letter) { return has(letter); });
    }
};

struct ReadWords {
    int error = 0; ///< of Grbl; 0: none
    Words words;
};

/// `line` without blanks and comments, in capitals.
[[nodiscard]] ReadWords read_words(std::string_view line, const Build& build);

} // namespace millwright::emulators::internal
