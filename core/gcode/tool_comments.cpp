#include "core/gcode/tool_comments.h"

#include "core/base/numbers.h"
#include "core/gcode/modal_state.h"
#include "core/gcode/program_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

namespace millwright::gcode {

namespace {

bool in_word(char c) {
    return c >= 'A' && c <= 'Z';
}

std::string capitals(std::string_view text) {
    std::string result(text);
    std::ranges::transform(
        result, result.begin(), [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
    return result;
}

/// Where `word` stands in `text`, not as a part of another word; npos: nowhere.
std::size_t find_word(std::string_view text, std::string_view word, std::size_t from = 0) {
    for (auto at = text.find(word, from); at != std::string_view::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        const bool begins = at == 0 || !in_word(text[at - 1]);
        if (begins && (end == text.size() || !in_word(text[end]))) {
            return at;
        }
    }
    return std::string_view::npos;
}

std::string_view without_first(std::string_view text, std::string_view characters) {
    text.remove_prefix(std::min(text.find_first_not_of(characters), text.size()));
    return text;
}

struct WrittenLength {
    double value = 0.0;
    bool inches = false; ///< else as the program counts, unless `mm`
    bool mm = false;
};

/// Takes a number off the front of `text`.
std::optional<double> take_number(std::string_view& text) {
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc{}) {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    return value;
}

/// Takes `/4` off the front of `text`, behind `of`; nothing if it is no fraction.
std::optional<double> take_denominator(std::string_view& text, double of) {
    std::string_view rest = text;
    if (!rest.starts_with('/')) {
        return std::nullopt;
    }
    rest.remove_prefix(1);
    const auto denominator = take_number(rest);
    if (!denominator || !(*denominator > 0.0)) {
        return std::nullopt;
    }
    text = rest;
    return of / *denominator;
}

/// Takes the unit off the front of `text`.
void take_unit(std::string_view& text, WrittenLength& length) {
    std::string_view rest = without_first(text, " \t");
    for (const std::string_view unit : {"INCHES", "INCH", "IN", "\"", "MM"}) {
        const bool ends = unit == "\"" || rest.size() == unit.size() ||
                          (rest.size() > unit.size() && !in_word(rest[unit.size()]));
        if (rest.starts_with(unit) && ends) {
            length.mm = unit == "MM";
            length.inches = !length.mm;
            rest.remove_prefix(unit.size());
            text = rest;
            return;
        }
    }
}

/// Takes a number above 0 off the front of `text`, with its unit behind it: `6.`, `6MM`, `0.25 IN`, and of
/// inches `1/4` and `1-1/2`.
std::optional<WrittenLength> take_length(std::string_view& text) {
    std::string_view rest = text;
    const auto first = take_number(rest);
    if (!first) {
        return std::nullopt;
    }
    WrittenLength length{*first};
    bool fraction = false;
    if (const auto part = take_denominator(rest, *first)) {
        length.value = *part;
        fraction = true;
    } else if (rest.starts_with('-')) {
        std::string_view behind = rest.substr(1);
        const auto numerator = take_number(behind);
        const auto rest_of_inch = numerator ? take_denominator(behind, *numerator) : std::nullopt;
        if (rest_of_inch) {
            length.value += *rest_of_inch;
            rest = behind;
            fraction = true;
        }
    }
    take_unit(rest, length);
    length.inches = length.inches || (fraction && !length.mm);
    if (!(length.value > 0.0 && length.value < 1000.0)) {
        return std::nullopt;
    }
    text = rest;
    return length;
}

std::optional<WrittenLength> length_at(std::string_view text) {
    return take_length(text);
}

/// Whether `text` begins with one of `words`.
template <std::size_t count>
bool begins_with_word_of(std::string_view text, const std::array<std::string_view, count>& words) {
    return std::ranges::any_of(words, [&](std::string_view word) {
        return text.starts_with(word) && (text.size() == word.size() || !in_word(text[word.size()]));
    });
}

/// `6MM ENDMILL`, `1/4 FLAT END MILL`: a length with a unit, then what kind of tool it is of. `6MM DEEP WITH
/// THE END MILL` is none.
std::optional<WrittenLength> size_of_tool_in(std::string_view comment) {
    constexpr std::array<std::string_view, 12> tools{"ENDMILL",
                                                     "MILL",
                                                     "DRILL",
                                                     "BIT",
                                                     "CUTTER",
                                                     "VBIT",
                                                     "BALLNOSE",
                                                     "ENGRAVER",
                                                     "ROUGHER",
                                                     "BURR",
                                                     "REAMER",
                                                     "NOSE"};
    constexpr std::array<std::string_view, 34> kinds{
        "FLAT",   "BALL",      "BULL",     "SQUARE",      "CARBIDE",  "HSS",    "COBALT",  "END",  "V",
        "SPIRAL", "ENGRAVING", "ROUGHING", "FINISHING",   "STRAIGHT", "ROUTER", "SPOT",    "FACE", "CENTER",
        "CENTRE", "UPCUT",     "DOWNCUT",  "COMPRESSION", "SINGLE",   "TWO",    "CHAMFER", "SLOT", "DIA",
        "DIAM",   "DIAMETER",  "SOLID",    "TAPERED",     "CORNER",   "FLUTE",  "FL"};
    for (std::size_t at = comment.find_first_of("0123456789."); at != std::string_view::npos;) {
        const bool apart =
            at == 0 || std::string_view(" \t|:,(").find(comment[at - 1]) != std::string_view::npos;
        std::string_view rest = comment.substr(at);
        const auto length = apart ? take_length(rest) : std::nullopt;
        if (length && (length->mm || length->inches)) {
            rest = without_first(rest, " \t.,-");
            const std::string_view behind_flutes = without_first(rest, "0123456789 -");
            const bool names_kind =
                begins_with_word_of(rest, tools) || begins_with_word_of(behind_flutes, kinds);
            const bool names_tool = std::ranges::any_of(tools, [&](std::string_view tool) {
                return find_word(rest, tool) != std::string_view::npos;
            });
            if (names_kind && names_tool) {
                return length;
            }
        }
        const std::size_t end = comment.find_first_not_of("0123456789./-", at);
        at = comment.find_first_of("0123456789.", std::min(end, comment.size()));
    }
    return std::nullopt;
}

/// Behind `D=`, `DIA`, `DIA.`, `DIA. OF`, `DIAMETER` and what separates it from the number, or second of an
/// APT record. `DIA. OFF. - 1` is a number of a register.
std::optional<WrittenLength> diameter_in(std::string_view comment) {
    constexpr std::string_view apt = "TOOL/MILL,";
    if (const auto at = comment.find(apt); at != std::string_view::npos) {
        return length_at(without_first(comment.substr(at + apt.size()), " \t"));
    }
    for (const std::string_view word : {"DIAMETER", "DIA", "D"}) {
        for (auto at = find_word(comment, word); at != std::string_view::npos;
             at = find_word(comment, word, at + 1)) {
            std::string_view rest = without_first(comment.substr(at + word.size()), ". \t");
            if (word == "D" && !rest.starts_with('=') && !rest.starts_with(':')) { // a register, D1
                continue;
            }
            rest = without_first(rest, "=:- \t");
            if (word != "D" && rest.starts_with("OF ")) { // TOOL DIA. OF 8.0 MM
                rest = without_first(rest.substr(2), " \t");
            }
            if (const auto length = length_at(rest)) {
                return length;
            }
        }
    }
    return size_of_tool_in(comment);
}

/// Behind `T` or `TOOL`.
std::optional<int> tool_number_in(std::string_view comment) {
    for (const std::string_view word : {"TOOL", "T"}) {
        for (auto at = find_word(comment, word); at != std::string_view::npos;
             at = find_word(comment, word, at + 1)) {
            const std::string_view rest = without_first(comment.substr(at + word.size()), "#-:= \t");
            int number = 0;
            const auto read = std::from_chars(rest.data(), rest.data() + rest.size(), number);
            const bool whole =
                read.ptr == rest.data() + rest.size() || (*read.ptr != '.' && *read.ptr != '/');
            if (read.ec == std::errc{} && whole && number >= 0) {
                return number;
            }
        }
    }
    return std::nullopt;
}

/// Of what stands outside of comments: whether it says inches, or mm; nothing if neither.
std::optional<bool> inches_in(std::string_view words) {
    for (auto at = words.find('G'); at != std::string_view::npos; at = words.find('G', at + 1)) {
        int code = -1;
        const char* const end = words.data() + words.size();
        const auto read = std::from_chars(words.data() + at + 1, end, code);
        const bool whole = read.ec == std::errc{} && (read.ptr == end || *read.ptr != '.');
        if (whole && (code == 20 || code == 70)) {
            return true;
        }
        if (whole && (code == 21 || code == 71)) {
            return false;
        }
    }
    return std::nullopt;
}

/// The numbers of T words, of what stands outside of comments.
void add_called_tools(std::string_view words, std::vector<int>& called) {
    for (auto at = words.find('T'); at != std::string_view::npos; at = words.find('T', at + 1)) {
        int number = 0;
        const auto read = std::from_chars(words.data() + at + 1, words.data() + words.size(), number);
        const bool whole =
            read.ptr == words.data() + words.size() || *read.ptr != '.'; // T0.005 is a tolerance
        if (read.ec == std::errc{} && whole && (at == 0 || !in_word(words[at - 1]))) {
            called.push_back(number);
        }
    }
}

struct SplitLine {
    std::string words, comments;
};

/// In capitals.
SplitLine split(std::string_view line) {
    SplitLine parts;
    bool inside = false;
    for (std::size_t n = 0; n < line.size(); ++n) {
        const char c = line[n];
        if (!inside && c == ';') {
            parts.comments += capitals(line.substr(n + 1));
            break;
        }
        if (c == '(' || c == ')') {
            inside = c == '(';
            continue;
        }
        (inside ? parts.comments : parts.words) += capitals(std::string_view(&c, 1));
    }
    return parts;
}

} // namespace

std::vector<CommentTool> tools_in_comments(std::string_view text) {
    struct Found {
        CommentTool tool;
        WrittenLength length;
    };
    std::vector<Found> found;
    std::optional<bool> inches;
    std::vector<int> called;
    for (int line = 1; !text.empty(); ++line) {
        const SplitLine parts = split(text.substr(0, end_of_line(text)));
        text.remove_prefix(next_line(text, 0));
        inches = inches ? inches : inches_in(parts.words);
        add_called_tools(parts.words, called);
        const auto length = parts.comments.empty() ? std::nullopt : diameter_in(parts.comments);
        if (!length) {
            continue;
        }
        const CommentTool tool{tool_number_in(parts.comments), length->value, line};
        if (std::ranges::none_of(found, [&](const Found& one) { return one.tool.number == tool.number; })) {
            found.push_back({tool, *length});
        }
    }
    std::vector<CommentTool> tools;
    for (Found& one : found) {
        if (one.tool.number && !called.empty() &&
            std::ranges::find(called, *one.tool.number) == called.end()) {
            continue;
        }
        const bool in_inches = one.length.inches || (!one.length.mm && inches.value_or(false));
        one.tool.diameter *= in_inches ? mm_per_inch : 1.0;
        tools.push_back(one.tool);
    }
    return tools;
}

std::optional<CommentTool> only_tool(const std::vector<CommentTool>& tools) {
    const bool one_width = !tools.empty() && std::ranges::all_of(tools, [&](const CommentTool& tool) {
        return exactly_equal(tool.diameter, tools.front().diameter);
    });
    return one_width ? std::optional(tools.front()) : std::nullopt;
}

} // namespace millwright::gcode
