#include "core/gcode/reader/internal/grbl_rules.h"

#include "core/gcode/reader/internal/codes.h"
#include "core/gcode/reader/internal/cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace millwright::gcode::internal {

namespace {

/// Of Grbl's line buffer: characters without blanks and comments.
constexpr std::ptrdiff_t longest_grbl_line = 79;

constexpr std::array g_codes{0,   10,  20,  30,  40,  100, 170, 180, 190, 200, 210, 280, 281,
                             300, 301, 382, 383, 384, 385, 400, 431, 490, 530, 540, 550, 560,
                             570, 580, 590, 610, 800, 900, 910, 911, 920, 921, 930, 940};
constexpr std::array m_codes{0, 1, 2, 3, 4, 5, 7, 8, 9, 30};
constexpr int dynamic_length = 431;
constexpr std::uint32_t letters = words_of("FGIJKLMNPRSTXYZ");

/// Of a code that it does not know. One with a fraction it takes for the code before the point first.
int error_of_unknown(int code) {
    constexpr std::array checked_with_fraction{28, 30, 38, 43, 49, 61, 90, 91, 92};
    const int whole = code / 10;
    const bool known_without = std::find(g_codes.begin(), g_codes.end(), 10 * whole) != g_codes.end();
    const bool checked = std::find(checked_with_fraction.begin(), checked_with_fraction.end(), whole) !=
                         checked_with_fraction.end();
    return code % 10 != 0 && known_without && !checked ? 23 : 20;
}

void check_codes(const Block& block) {
    for (std::size_t n = 0; n < g_group_count; ++n) {
        const bool given = ((block.g_groups >> n) & 1U) != 0;
        if (given && std::find(g_codes.begin(), g_codes.end(), block.g[n]) == g_codes.end()) {
            refuse(block.g_column[n],
                   fmt::format(
                       "Grbl does not know {} (error {})", g_name(block.g[n]), error_of_unknown(block.g[n])));
        }
    }
    for (std::size_t n = 0; n < m_group_count; ++n) {
        const bool given = ((block.m_groups >> n) & 1U) != 0;
        if (given && std::find(m_codes.begin(), m_codes.end(), block.m[n]) == m_codes.end()) {
            refuse(block.m_column[n], fmt::format("Grbl does not know M{} (error 20)", block.m[n]));
        }
    }
}

void check_letters(const Block& block) {
    if (block.polar()) {
        refuse(1, "Grbl knows no polar coordinates (error 1)");
    }
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
        if (block.has(letter) && (word_bit(letter) & letters) == 0) {
            refuse(block.column_of(letter),
                   fmt::format("Grbl does not know {} words (error 20)", letter),
                   letter == 'E' ? "in a number like 1e5? Numbers have no exponent here" : "");
        }
    }
    constexpr double last_tool = 255.0;
    if (block.value_or('T', 0.0) > last_tool) {
        refuse(block.column_of('T'), "Grbl has tools up to 255 (error 38)");
    }
}

void check_tool_length(const Block& block) {
    const int code = block.code(GGroup::tool_length);
    if (code == no_code) {
        return;
    }
    constexpr int g80 = 800;
    const int column = block.column_of(GGroup::tool_length);
    const int motion = block.code(GGroup::motion);
    if (motion != no_code && motion != g80) {
        refuse(column,
               fmt::format("{} and {} both use axis words and cannot stand in one line of Grbl (error 24)",
                           g_name(code),
                           g_name(motion)));
    }
    if (code != dynamic_length && block.has_any(axis_words)) {
        refuse(column, "Grbl does nothing with axis words beside G49");
    }
    const bool only_z = block.has('Z') && !block.has_any(words_of("XYABCUVW"));
    if (code == dynamic_length && !only_z) {
        refuse(column, "G43.1 of Grbl needs Z and no other axis word (error 37)");
    }
}

/// The target counts from the offset that the same line takes away.
void check_g92(const Block& block) {
    constexpr int g92_1 = 921;
    if (block.code(GGroup::non_modal) == g92_1 && block.has_any(axis_words)) {
        refuse(block.column_of(GGroup::non_modal),
               "Grbl moves by the old G92 in a line with G92.1",
               "write it in two lines");
    }
}

/// Whether the motion of this line, its own or the one in force, is an arc.
bool makes_arc(const Block& block, const ModalState& state) {
    const int motion = block.code(GGroup::motion);
    if (motion != no_code) {
        return is_arc(motion);
    }
    const bool axes_are_taken =
        block.code(GGroup::non_modal) != no_code || block.code(GGroup::tool_length) == dynamic_length;
    return is_arc(state.motion) && block.has_any(axis_words) && !axes_are_taken;
}

struct PlaneWords {
    std::uint32_t axes, offsets;
};

PlaneWords words_of_plane(const Block& block, const ModalState& state) {
    const int chosen = block.code(GGroup::plane);
    const bool xz = chosen == no_code ? state.plane == Plane::xz : chosen == 180;
    const bool yz = chosen == no_code ? state.plane == Plane::yz : chosen == 190;
    return xz   ? PlaneWords{words_of("XZ"), words_of("IK")}
           : yz ? PlaneWords{words_of("YZ"), words_of("JK")}
                : PlaneWords{words_of("XY"), words_of("IJ")};
}

void check_arc(const Block& block, const ModalState& state) {
    if (!makes_arc(block, state)) {
        return;
    }
    const int column = block.code(GGroup::motion) == no_code ? 1 : block.column_of(GGroup::motion);
    const PlaneWords plane = words_of_plane(block, state);
    if (!block.has_any(axis_words)) {
        refuse(column, "an arc of Grbl needs axis words (error 26)");
    }
    if (!block.has_any(plane.axes)) {
        refuse(column, "an arc of Grbl needs an axis word of its plane (error 32)");
    }
    if (!block.has('R') && !block.has_any(plane.offsets)) {
        refuse(column, "an arc needs its radius, R, or its centre in the plane (error 35)");
    }
    const std::uint32_t used = block.has('R') ? 0U : plane.offsets;
    for (const char letter : {'I', 'J', 'K', 'P'}) {
        if (block.has(letter) && (word_bit(letter) & used) == 0) {
            refuse(block.column_of(letter), fmt::format("{} is not used by this arc (error 36)", letter));
        }
    }
}

void check_grbl_g10(const Block& block) {
    constexpr int set_data = 100;
    if (block.code(GGroup::non_modal) != set_data) {
        return;
    }
    const int column = block.column_of(GGroup::non_modal);
    if (!block.has_any(axis_words)) {
        refuse(column, "G10 of Grbl needs axis words (error 26)");
    }
    if (!block.has('L') && !block.has('P')) {
        refuse(column, "G10 of Grbl needs L and P (error 28)");
    }
    if (block.value_or('P', 0.0) < 0.0) {
        refuse(block.column_of('P'), "P of Grbl is not negative (error 4)");
    }
    if (block.value_or('P', 0.0) >= 7.0) {
        refuse(block.column_of('P'), "Grbl has coordinate systems 1 to 6, G54 to G59 (error 29)");
    }
    const int kind = static_cast<int>(block.value_or('L', 0.0));
    if (kind != 2 && kind != 20) {
        refuse(column, "G10 of Grbl needs L2 or L20 (error 20)");
    }
    if (block.has('R')) {
        refuse(block.column_of('R'),
               kind == 2 ? "G10 L2 of Grbl has no rotation (error 20)"
                         : "R is not used by G10 L20 (error 36)");
    }
}

} // namespace

void check_grbl_text(std::string_view line) {
    bool comment = false;
    std::ptrdiff_t count = 0;
    for (std::size_t n = 0; n < line.size() && line[n] != ';'; ++n) {
        const char c = line[n];
        comment = c == '(' || (comment && c != ')');
        if (comment || c == ')' || is_blank(c)) {
            continue;
        }
        const int column = static_cast<int>(n) + 1;
        if (c == '[' || c == '#' || c == '<' || c == 'O' || c == 'o' || c == '$' || c == '%') {
            refuse(column, fmt::format("Grbl does not know '{}' in a program (error 1)", c));
        }
        if (++count > longest_grbl_line) {
            refuse(column,
                   fmt::format("a line for Grbl has at most {} characters (error 11)", longest_grbl_line));
        }
    }
}

void apply_grbl_rules(const Block& block, const ModalState& state) {
    check_codes(block);
    check_letters(block);
    check_arc(block, state);
    check_tool_length(block);
    check_g92(block);
    check_grbl_g10(block);
}

} // namespace millwright::gcode::internal
