#include "core/pmac/driver/guard_rules.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace millwright::pmac {

namespace {

constexpr int guard_plc = 31;

/// `I5=2`, `P1..9=0`, `M1000->*`: an assignment, or the definition of an M-variable.
struct Assignment {
    char letter = 'I';
    int first = 0, last = 0;
    bool computed = false;         ///< the number of the variable is an expression
    bool default_value = false;    ///< `*`
    std::optional<double> value;   ///< nothing: an expression, a default, or a definition
    std::string_view definition{}; ///< behind "->", with what follows it; else empty

    [[nodiscard]] bool covers(int from, int to) const { return !computed && first <= to && last >= from; }
};

bool is_digit_of(char c, bool hexadecimal) {
    return (c >= '0' && c <= '9') || (hexadecimal && c >= 'A' && c <= 'F');
}

/// The card takes no notice of blanks and of the case.
std::string without_blanks(std::string_view line) {
    std::string text;
    for (const char c : line) {
        const bool small = c >= 'a' && c <= 'z';
        text += c == ' ' || c == '\t' ? "" : std::string(1, small ? static_cast<char>(c - 'a' + 'A') : c);
    }
    return text;
}

/// A number without a sign at the front of `rest`, which loses it: `1001`, `5.0`, `$3E9`.
std::optional<double> take_number(std::string_view& rest) {
    const bool hexadecimal = rest.starts_with('$');
    std::size_t end = hexadecimal ? 1 : 0;
    while (end < rest.size() && (is_digit_of(rest[end], hexadecimal) ||
                                 (!hexadecimal && rest[end] == '.' && rest.substr(end, 2) != ".."))) {
        ++end;
    }
    double value = 0.0;
    bool read = false;
    if (hexadecimal) {
        constexpr int base = 16;
        std::uint64_t bits = 0;
        read = std::from_chars(rest.data() + 1, rest.data() + end, bits, base).ec == std::errc{};
        value = static_cast<double>(bits);
    } else {
        read = std::from_chars(rest.data(), rest.data() + end, value).ec == std::errc{};
    }
    rest.remove_prefix(read ? end : 0);
    return read ? std::optional(value) : std::nullopt;
}

std::optional<int> take_index(std::string_view& rest) {
    constexpr double most = 1e6;
    const auto number = take_number(rest);
    return number && *number < most ? std::optional(static_cast<int>(*number)) : std::nullopt;
}

/// What is in parentheses at the front of `rest`, which loses it.
std::string_view take_parentheses(std::string_view& rest) {
    int depth = 0;
    std::size_t end = 0;
    do {
        depth += rest[end] == '(' ? 1 : rest[end] == ')' ? -1 : 0;
        ++end;
    } while (end < rest.size() && depth > 0);
    const std::string_view inside = rest.substr(1, depth == 0 ? end - 2 : end - 1);
    rest.remove_prefix(end);
    return inside;
}

/// A value that is a number and no expression.
std::optional<double> literal(std::string_view rest) {
    const bool minus = rest.starts_with('-');
    rest.remove_prefix(minus || rest.starts_with('+') ? 1 : 0);
    const auto number = take_number(rest);
    const bool goes_on =
        !rest.empty() && std::string_view("+-*/%&|^").find(rest.front()) != std::string_view::npos;
    return number && !goes_on ? std::optional(minus ? -*number : *number) : std::nullopt;
}

/// The one whose letter is at the front of `rest`.
std::optional<Assignment> assignment_at(std::string_view rest) {
    Assignment found;
    found.letter = rest.front();
    rest.remove_prefix(1);
    if (rest.starts_with('(')) {
        std::string_view inside = take_parentheses(rest);
        const auto number = take_index(inside);
        found.computed = !number || !inside.empty();
        found.first = found.last = number.value_or(0);
    } else if (const auto first = take_index(rest)) {
        found.first = found.last = *first;
        if (rest.starts_with("..")) {
            rest.remove_prefix(2);
            found.last = take_index(rest).value_or(found.first);
        }
    } else {
        return std::nullopt;
    }
    if (rest.starts_with("->")) {
        found.definition = rest.substr(2);
        return found.letter == 'M' && !found.definition.empty() ? std::optional(found)
                                                                : std::nullopt; // else a question
    }
    if (!rest.starts_with('=')) {
        return std::nullopt;
    }
    found.value = literal(rest.substr(1));
    found.default_value = rest.substr(1).starts_with('*');
    return found;
}

/// Where the parenthesis at `at` is closed; npos: nowhere. Those within quoted text do not count.
std::size_t closing_parenthesis(std::string_view text, std::size_t at) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t n = at; n < text.size(); ++n) {
        quoted = quoted != (text[n] == '"');
        depth += quoted ? 0 : text[n] == '(' ? 1 : text[n] == ')' ? -1 : 0;
        if (depth == 0) {
            return n;
        }
    }
    return std::string_view::npos;
}

/// Adds those in `text`. What is in parentheses that are closed compares; quoted text is a line of its own.
void add_assignments(std::string_view text, std::vector<Assignment>& all) {
    std::size_t compares_to = 0; // the place behind a pair of parentheses
    for (std::size_t n = 0; n < text.size(); ++n) {
        if (text[n] == '"') {
            const std::size_t end = std::min(text.find('"', n + 1), text.size());
            add_assignments(text.substr(n + 1, end - n - 1), all);
            n = end;
        } else if (n < compares_to) {
            continue;
        } else if (text[n] == '(') {
            const std::size_t end = closing_parenthesis(text, n);
            compares_to = end == std::string_view::npos ? n : end;
        } else if (std::string_view("IPQM").find(text[n]) != std::string_view::npos) {
            if (const auto found = assignment_at(text.substr(n))) {
                all.push_back(*found);
            }
        }
    }
}

/// All of them in a line.
std::vector<Assignment> assignments_of(std::string_view text) {
    std::vector<Assignment> all;
    add_assignments(text, all);
    return all;
}

/// Of DISABLE PLC {list}, behind those words.
bool names_guard(std::string_view list) {
    do {
        const auto first = take_index(list);
        if (!first) {
            return true; // an expression, or nothing: the value is unknown
        }
        int last = *first;
        if (list.starts_with("..")) {
            list.remove_prefix(2);
            last = take_index(list).value_or(guard_plc);
        }
        if (*first <= guard_plc && last >= guard_plc) {
            return true;
        }
        if (!list.starts_with(',')) {
            return false;
        }
        list.remove_prefix(1);
    } while (true);
}

bool stops_guard(std::string_view text) {
    for (const std::string_view words : {"DISABLEPLC", "DISPLC", "OPENPLC", "OPEPLC"}) {
        for (std::size_t at = text.find(words); at != std::string_view::npos; at = text.find(words, at + 1)) {
            if (names_guard(text.substr(at + words.size()))) {
                return true;
            }
        }
    }
    return text.find("^D") != std::string_view::npos; // of all PLC programs
}

/// Words of the card's memory that hold neither programs nor variables.
struct MemoryPart {
    char word = 'X'; ///< X or Y; '*': both, and long ones
    int first = 0, last = 0;
};

constexpr std::array<MemoryPart, 3> set_up_memory{
    MemoryPart{'Y', 0x720, 0x73F},    // the encoder conversion table
    MemoryPart{'X', 0x783, 0x787},    // where the computer finds the dual-ported memory
    MemoryPart{'*', 0xD000, 0xDFFF}}; // that memory

/// Where M-variables may point besides.
constexpr std::array<MemoryPart, 3> registers{
    MemoryPart{'X', 0x0, 0x3},        // the servo counter and the card's status
    MemoryPart{'*', 0x7F0, 0x7FF},    // registers that nothing uses
    MemoryPart{'*', 0xC000, 0xCFFF}}; // encoders, outputs and flags of the channels

/// Where those may point besides that are never given a value: the registers of motors 1 to 8 and of the
/// coordinate systems, as the commanded position of motor 1 (D:$28).
constexpr std::array<MemoryPart, 2> read_registers{MemoryPart{'*', 0x20, 0x1FF},
                                                   MemoryPart{'*', 0x800, 0xFFF}};

/// The M-variables that are kept for reading: of motor n, M{n}30 to M{n}49 and M{n}61 to M{n}79, the card's
/// usual numbers for them.
constexpr int reading_motors = 8;
constexpr std::array<std::array<int, 2>, 2> reading_numbers{{{30, 49}, {61, 79}}};

constexpr std::array<std::string_view, 7> memory_words{"X", "Y", "L", "DP", "D", "F", "TWS"};

bool is_within(std::span<const MemoryPart> parts, std::string_view word, int first, std::ptrdiff_t last) {
    return std::ranges::any_of(parts, [&](const MemoryPart& part) {
        return (part.word == '*' || word == std::string_view(&part.word, 1)) && first >= part.first &&
               last <= part.last;
    });
}

/// At the front of `rest`, which loses it; empty if there is none.
std::string_view take_memory_word(std::string_view& rest) {
    const auto* const found =
        std::ranges::find_if(memory_words, [&](std::string_view name) { return rest.starts_with(name); });
    if (found == memory_words.end()) {
        return {};
    }
    rest.remove_prefix(found->size());
    return *found;
}

/// Behind WX, WY, WL ...: `:$786,$D,$43`, the address and a value for each word from there on.
bool writes_set_up(std::string_view word, std::string_view rest) {
    rest.remove_prefix(rest.starts_with(':') ? 1 : 0);
    const auto first = take_index(rest);
    const bool has_values = first && rest.starts_with(',');
    const auto count = has_values ? std::ranges::count(rest, ',') : 1;
    return first && is_within(set_up_memory, word, *first, *first + count - 1);
}

/// Whether some, or all, of the variables of `one` are kept for reading.
bool reads_some(const Assignment& one) {
    bool some = false;
    for (int motor = 1; motor <= reading_motors; ++motor) {
        for (const auto& [first, last] : reading_numbers) {
            some = some || one.covers(100 * motor + first, 100 * motor + last);
        }
    }
    return some;
}

bool reads_all(const Assignment& one) {
    const int within = one.first % 100;
    const int motor = one.first / 100;
    return !one.computed && motor >= 1 && motor <= reading_motors && one.last / 100 == motor &&
           std::ranges::any_of(reading_numbers, [&](const auto& numbers) {
               return within >= numbers[0] && one.last % 100 <= numbers[1];
           });
}

/// `L:$13E8`, `X:$C000,12,4`: whether values of such a variable could go where programs and variables are.
bool points_into_memory(const Assignment& one) {
    std::string_view definition = one.definition;
    if (definition.starts_with('*')) {
        return false; // a number of its own
    }
    const std::string_view word = take_memory_word(definition);
    definition.remove_prefix(definition.starts_with(':') ? 1 : 0);
    const auto address = take_index(definition);
    return word.empty() || !address ||
           (!is_within(set_up_memory, word, *address, *address) &&
            !is_within(registers, word, *address, *address) &&
            !(reads_all(one) && is_within(read_registers, word, *address, *address)));
}

/// Whether the card may write through an I-variable of this value, each servo cycle: the word at its lower 16
/// bits, and `more` behind it.
bool is_output_address(double value, std::string_view word, int more) {
    constexpr double beyond_words = 1 << 24; // of the card
    constexpr std::int64_t address_bits = 0xFFFF, last_status = 3;
    if (!(std::abs(value) < beyond_words)) {
        return false;
    }
    const std::int64_t address = static_cast<std::int64_t>(value) & address_bits;
    const auto first = static_cast<int>(address);
    return address > last_status && (is_within(set_up_memory, word, first, first + more) ||
                                     is_within(registers, word, first, first + more));
}

/// Of Ix02, the outputs of the motors, and Ix25, whose register also has the amplifier's enable bit: whether
/// `one` lets the card write elsewhere.
bool writes_outputs_elsewhere(const Assignment& one) {
    constexpr int hundred = 100, last_motor = 32, encoders = 9; // I900 to I979 are no motor's
    constexpr int output = 2, flags = 25;
    for (int motor = 1; motor <= last_motor; ++motor) {
        const bool is_output = one.covers(hundred * motor + output, hundred * motor + output);
        const bool is_flags = one.covers(hundred * motor + flags, hundred * motor + flags);
        if (motor == encoders || one.default_value || !(is_output || is_flags)) {
            continue;
        }
        // With a commutated motor (Ix01 = 1) the output is two words.
        if (!one.value || (is_output && !is_output_address(*one.value, "Y", 1)) ||
            (is_flags && !is_output_address(*one.value, "X", 0))) {
            return true;
        }
    }
    return false;
}

std::string refused_setting(const Assignment& one) {
    constexpr int plcs = 5, interrupts = 8, servo_time = 10;
    if (one.computed) {
        return "the number of the I-variable is computed, so it could be one that the guard needs";
    }
    if (one.covers(plcs, plcs)) {
        constexpr int background = 2, values = 4;
        const bool whole = one.value && *one.value >= 0.0 && *one.value < 1e6;
        if (!whole || (static_cast<int>(*one.value) % values & background) == 0) {
            return "the guard is PLC 31, which runs only with I5 = 2 or 3";
        }
    }
    if (one.covers(interrupts, interrupts)) {
        constexpr double most = 15.0; // 7 ms between two looks, with the factory's servo time
        if (!one.value || !(*one.value >= 0.0 && *one.value <= most)) {
            return "the guard must run every few milliseconds: use I8 = 0 to 15";
        }
    }
    if (writes_outputs_elsewhere(one)) {
        return "the card writes each servo cycle to the address in Ix02 and Ix25, where the guard's program "
               "or its variables could be: use a number within $C000 to $CFFF, the dual-ported memory ($D000 "
               "to "
               "$DFFF), the encoder table ($720 to $73F) or $7F0 to $7FF";
    }
    return one.covers(servo_time, servo_time) ? "the guard counts servo cycles, whose length is set by I10"
                                              : "";
}

/// WX:$786,$D,$43; no WHILE, no WAIT, no move of the axis W.
bool writes_memory(std::string_view text) {
    for (std::size_t at = text.find('W'); at != std::string_view::npos; at = text.find('W', at + 1)) {
        std::string_view rest = text.substr(at + 1);
        const std::string_view word = take_memory_word(rest);
        if (word.empty()) {
            continue;
        }
        const bool is_address = rest.starts_with(':') || rest.starts_with('$') || rest.starts_with('(') ||
                                (!rest.empty() && is_digit_of(rest.front(), false));
        if (is_address && !writes_set_up(word, rest)) {
            return true;
        }
    }
    return false;
}

} // namespace

std::string guard_refusal(std::string_view line) {
    constexpr int first_own = 1000, last_own_p = 1006, last_own_m = 1008;
    const std::string text = without_blanks(line);
    if (stops_guard(text)) {
        return "the guard is PLC 31";
    }
    if (writes_memory(text)) {
        return "what it writes into the card's memory could be the guard's program or its variables: only "
               "the encoder table (WY:$720 to $73F), WX:$783 to $787 and the dual-ported memory ($D000 to "
               "$DFFF) may be written by W commands";
    }
    for (const Assignment& one : assignments_of(text)) {
        if (one.letter == 'I') {
            if (std::string why = refused_setting(one); !why.empty()) {
                return why;
            }
        } else if (one.letter == 'P' && one.covers(first_own, last_own_p)) {
            return "P1000 to P1006 are reserved for the guard";
        } else if (one.letter == 'M' && one.covers(first_own, last_own_m)) {
            return "M1000 to M1008 are reserved for the guard";
        } else if (one.letter == 'M' && one.definition.empty() && one.computed) {
            return "the number of the M-variable is computed, so it could be one that is reserved for "
                   "reading a motor's registers, or for the guard";
        } else if (one.letter == 'M' && one.definition.empty() && reads_some(one)) {
            return "M-variables n30 to n49 and n61 to n79 of motor n (M161) are reserved for reading its "
                   "registers, because a value would be written into them: use another number";
        } else if (one.letter == 'M' && !one.definition.empty() && points_into_memory(one)) {
            return "the guard's program or its variables could be at that address: an M-variable may point "
                   "only to X:$0 to $3, $7F0 to $7FF, $C000 to $CFFF, the dual-ported memory ($D000 to "
                   "$DFFF), the encoder table (Y:$720 to $73F) and X:$783 to $787; to read registers of "
                   "motors ($20 to $1FF, $800 to $FFF), use M-variables n30 to n49 and n61 to n79 of motor n "
                   "(M161->D:$28)";
        }
    }
    return "";
}

bool sets_handshake(std::string_view line) {
    const std::string text = without_blanks(line);
    const std::vector<Assignment> all = assignments_of(text);
    return std::ranges::any_of(all, [](const Assignment& one) {
        constexpr std::array<int, 5> own{1, 3, 4, 6, 9};
        return one.letter == 'I' &&
               std::ranges::any_of(own, [&](int variable) { return one.covers(variable, variable); });
    });
}

} // namespace millwright::pmac
