#include "ui/widgets/matching.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
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

namespace {

constexpr int for_letter = 4;
constexpr int for_word_start = 12;
constexpr int for_run = 8; // the letter before was the one typed before
constexpr int for_first = 6;
constexpr int none = std::numeric_limits<int>::min() / 2;

bool is_space_or_tab(char c) {
    return c == ' ' || c == '\t';
}

bool starts_word(std::string_view text, std::size_t i) {
    constexpr std::string_view between = " \t:/._-()&,";
    return i == 0 || between.find(text[i - 1]) != std::string_view::npos;
}

std::string without_blanks(std::string_view letters) {
    std::string kept;
    std::copy_if(
        letters.begin(), letters.end(), std::back_inserter(kept), [](char c) { return !is_space_or_tab(c); });
    return kept;
}

int score_at(std::string_view text, std::size_t i) {
    return for_letter + (starts_word(text, i) ? for_word_start : 0) + (i == 0 ? for_first : 0);
}

} // namespace

// The best of all ways to lay the letters on the text: best[i] is the best score with the current letter at
// i.
std::optional<int> fuzzy_score(std::string_view letters, std::string_view text) {
    const std::string wanted = without_blanks(letters);
    if (wanted.empty()) {
        return 0;
    }
    std::vector<int> before(text.size(), none);
    std::vector<int> best(text.size(), none);
    for (std::size_t n = 0; n < wanted.size(); ++n) {
        int best_earlier = none; // of the letter before, anywhere left of i
        for (std::size_t i = 0; i < text.size(); ++i) {
            const int run = i > 0 && n > 0 ? before[i - 1] + for_run : none;
            const int reached = n == 0 ? 0 : std::max(best_earlier, run);
            const bool fits = lower_case(text[i]) == lower_case(wanted[n]) && reached > none / 2;
            best[i] = fits ? reached + score_at(text, i) : none;
            best_earlier = std::max(best_earlier, before[i]);
        }
        std::swap(before, best);
    }
    const auto top = std::max_element(before.begin(), before.end());
    if (top == before.end() || *top <= none / 2) {
        return std::nullopt;
    }
    return *top - static_cast<int>(text.size()) / 8;
}

} // namespace millwright::widgets
