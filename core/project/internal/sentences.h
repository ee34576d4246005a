// Notes that are made of several sentences.
#pragma once

#include <string>
#include <string_view>

namespace millwright::project {

/// `text` with `next` behind it, each a sentence of its own; `text` may be empty.
[[nodiscard]] inline std::string with_sentence(std::string text, std::string_view next) {
    if (!text.empty()) {
        text += text.ends_with('.') ? " " : ". ";
    }
    return text.append(next);
}

} // namespace millwright::project
