// OPEN, CLOSE and CLEAR within a line. A card reads a line word by word, and what stands between OPEN and
// CLOSE is stored, on one line as on several.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac::internal {

/// The parts of `line`: each OPEN with its arguments, CLOSE and CLEAR is one, in its long form and upper
/// case. Blanks within these words and quoted text are treated as the card treats them. A line without such a
/// word is its only part.
[[nodiscard]] std::vector<std::string> split_at_buffer_words(std::string_view line);

/// The parts of all `lines`.
[[nodiscard]] std::vector<std::string> split_at_buffer_words(const std::vector<std::string>& lines);

/// Whether `line` has an OPEN, CLOSE or CLEAR.
[[nodiscard]] bool has_buffer_word(std::string_view line);

/// The message for a `line` between OPEN and CLOSE that acts_at_once(), and its hint.
[[nodiscard]] std::string at_once_message(std::string_view line);
inline constexpr const char* at_once_hint = "send it after CLOSE; a PLC program sends commands by CMD\"...\"";

/// The message and the hint for `line`, which opens a buffer while the one that `open` opened is not closed.
[[nodiscard]] std::string second_open_message(std::string_view line);
[[nodiscard]] std::string second_open_hint(std::string_view open);

} // namespace millwright::pmac::internal
