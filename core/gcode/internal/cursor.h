// Walks along one line. Blanks mean nothing in RS-274, not even inside of numbers and names.
#pragma once

#include "core/gcode/internal/refusal.h"

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

} // namespace millwright::gcode::internal
