#include "ui/widgets/fuzzy.h"

#include "ui/widgets/internal/letters.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace millwright::widgets {

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
