#include "core/base/error.h"

#include <fmt/format.h>

namespace millwright {

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
    return text;
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
