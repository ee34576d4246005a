#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace millwright {

namespace {

/// Bytes of the UTF-8 character at the front of `text`; 0 if there is none or it controls a terminal.
std::size_t printable_length(std::string_view text) {
    const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
    constexpr unsigned char del = 0x7f;
    if (byte(0) < 0x80) {
        return byte(0) >= ' ' && byte(0) != del ? 1 : 0;
    }
    const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : byte(0) >= 0xc2 ? 2 : 0;
    if (length == 0 || length > text.size() || byte(0) > 0xf4 || (byte(0) == 0xc2 && byte(1) < 0xa0)) {
        return 0;
    }
    for (std::size_t n = 1; n < length; ++n) {
        if ((byte(n) & 0xc0U) != 0x80U) {
            return 0;
        }
    }
    return length;
}

} // namespace

std::string printable(std::string_view text) {
    std::string made;
    while (!text.empty()) {
        const std::size_t length = printable_length(text);
        if (length > 0 || text.front() == '\n') {
            made += text.substr(0, std::max<std::size_t>(length, 1));
        } else {
            made += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return made;
}

std::string to_text(const Diagnostic& diagnostic) {
    const Place& place = diagnostic.place;
    std::string text = place.file.string();
    if (place.line > 0) {
        text += fmt::format(":{}", place.line);
    }
    if (place.column > 0) {
        text += fmt::format(":{}", place.column);
    }
    if (place.byte >= 0) {
        text += fmt::format(" byte {}", place.byte);
    }
    if (!text.empty()) {
        text += ": ";
    }
    text += diagnostic.message;
    if (!diagnostic.hint.empty()) {
        text += fmt::format(" ({})", diagnostic.hint);
    }
    return printable(text);
}

Error::Error(Diagnostic found) : std::runtime_error(to_text(found)), diagnostic_(std::move(found)) {}

Error::Error(std::string message, std::filesystem::path file, std::string hint)
    : Error(Diagnostic{{std::move(file), 0, 0, -1}, std::move(message), std::move(hint)}) {}

void expects(bool promise, std::string_view sentence, const char* file, int line) {
    if (!promise) {
        throw Defect(fmt::format("{}:{}: broken promise: {}", file, line, sentence));
    }
}

} // namespace millwright
