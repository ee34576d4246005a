// Numbers as text, the one place where that happens: the same bytes on every machine and locale. What editors
// put in front of text.
#pragma once

#include "core/base/error.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace millwright {

/// `text` without the byte order mark of UTF-8 at its beginning, which editors of some systems write.
[[nodiscard]] inline std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    text.remove_prefix(text.starts_with(mark) ? mark.size() : 0);
    return text;
}

/// "UTF-16" or "UTF-32" if `bytes` are text in it, with its byte order mark or without: then each plain
/// letter has zero bytes on one side. Empty if they are not.
[[nodiscard]] std::string_view wide_encoding(std::string_view bytes);

/// What is wrong with `file`, at its first line, if `bytes` are text in UTF-16 or UTF-32: its zero bytes
/// would end every number after one digit.
[[nodiscard]] std::optional<Diagnostic> wide_text_fault(std::string_view bytes,
                                                        const std::filesystem::path& file);
/// Throws Error with it if there is one.
void refuse_wide_text(std::string_view bytes, const std::filesystem::path& file);

/// `value` with exactly `decimals` digits after the point, never "-0.000". Throws Defect if not finite.
[[nodiscard]] std::string fixed(double value, int decimals);

/// The shortest text that reads back as the same double. Throws Defect if not finite.
[[nodiscard]] std::string shortest(double value);

/// hh:mm:ss of a duration, rounded up to a whole second.
[[nodiscard]] std::string clock_time(double seconds);
/// The same from a minute on; a shorter one as "0.16 s".
[[nodiscard]] std::string short_time(double seconds);

} // namespace millwright
