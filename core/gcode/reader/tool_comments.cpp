#include "core/gcode/reader/tool_comments.h"

#include "core/base/numbers.h"
#include "core/gcode/reader/line_ends.h"
#include "core/gcode/reader/modal_state.h"

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

/// A number above 0, with its unit behind it.
std::optional<WrittenLength> length_at(std::string_view text) {
    WrittenLength length;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), length.value);
    if (read.ec != std::errc{} || !(length.value > 0.0 && length.value < 1000.0)) {
        return std::nullopt;
    }
    text = without_first(text.substr(static_cast<std::size_t>(read.ptr - text.data())), " \t");
    length.mm = text.starts_with("MM");
    length.inches = text.starts_with("IN") || text.starts_with('"');
    return length;
}

/// Behind `D=`, `DIA`, `DIA.`, `DIAMETER` and what separates it from the number, or second of an APT record.
/// `DIA. OFF. - 1` is a number of a register.
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
            if (const auto length = length_at(rest)) {
                return length;
            }
        }
    }
    return std::nullopt;
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
        if (read.ec == std::errc{} && (at == 0 || !in_word(words[at - 1]))) {
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
