#include "core/gcode/internal/comments.h"

#include "core/gcode/internal/cursor.h"
#include "core/gcode/internal/expression.h"
#include "core/gcode/internal/refusal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace millwright::gcode::internal {

namespace {

struct CommentKind {
    std::string_view begins; ///< in lower case
    CommandKind command;
    bool expands; ///< parameters in it are replaced by their values
};

// LOGAPPEND and LOGOPEN before LOG, which begins like them.
constexpr std::array<CommentKind, 7> comment_kinds{{
    {"msg,", CommandKind::message, false},
    {"debug,", CommandKind::message, true},
    {"print,", CommandKind::print, true},
    {"logopen,", CommandKind::logopen, false},
    {"logappend,", CommandKind::logappend, false},
    {"log,", CommandKind::log, true},
    {"logclose", CommandKind::logclose, false},
}};

char to_lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool begins_with(std::string_view text, std::string_view lower) {
    if (text.size() < lower.size()) {
        return false;
    }
    for (std::size_t n = 0; n < lower.size(); ++n) {
        if (to_lower(text[n]) != lower[n]) {
            return false;
        }
    }
    return true;
}

/// #5 or #<name> at the cursor, of which the # was taken. Nothing where there is no such parameter.
std::optional<double> parameter_at(Cursor& cursor, const Variables& variables) {
    if (cursor.peek() == '<') {
        return variables.named(read_name(cursor));
    }
    int number = 0;
    for (; cursor.position() != cursor.end() && is_digit(*cursor.position()); cursor.advance()) {
        number = std::min(10 * number + (*cursor.position() - '0'), parameter_count);
    }
    return Variables::is_number(number) ? std::optional<double>(variables.numbered(number, 1)) : std::nullopt;
}

/// What %d, %f or %.N behind a % says of the values that follow; nothing where it says nothing.
struct Format {
    int decimals = 6;
    std::size_t length = 0; ///< characters behind the %
};

std::optional<Format> format_at(std::string_view text) {
    constexpr int decimals_of_f = 4;
    if (text.starts_with('d')) {
        return Format{0, 1};
    }
    if (text.starts_with('f')) {
        return Format{decimals_of_f, 1};
    }
    if (text.size() > 2 && text[0] == '.' && is_digit(text[1]) && text[2] == 'f') {
        return Format{text[1] - '0', 3};
    }
    return std::nullopt;
}

std::string expanded(std::string_view text, const Variables& variables) {
    std::string result;
    int decimals = Format{}.decimals;
    Cursor cursor(text);
    while (cursor.position() != cursor.end()) {
        const char c = *cursor.position();
        cursor.advance();
        const std::string_view rest(cursor.position(),
                                    static_cast<std::size_t>(cursor.end() - cursor.position()));
        if (const auto format = c == '%' ? format_at(rest) : std::nullopt) {
            decimals = format->decimals;
            cursor.move_to(cursor.position() + format->length);
            continue;
        }
        const bool at_parameter = c == '#' && cursor.position() != cursor.end() &&
                                  (is_digit(*cursor.position()) || *cursor.position() == '<');
        if (!at_parameter) {
            result += c;
            continue;
        }
        const auto value = parameter_at(cursor, variables);
        constexpr double as_zero = 1e-6;
        result +=
            value ? fmt::format("{:.{}f}", std::abs(*value) < as_zero ? 0.0 : *value, decimals) : "######";
    }
    return result;
}

} // namespace

void execute_comment(Run& run, std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    text.remove_prefix(begin == std::string_view::npos ? text.size() : begin);
    for (const CommentKind& kind : comment_kinds) {
        if (!begins_with(text, kind.begins)) {
            continue;
        }
        const std::string_view rest = text.substr(kind.begins.size());
        const bool silent = begins_with(text, "debug,") && !(run.variables.stored(parameter_debug) > 0.0);
        if (!silent) {
            const std::string full = kind.expands ? expanded(rest, run.variables) : std::string(rest);
            run.out.send(command_of(kind.command, std::string_view(full)));
        }
        return;
    }
    if (begins_with(text, "abort,")) {
        refuse(1,
               fmt::format("the program stopped with a message:{}", expanded(text.substr(6), run.variables)));
    }
    run.out.post(command_of(CommandKind::comment, text));
}

} // namespace millwright::gcode::internal
