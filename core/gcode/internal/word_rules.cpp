#include "core/gcode/internal/word_rules.h"

#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/refusal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

namespace millwright::gcode::internal {

namespace {

bool one_of(int code, std::initializer_list<int> codes) {
    return std::find(codes.begin(), codes.end(), code) != codes.end();
}

// ---- which motion

/// Codes of group 0 that take the axis words for themselves: G10, G28, G30, G52, G92.
bool takes_axes(int non_modal) {
    return one_of(non_modal, {100, 280, 300, 520, 920});
}

void expect_offset_axes(const Block& block, int non_modal) {
    if (!one_of(non_modal, {520, 920})) {
        return;
    }
    if (block.polar()) {
        refuse(1, "polar coordinates can only be used for motion");
    }
    if (!block.has_any(axis_words)) {
        refuse(block.column_of(GGroup::non_modal), fmt::format("{} needs axis words", g_name(non_modal)));
    }
}

void check_given_motion(const Block& block, int motion, int non_modal) {
    const int column = block.column_of(GGroup::motion);
    constexpr int g80 = 800;
    if (motion == g80) {
        if (block.moves_axes() && !takes_axes(non_modal)) {
            refuse(column, "G80 must not have axis words");
        }
        expect_offset_axes(block, non_modal);
        return;
    }
    if (takes_axes(non_modal)) {
        refuse(column,
               fmt::format("{} and {} both use axis words and cannot be in the same line",
                           g_name(non_modal),
                           g_name(motion)));
    }
    if (!block.moves_axes() && !one_of(motion, {0, 10, 20, 30, 52})) {
        refuse(column, fmt::format("{} needs axis words", g_name(motion)));
    }
}

int modal_motion(const Block& block, const ModalState& state) {
    constexpr int g80 = 800;
    constexpr int g43_1 = 431;
    constexpr int g43_2 = 432;
    const int length = block.code(GGroup::tool_length);
    if (block.moves_axes()) {
        if (length == g43_1 || length == g43_2) {
            return no_code;
        }
        if (state.motion == g80) {
            refuse(1, "axis words without a G-code that uses them");
        }
        return state.motion;
    }
    const bool centre_only = block.has_any(words_of("IJK")) && is_arc(state.motion);
    return centre_only ? state.motion : no_code;
}

void find_motion(Block& block, const ModalState& state) {
    const int given = block.code(GGroup::motion);
    const int non_modal = block.code(GGroup::non_modal);
    if (given != no_code) {
        check_given_motion(block, given, non_modal);
        block.motion = given;
    } else if (takes_axes(non_modal)) {
        expect_offset_axes(block, non_modal);
    } else {
        block.motion = modal_motion(block, state);
    }
    if (block.polar() && block.motion == no_code) {
        refuse(1, "polar coordinates can only be used for motion");
    }
}

void check_polar(const Block& block, const ModalState& state) {
    if (state.plane != Plane::xy) {
        refuse(1, "polar coordinates @ and ^ can only be used in the XY plane (G17)");
    }
    if (block.has_any(words_of("XY"))) {
        refuse(block.column_of(block.has('X') ? 'X' : 'Y'),
               "X and Y cannot be combined with polar coordinates");
    }
}

// ---- codes of group 0

void check_g10(const Block& block) {
    const int column = block.column_of(GGroup::non_modal);
    const int kind = static_cast<int>(block.value_or('L', -1.0));
    if (!one_of(kind, {1, 2, 10, 11, 20})) {
        refuse(column, "G10 needs L1, L2, L10, L11 or L20");
    }
    const double p = block.value_or('P', -1.0);
    if (std::abs(p - std::round(p)) > 1e-4) {
        refuse(block.column_of('P'), "P of G10 must be an integer");
    }
    const bool of_system = kind == 2 || kind == 20;
    if (of_system && !(p > -0.5 && p < 9.5)) {
        refuse(block.column_of('P'), fmt::format("P of G10 L{} must be a coordinate system, 0 to 9", kind));
    }
    if (!of_system && !(p > 0.5)) {
        refuse(block.column_of('P'), fmt::format("P of G10 L{} must be a tool number, 1 or more", kind));
    }
}

void check_g53(const Block& block, const ModalState& state, Dialect dialect) {
    const int column = block.column_of(GGroup::non_modal);
    if (dialect == Dialect::grbl) {
        const int given =
            block.code(GGroup::motion); // G53 may stand alone there, and is absolute under G91 too
        if (!one_of(given == no_code ? state.motion : given, {0, 10})) {
            refuse(column, "G53 can only be used with G0 or G1 (error 30)");
        }
        return;
    }
    if (block.motion != 0 && block.motion != 10) {
        refuse(column, "G53 can only be used with G0 or G1");
    }
    const int distance = block.code(GGroup::distance);
    constexpr int g90 = 900;
    if (distance == no_code ? state.distance == DistanceMode::incremental : distance != g90) {
        refuse(column, "G53 cannot be used in incremental mode, G91");
    }
}

void check_non_modal(const Block& block, const ModalState& state, Dialect dialect) {
    const int column = block.column_of(GGroup::non_modal);
    switch (block.code(GGroup::non_modal)) {
    case 40:
        if (!block.has('P') || block['P'] < 0.0) {
            refuse(block.column_of('P'), "G4 needs a time P of 0 or more");
        }
        if (is_arc(block.code(GGroup::motion))) {
            refuse(column, "G4 and an arc both use P and cannot be in the same line");
        }
        break;
    case 100:
        check_g10(block);
        break;
    case 53:
        if (block.code(GGroup::motion) != no_code && block.code(GGroup::motion) != 52) {
            refuse(column, "between G5.2 and G5.3 only G5.2 is allowed");
        }
        break;
    case 530:
        check_g53(block, state, dialect);
        break;
    default:
        break;
    }
}

// ---- words that nothing in the line uses

struct WordUse {
    char letter;
    bool (*used)(const Block& block);
    std::string_view users;
};

int compensation(const Block& b) {
    return b.code(GGroup::cutter_compensation);
}
int io(const Block& b) {
    return b.code(MGroup::input_output);
}
bool is_g10(const Block& b) {
    return b.code(GGroup::non_modal) == 100;
}
bool has_user_m(const Block& b) {
    return b.code(MGroup::user) != no_code;
}
bool is_g64(const Block& b) {
    return b.code(GGroup::path_control) == 640;
}
bool is_m19(const Block& b) {
    return b.code(MGroup::spindle) == 19;
}
bool is_g81_to_89(const Block& b) {
    return b.motion >= 810 && b.motion <= 890;
}
bool compensates(const Block& b) {
    return one_of(compensation(b), {410, 411, 420, 421});
}

bool uses_p(const Block& b) {
    return is_g10(b) || b.code(GGroup::non_modal) == 40 || is_g64(b) || is_m19(b) || has_user_m(b) ||
           one_of(b.motion, {20, 30, 50, 52, 740, 760, 820, 840, 860, 880, 890}) ||
           one_of(b.code(MGroup::overrides), {50, 51, 52, 53}) || one_of(io(b), {62, 63, 64, 65, 66});
}

bool uses_q(const Block& b) {
    return is_g10(b) || is_g64(b) || is_m19(b) || has_user_m(b) || b.code(MGroup::tool_change) == 61 ||
           one_of(b.motion, {50, 730, 760, 830}) || one_of(io(b), {66, 67, 68});
}

constexpr std::array<WordUse, 10> word_uses{{
    {'D',
     [](const Block& b) { return compensates(b) || b.code(GGroup::spindle_mode) == 960; },
     "G41, G41.1, G42, G42.1 or G96"},
    {'E',
     [](const Block& b) {
         return b.motion == 760 || one_of(io(b), {66, 67, 68});
     },
     "G76, M66, M67 or M68"},
    {'H',
     [](const Block& b) {
         return b.motion == 760 || one_of(b.code(GGroup::tool_length), {430, 432, 434});
     },
     "G43, G43.2 or G76"},
    {'I',
     [](const Block& b) {
         return is_g10(b) || one_of(b.motion, {20, 30, 50, 51, 760, 870});
     },
     "G2, G3, G5, G5.1, G10, G76 or G87"},
    {'J',
     [](const Block& b) {
         return is_g10(b) || one_of(b.motion, {20, 30, 50, 51, 760, 870});
     },
     "G2, G3, G5, G5.1, G10, G76 or G87"},
    {'K',
     [](const Block& b) {
         return one_of(b.motion, {20, 30, 330, 331, 760, 870});
     },
     "G2, G3, G33, G33.1, G76 or G87"},
    {'L',
     [](const Block& b) {
         return is_g10(b) || is_g81_to_89(b) || compensates(b) || io(b) == 66 ||
                one_of(b.motion, {52, 730, 740, 760});
     },
     "G10, cutter compensation, a canned cycle, G5.2 or M66"},
    {'P',
     uses_p,
     "G2, G3, G4, G5, G5.2, G10, G64, G74, G76, G82, G84, G86, G88, G89, M19, M50 to M53, M62 to M66 or a "
     "user M-code"},
    {'Q', uses_q, "G5, G10, G64, G73, G76, G83, M19, M61, M66, M67, M68 or a user M-code"},
    {'R',
     [](const Block& b) {
         return is_g10(b) || is_m19(b) || is_g81_to_89(b) || one_of(b.motion, {20, 30, 730, 740, 760}) ||
                one_of(compensation(b), {411, 421});
     },
     "G2, G3, G10, G41.1, G42.1, a canned cycle, G76 or M19"},
}};

/// Of the users some are for one spindle only.
void check_spindle(const Block& block) {
    if (block.spindle_column == 0) {
        return;
    }
    constexpr int g95 = 950;
    const bool for_one = is_m19(block) || block.code(MGroup::overrides) == 51 ||
                         one_of(block.motion, {330, 331, 760}) || block.code(GGroup::feed_mode) == g95 ||
                         block.code(GGroup::spindle_mode) != no_code;
    const bool for_all = one_of(block.code(MGroup::spindle), {3, 4, 5}) || block.has('S');
    if (block.all_spindles && (for_one || !for_all)) {
        refuse(block.spindle_column, "$-1 can only be used with M3, M4, M5 and S");
    }
    if (!for_one && !for_all) {
        refuse(block.spindle_column,
               "$ word without anything that uses it (M3, M4, M5, M19, M51, S, G33, G33.1, G76, G95, G96 or "
               "G97)");
    }
}

constexpr std::uint32_t optional_words = words_of("DEHIJKLPQR");

void check_uses(const Block& block) {
    for (const WordUse& use : word_uses) {
        if (block.has(use.letter) && !use.used(block)) {
            refuse(block.column_of(use.letter),
                   fmt::format("{} word without anything that uses it ({})", use.letter, use.users),
                   use.letter == 'E' ? "write numbers without an exponent (not 1e5)" : "");
        }
    }
}

// ---- ranges

void check_turns(const Block& block) {
    const double p = block['P'];
    constexpr double p_whole_within = 0.001;
    if (std::abs(p - std::round(p)) > p_whole_within) {
        refuse(block.column_of('P'), "P of an arc must be an integer number of turns");
    }
    if (std::round(p) < 1.0) {
        refuse(block.column_of('P'), "P of an arc must be 1 or more");
    }
}

void check_orientation(const Block& block) {
    if (block.has('R') && !(block['R'] >= 0.0 && block['R'] <= 360.0)) {
        refuse(block.column_of('R'), "R of M19 must be an angle from 0 to 360");
    }
    const double p = block.value_or('P', 0.0);
    if (!(p >= 0.0 && p <= 2.0) || std::abs(p - std::round(p)) > 0.001) {
        refuse(block.column_of('P'), "P of M19 must be 0, 1 or 2");
    }
}

void check_motion_words(const Block& block) {
    const int column = block.column_of(GGroup::motion);
    if (is_arc(block.motion) && block.has('P')) {
        check_turns(block);
    }
    if (block.motion == 330 || block.motion == 331) {
        if (!block.has('K')) {
            refuse(column, fmt::format("{} needs a pitch, K", g_name(block.motion)));
        }
        if (block.has('F')) {
            refuse(block.column_of('F'), fmt::format("{} must not have F", g_name(block.motion)));
        }
    }
    if (block.motion == 760) {
        if (!block.has('P')) {
            refuse(column, "G76 needs a pitch, P");
        }
        if (!block.has('I') || !block.has('J') || !block.has('K')) {
            refuse(column, "G76 needs I, J and K");
        }
    }
    if (is_drilling_cycle(block.motion) && block.has_any(words_of("ABC"))) {
        refuse(column, "A, B and C cannot move in a canned cycle");
    }
}

} // namespace

void apply_word_rules(Block& block, const ModalState& state, Dialect dialect) {
    if (block.polar()) {
        check_polar(block, state);
    }
    find_motion(block, state);
    if (block.code(GGroup::non_modal) != no_code) {
        check_non_modal(block, state, dialect);
    }
    if (block.has_any(optional_words)) {
        check_uses(block);
    }
    check_spindle(block);
    if (block.code(GGroup::spindle_mode) == 960 && !block.has('S')) {
        refuse(block.column_of(GGroup::spindle_mode), "G96 needs a surface speed, S");
    }
    if (is_m19(block)) {
        check_orientation(block);
    }
    if (block.motion > 10) {
        check_motion_words(block);
    }
}

} // namespace millwright::gcode::internal
