// Numbers as text, the one place where that happens: the same bytes on every machine and locale. What editors
// put in front of text.
#pragma once

#include <string>
#include <string_view>

namespace millwright {

/// `text` without the byte order mark of UTF-8 at its beginning, which editors of some systems write.
[[nodiscard]] inline std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    text.remove_prefix(text.starts_with(mark) ? mark.size() : 0);
    return text;
}

/// "UTF-16" or "UTF-32" if `text` begins as such text does: with its byte order mark, or with the zero bytes
/// beside its first two letters; else empty.
[[nodiscard]] std::string_view wide_encoding(std::string_view text);

/// `value` with exactly `decimals` digits after the point, never "-0.000". Throws Defect if not finite.
[[nodiscard]] std::string fixed(double value, int decimals);

/// The shortest text that reads back as the same double. Throws Defect if not finite.
[[nodiscard]] std::string shortest(double value);

/// hh:mm:ss of a duration, rounded up to a whole second.
[[nodiscard]] std::string clock_time(double seconds);
/// The same from a minute on; a shorter one as "0.16 s".
[[nodiscard]] std::string short_time(double seconds);

} // namespace millwright
