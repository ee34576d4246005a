// Grbl's first pass over a line: characters, numbers, codes and their groups, each refusal with the number of
// Grbl's own error.
#pragma once

#include <string>
#include <string_view>

namespace millwright::gcode::internal {

/// The controller that a program is for.
struct GrblController {
    bool mist = false;                  ///< it was built with M7
    std::string_view axes = "XYZ";      ///< letters
    std::string_view firmware = "Grbl"; ///< or grblHAL, FluidNC
};

/// Throws Refusal for what Grbl 1.1 refuses of `line` before it looks at what the words mean together, and
/// what other firmware has beyond that, since nothing here follows it. Returns the line with blanks for what
/// Grbl reads over (malformed comments, N words, fractions of T, L and the P of G10), in `buffer` if that
/// changes anything; columns stay.
[[nodiscard]] std::string_view
grbl_words(std::string_view line, const GrblController& controller, std::string& buffer);

} // namespace millwright::gcode::internal
