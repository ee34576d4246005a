#include "core/gcode/word_column.h"

#include "core/base/numbers.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>

namespace millwright::gcode {
namespace {

char capital(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool is_letter(char c) {
    return capital(c) >= 'A' && capital(c) <= 'Z';
}

char closing(char open) {
    switch (open) {
    case '(':
        return ')';
    case '<':
        return '>';
    default:
        return '\0';
    }
}

/// Whether the number behind a letter is `code`.
bool has_code(std::string_view behind, double code) {
    behind.remove_prefix(std::min(behind.find_first_not_of(" \t"), behind.size()));
    behind = without_plus(behind);
    double number = 0.0;
    const auto read = std::from_chars(behind.data(), behind.data() + behind.size(), number);
    return read.ec == std::errc() && exactly_equal(number, code);
}

} // namespace

int column_of_word(std::string_view line, char letter, std::optional<double> code) {
    int brackets = 0;
    for (std::size_t at = 0; at < line.size() && line[at] != ';'; ++at) {
        if (const char end = closing(line[at]); end != '\0') {
            at = line.find(end, at);
            if (at == std::string_view::npos) {
                return 0;
            }
            continue;
        }
        brackets += line[at] == '[' ? 1 : 0;
        brackets -= line[at] == ']' ? 1 : 0;
        const bool word = brackets == 0 && is_letter(line[at]) && capital(line[at]) == letter;
        if (word && (!code || has_code(line.substr(at + 1), *code))) {
            return static_cast<int>(at) + 1;
        }
    }
    return 0;
}

int first_column(std::string_view line) {
    const std::size_t at = line.find_first_not_of(" \t\r");
    return at == std::string_view::npos ? 0 : static_cast<int>(at) + 1;
}

} // namespace millwright::gcode
