// A line of G-code reduced to what a controller executes, for callers that look for codes in it.
#pragma once

#include <string>
#include <string_view>

namespace millwright::drivers {

/// Without comments, blanks and line number, in capitals.
[[nodiscard]] std::string stripped_line(std::string_view line);

/// Whether a bare line has the code, as "M2" or "G53", and not just one that begins like it.
[[nodiscard]] bool has_code(std::string_view stripped_line, std::string_view code);

/// Whether a bare line belongs to a subroutine, loop or call.
[[nodiscard]] bool is_flow(std::string_view stripped_line);

} // namespace millwright::drivers
