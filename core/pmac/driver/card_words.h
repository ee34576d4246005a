// How a PMAC reads a line: blanks mean nothing, letters have no case, and of its words the longest that fits
// is meant, so that STOPENDIF is STOP ENDIF.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac {

struct CardWord {
    std::string_view full, brief; ///< LINEAR, LIN
    std::size_t length = 0;       ///< of the form that stands there
};

/// At the front of `text`, which has no blanks and no small letters; nothing: a letter, a number or a sign.
[[nodiscard]] std::optional<CardWord> card_word(std::string_view text);

/// A word, a number, quoted text or a single character in a line.
struct PlacedWord {
    std::string text;               ///< upper case without blanks; words in their long form
    std::size_t begin = 0, end = 0; ///< its place in the line
};

/// What a line consists of. Quotation marks belong to what is quoted.
[[nodiscard]] std::vector<PlacedWord> placed_words(std::string_view line);

} // namespace millwright::pmac
