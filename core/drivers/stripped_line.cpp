#include "core/drivers/stripped_line.h"

#include <algorithm>
#include <cctype>

namespace millwright::drivers {

std::string stripped_line(std::string_view line) {
    std::string text;
    bool comment = false;
    for (const char c : line) {
        if (comment) {
            comment = c != ')';
        } else if (c == ';') {
            break;
        } else if (c == '(') {
            comment = true;
        } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
            text += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        }
    }
    if (text.starts_with('N')) {
        text.erase(0, std::min(text.find_first_not_of("0123456789.", 1), text.size()));
    }
    return text;
}

bool has_code(std::string_view stripped_line, std::string_view code) {
    for (std::size_t at = stripped_line.find(code); at != std::string_view::npos;
         at = stripped_line.find(code, at + 1)) {
        const std::size_t next = at + code.size();
        if (next >= stripped_line.size() ||
            std::isdigit(static_cast<unsigned char>(stripped_line[next])) == 0) {
            return true;
        }
    }
    return false;
}

bool is_flow(std::string_view stripped_line) {
    return stripped_line.starts_with('O') || stripped_line.starts_with("M98") ||
           stripped_line.starts_with("M99");
}

} // namespace millwright::drivers
