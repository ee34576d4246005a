// Where a word stands in a line of a program, for diagnostics.
#pragma once

#include <optional>
#include <string_view>

namespace millwright::gcode {

/// Column, from 1, of the first word `letter` (a capital) outside of comments, brackets and names; with a
/// `code`, of the one with that number, as G2 or M30. 0: there is none.
[[nodiscard]] int
column_of_word(std::string_view line, char letter, std::optional<double> code = std::nullopt);

/// Column of the first character that is no blank; 0 in an empty line.
[[nodiscard]] int first_column(std::string_view line);

} // namespace millwright::gcode
