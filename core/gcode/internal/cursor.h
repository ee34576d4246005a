// Walks along one line. Blanks mean nothing in RS-274, not even inside of numbers and names.
#pragma once

#include "core/gcode/internal/refusal.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace millwright::gcode::internal {

[[nodiscard]] constexpr char to_upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
[[nodiscard]] constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
[[nodiscard]] constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

class Cursor {
public:
    explicit Cursor(std::string_view line)
        : begin_(line.data()), at_(line.data()), end_(line.data() + line.size()) {}

    /// The next character that is no blank, in upper case; 0 at the end. It becomes the present one.
    [[nodiscard]] char peek() {
        skip_blanks();
        return at_ == end_ ? '\0' : to_upper(*at_);
    }
    /// Past the present character.
    void advance() { ++at_; }
    /// Whether `c`, in upper case, comes next; then goes past it.
    [[nodiscard]] bool take(char c) {
        if (peek() != c || at_ == end_) {
            return false;
        }
        ++at_;
        return true;
    }
    /// Whether the letters of `word`, in upper case, come next; then goes past them.
    [[nodiscard]] bool take_word(std::string_view word) {
        const char* before = at_;
        for (const char letter : word) {
            if (!take(letter)) {
                at_ = before;
                return false;
            }
        }
        return true;
    }

    void skip_blanks() {
        while (at_ != end_ && is_blank(*at_)) {
            ++at_;
        }
    }
    [[nodiscard]] bool at_end() {
        skip_blanks();
        return at_ == end_;
    }
    /// Of the present character, from 1.
    [[nodiscard]] int column() const { return static_cast<int>(at_ - begin_) + 1; }

    [[nodiscard]] const char* position() const { return at_; }
    [[nodiscard]] const char* end() const { return end_; }
    void move_to(const char* position) { at_ = position; }

    /// Counts how deep brackets are nested.
    int depth = 0;

private:
    const char* begin_;
    const char* at_;
    const char* end_;
};

// Numbers as RS-274 writes them: a sign, digits, a point; no exponent, which would be an E word.

/// Up to 15 digits are an exact double, and so are these powers of ten: one division then rounds correctly.
inline constexpr std::ptrdiff_t exact_digits = 15;
inline constexpr std::array<double, exact_digits + 1> powers_of_ten{
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// A number as almost all are: of few digits, without blanks in it. Goes past it and the blanks behind it.
/// False, and nothing read, for anything else.
[[nodiscard]] inline bool read_plain_number(Cursor& cursor, double& value) {
    const char* at = cursor.position();
    const char* const end = cursor.end();
    const bool negative = at != end && *at == '-';
    at += negative ? 1 : 0;
    const char* const begin = at;
    std::uint64_t digits = 0;
    for (; at != end && is_digit(*at); ++at) {
        digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
    }
    std::ptrdiff_t count = at - begin;
    std::ptrdiff_t decimals = 0;
    if (at != end && *at == '.') {
        const char* const point = ++at;
        for (; at != end && is_digit(*at); ++at) {
            digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
        }
        decimals = at - point;
        count += decimals;
    }
    if (count == 0 || count > exact_digits) {
        return false;
    }
    while (at != end && is_blank(*at)) {
        ++at;
    }
    if (at != end && (is_digit(*at) || *at == '.')) {
        return false;
    }
    const double magnitude = static_cast<double>(digits) / powers_of_ten[static_cast<std::size_t>(decimals)];
    value = negative ? -magnitude : magnitude;
    cursor.move_to(at);
    return true;
}

/// The number at the cursor, which goes past it. Exactly rounded. Refuses what is none or is too large for a
/// double.
[[nodiscard]] double read_number(Cursor& cursor);

/// Digits only; refuses anything else and more than nine digits.
[[nodiscard]] int read_unsigned(Cursor& cursor);

/// What stands behind N: 10 or 10.5. It has no meaning.
void read_line_number(Cursor& cursor);

} // namespace millwright::gcode::internal
