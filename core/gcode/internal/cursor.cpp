#include "core/gcode/internal/cursor.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstddef>

namespace millwright::gcode::internal {

namespace {

/// Digits and points from `from` on, taken together across blanks.
class Gathered {
public:
    explicit Gathered(Cursor& cursor) {
        for (char c = cursor.peek(); is_digit(c) || c == '.'; c = cursor.peek()) {
            if (size_ == text_.size()) {
                refuse(cursor.column(), "a number may have at most 300 digits");
            }
            text_[size_++] = c;
            cursor.advance();
        }
    }
    [[nodiscard]] const char* begin() const { return text_.data(); }
    [[nodiscard]] const char* end() const { return text_.data() + size_; }

private:
    std::array<char, 300> text_{};
    std::size_t size_ = 0;
};

double read_slowly(Cursor& cursor) {
    const int column = cursor.column();
    const Gathered gathered(cursor);
    double value = 0.0;
    const auto read = std::from_chars(gathered.begin(), gathered.end(), value, std::chars_format::fixed);
    if (read.ec != std::errc{} || read.ptr != gathered.end()) {
        refuse(column,
               fmt::format("'{}' is not a number",
                           std::string_view(gathered.begin(),
                                            static_cast<std::size_t>(gathered.end() - gathered.begin()))));
    }
    return value;
}

} // namespace

double read_number(Cursor& cursor) {
    double value = 0.0;
    char c = cursor.peek();
    if (read_plain_number(cursor, value)) {
        return value;
    }
    const int column = cursor.column();
    const bool negative = c == '-';
    if (c == '-' || c == '+') {
        cursor.advance();
        c = cursor.peek();
    }
    if (!is_digit(c) && c != '.') {
        refuse(column, "a number is expected");
    }
    value = read_slowly(cursor);
    return negative ? -value : value;
}

int read_unsigned(Cursor& cursor) {
    const int column = cursor.column();
    if (!is_digit(cursor.peek())) {
        refuse(column, "an integer without a sign is expected");
    }
    int value = 0;
    for (char c = cursor.peek(); is_digit(c); c = cursor.peek()) {
        if (value > 99'999'999) {
            refuse(column, "an integer may have at most nine digits");
        }
        value = value * 10 + (c - '0');
        cursor.advance();
    }
    return value;
}

void read_line_number(Cursor& cursor) {
    static_cast<void>(read_unsigned(cursor));
    if (cursor.take('.')) {
        static_cast<void>(read_unsigned(cursor));
    }
}

} // namespace millwright::gcode::internal
