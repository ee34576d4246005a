#include "core/pmac/driver/card_words.h"

#include <algorithm>
#include <array>

namespace millwright::pmac {

namespace {

struct Keyword {
    std::string_view full, brief;
};

constexpr std::array<Keyword, 78> keywords{{
    {"UNDEFINE", "UNDEF"},  {"BLOCKSTART", "BSTART"},
    {"BLOCKSTOP", "BSTOP"}, {"ENDWHILE", "ENDW"},
    {"VERSION", "VER"},     {"CIRCLE1", "CIR1"},
    {"CIRCLE2", "CIR2"},    {"STIMULUS", "STIM"},
    {"DISABLE", "DIS"},     {"ENABLE", "ENA"},
    {"DELETE", "DEL"},      {"DEFINE", "DEF"},
    {"RETURN", "RET"},      {"NORMAL", "NRM"},
    {"LINEAR", "LIN"},      {"GATHER", "GAT"},
    {"CLOSE", "CLS"},       {"CLEAR", "CLR"},
    {"GOSUB", "GOS"},       {"TRACE", "TRAC"},
    {"ENDIF", "ENDI"},      {"WHILE", "WHILE"},
    {"RAPID", "RPD"},       {"DWELL", "DWE"},
    {"DELAY", "DLY"},       {"HOMEZ", "HMZ"},
    {"ATAN2", "ATAN2"},     {"HOME", "HM"},
    {"OPEN", "OPEN"},       {"LIST", "LIST"},
    {"SAVE", "SAVE"},       {"SIZE", "SIZE"},
    {"TYPE", "TYPE"},       {"PROG", "PROG"},
    {"FRAX", "FRAX"},       {"PSET", "PSET"},
    {"ELSE", "ELSE"},       {"GOTO", "GOTO"},
    {"CALL", "CALL"},       {"STOP", "STOP"},
    {"SEND", "SEND"},       {"ASIN", "ASIN"},
    {"ACOS", "ACOS"},       {"ATAN", "ATAN"},
    {"SQRT", "SQRT"},       {"ROT", "ROT"},
    {"PLC", "PLC"},         {"ABS", "ABS"},
    {"INC", "INC"},         {"CMD", "CMD"},
    {"AND", "AND"},         {"SIN", "SIN"},
    {"COS", "COS"},         {"TAN", "TAN"},
    {"EXP", "EXP"},         {"INT", "INT"},
    {"ALL", "ALL"},         {"RHX", "RHX"},
    {"RHY", "RHY"},         {"RHL", "RHL"},
    {"RX", "RX"},           {"RY", "RY"},
    {"RL", "RL"},           {"WX", "WX"},
    {"WY", "WY"},           {"WL", "WL"},
    {"DP", "DP"},           {"IF", "IF"},
    {"OR", "OR"},           {"LN", "LN"},
    {"TA", "TA"},           {"TS", "TS"},
    {"TM", "TM"},           {"PR", "PR"},
    {"PC", "PC"},           {"ZZ", "ZZ"},
    {"DATE", "DATE"},       {"PASSWORD", "PASSWORD"},
}};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Upper case without blanks, as far as it is not quoted.
struct Bare {
    std::string text;
    std::vector<std::size_t> places; ///< of its characters in the line
};

Bare bare(std::string_view line) {
    Bare result;
    bool quoted = false;
    for (std::size_t at = 0; at < line.size(); ++at) {
        const char c = line[at];
        if (!quoted && (c == ' ' || c == '\t')) {
            continue;
        }
        quoted = quoted != (c == '"');
        result.text += !quoted && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        result.places.push_back(at);
    }
    return result;
}

/// `5`, `2.5`, `$3E9` from `at` on; 0: there is none. A blank ends one of hexadecimal digits, which are
/// letters, too: `$D CLOSE`.
std::size_t length_of_number(const Bare& bare, std::size_t at) {
    const std::string_view text = std::string_view(bare.text).substr(at);
    const bool hexadecimal = text.starts_with('$');
    std::size_t end = hexadecimal ? 1 : 0;
    while (end < text.size() &&
           (is_digit(text[end]) || (hexadecimal && text[end] >= 'A' && text[end] <= 'F') ||
            (!hexadecimal && text[end] == '.' && text.substr(end, 2) != "..")) &&
           (!hexadecimal || bare.places[at + end] == bare.places[at] + end)) {
        ++end;
    }
    return hexadecimal && end == 1 ? 0 : end;
}

} // namespace

std::optional<CardWord> card_word(std::string_view text) {
    CardWord best;
    for (const Keyword& one : keywords) {
        for (const std::string_view form : {one.full, one.brief}) {
            if (text.starts_with(form) && form.size() > best.length) {
                best = {one.full, one.brief, form.size()};
            }
        }
    }
    return best.length > 0 ? std::optional(best) : std::nullopt;
}

std::vector<PlacedWord> placed_words(std::string_view line) {
    const Bare whole = bare(line);
    const std::string_view text = whole.text;
    std::vector<PlacedWord> words;
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view rest = text.substr(at);
        const auto known = card_word(rest);
        std::size_t length = known ? known->length : std::max<std::size_t>(1, length_of_number(whole, at));
        if (rest.front() == '"') {
            length = std::min(rest.find('"', 1), rest.size() - 1) + 1;
        }
        words.push_back({std::string(known ? known->full : rest.substr(0, length)),
                         whole.places[at],
                         whole.places[at + length - 1] + 1});
        at += length;
    }
    return words;
}

} // namespace millwright::pmac
