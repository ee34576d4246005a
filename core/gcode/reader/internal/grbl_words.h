// Grbl's first pass over a line: characters, numbers, codes and their groups, each refusal with the number of
// Grbl's own error.
#pragma once

#include <string>
#include <string_view>

namespace millwright::gcode::internal {

/// Throws Refusal for what Grbl 1.1 refuses of `line` before it looks at what the words mean together;
/// `mist`: it was built with M7. Returns the line with blanks for what Grbl reads over (malformed comments, N
/// words, fractions of T, L and the P of G10), in `buffer` if that changes anything; columns stay.
[[nodiscard]] std::string_view grbl_words(std::string_view line, bool mist, std::string& buffer);

} // namespace millwright::gcode::internal
