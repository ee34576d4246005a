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
constexpr std::ptrdiff_t longest_line = 79;

constexpr std::array g_codes{0,   10,  20,  30,  40,  100, 170, 180, 190, 200, 210, 280, 281,
                             300, 301, 382, 383, 384, 385, 400, 431, 490, 530, 540, 550, 560,
                             570, 580, 590, 610, 800, 900, 910, 911, 920, 921, 930, 940};
constexpr std::array m_codes{0, 1, 2, 3, 4, 5, 7, 8, 9, 30};
constexpr std::uint32_t letters = words_of("FGIJKLMNPRSTXYZ");

void check_codes(const Block& block) {
    for (std::size_t n = 0; n < g_group_count; ++n) {
        const bool given = ((block.g_groups >> n) & 1U) != 0;
        if (given && std::find(g_codes.begin(), g_codes.end(), block.g[n]) == g_codes.end()) {
            refuse(block.g_column[n], fmt::format("Grbl does not know {} (error 20)", g_name(block.g[n])));
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
            refuse(block.column_of(letter), fmt::format("Grbl does not know {} words (error 20)", letter));
        }
    }
}

void check_tool_length(const Block& block) {
    constexpr int dynamic = 431;
    const bool only_z = block.has('Z') && !block.has_any(words_of("XYABCUVW"));
    if (block.code(GGroup::tool_length) == dynamic && !only_z) {
        refuse(block.column_of(GGroup::tool_length),
               "G43.1 of Grbl needs Z and no other axis word (error 37)");
    }
}

void check_arc(const Block& block) {
    constexpr int clockwise = 20;
    constexpr int counterclockwise = 30;
    const int motion = block.code(GGroup::motion);
    if (motion != clockwise && motion != counterclockwise) {
        return;
    }
    if (!block.has_any(axis_words)) {
        refuse(block.column_of(GGroup::motion), "an arc of Grbl needs axis words (error 26)");
    }
    if (block.has('P')) {
        refuse(block.column_of('P'), "an arc of Grbl has one turn, without P (error 36)");
    }
}

void check_g10(const Block& block) {
    const double kind = block.value_or('L', 0.0);
    const bool known = (kind > 1.5 && kind < 2.5) || (kind > 19.5 && kind < 20.5);
    if (block.code(GGroup::non_modal) == 100 && !known) {
        refuse(block.column_of(GGroup::non_modal), "G10 of Grbl needs L2 or L20 (error 20)");
    }
    if (block.code(GGroup::non_modal) == 100 && block.value_or('P', 0.0) > 6.0) {
        refuse(block.column_of('P'), "Grbl has coordinate systems 1 to 6, G54 to G59 (error 29)");
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
        if (++count > longest_line) {
            refuse(column, fmt::format("a line for Grbl has at most {} characters (error 11)", longest_line));
        }
    }
}

void apply_grbl_rules(const Block& block) {
    check_codes(block);
    check_letters(block);
    check_arc(block);
    check_tool_length(block);
    check_g10(block);
}

} // namespace millwright::gcode::internal
