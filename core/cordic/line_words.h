// The words of one line of an assembler's text, each with the column it begins at.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace millwright::cordic {

struct LineWord {
    std::string_view text;
    int column = 0; ///< from 1
};

/// Cut at blanks; comma, colon and bar are words of their own; a semicolon begins a comment.
[[nodiscard]] std::vector<LineWord> words_of(std::string_view line);

/// A whole number, decimal or 0x hexadecimal, with sign. False unless all of `text` is one.
[[nodiscard]] bool read_number(std::string_view text, long long& number);

/// A finite decimal number, with sign. False unless all of `text` is one.
[[nodiscard]] bool read_real(std::string_view text, double& number);

/// With capital letters only.
[[nodiscard]] std::string capital(std::string_view text);

/// A letter or underscore, then also digits.
[[nodiscard]] bool is_name(std::string_view text);

/// The next line of `text`, which is taken from it, without its end.
[[nodiscard]] std::string_view take_line(std::string_view& text);

} // namespace millwright::cordic
