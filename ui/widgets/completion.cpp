#include "ui/widgets/completion.h"

#include "ui/widgets/internal/letters.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace millwright::widgets {

namespace {

std::size_t common(std::string_view a, std::string_view b) {
    const auto end = std::ranges::mismatch(a, b, same_letter);
    return static_cast<std::size_t>(end.in1 - a.begin());
}

/// Of what is longer than `text` and begins with it, the best one first; nothing if there is none.
std::optional<std::string> grown(std::string_view text, const std::vector<std::string_view>& candidates) {
    std::optional<std::string_view> first;
    std::size_t agreed = 0;
    for (const std::string_view candidate : candidates) {
        if (candidate.size() <= text.size() || common(candidate, text) < text.size()) {
            continue;
        }
        agreed = first ? std::min(agreed, common(*first, candidate)) : candidate.size();
        first = first ? first : candidate;
    }
    if (!first) {
        return std::nullopt;
    }
    return std::string(first->substr(0, agreed > text.size() ? agreed : first->size()));
}

} // namespace

std::string completed(std::string_view text,
                      std::span<const std::string> history,
                      std::span<const std::string_view> words) {
    const std::vector<std::string_view> newest_first(history.rbegin(), history.rend());
    if (auto line = grown(text, newest_first)) {
        return *line;
    }
    const std::size_t blank = text.find_last_of(' ');
    const std::size_t begin = blank == std::string_view::npos ? 0 : blank + 1;
    const auto word = grown(text.substr(begin), {words.begin(), words.end()});
    return std::string(text.substr(0, begin)) + word.value_or(std::string(text.substr(begin)));
}

} // namespace millwright::widgets
