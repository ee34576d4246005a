#include "core/base/sentences.h"

#include <utility>

namespace millwright {

bool ends_sentence(std::string_view text) {
    return text.ends_with('.') || text.ends_with('?') || text.ends_with('!');
}

std::string capitalised(std::string text) {
    const std::string_view word = std::string_view(text).substr(0, text.find(' '));
    const bool is_address = !word.empty() && word.find(':') < word.size() - 1;
    if (!is_address && !text.empty() && text.front() >= 'a' && text.front() <= 'z') {
        text.front() = static_cast<char>(text.front() - 'a' + 'A');
    }
    return text;
}

std::string with_full_stop(std::string text) {
    return text.empty() || ends_sentence(text) ? text : text + ".";
}

std::string as_sentence(std::string text) {
    return with_full_stop(capitalised(std::move(text)));
}

std::string with_sentence(std::string text, std::string_view next) {
    if (!text.empty()) {
        text = with_full_stop(std::move(text)) + " ";
    }
    return text.append(next);
}

std::string with_clause(std::string text, std::string_view next) {
    if (!text.empty()) {
        text += ends_sentence(text) ? " " : "; ";
    }
    return text.append(next);
}

} // namespace millwright
