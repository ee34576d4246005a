// How the writing of a text falls into the steps that undo takes back: words, runs of erasing, what was
// pasted.
#pragma once

#include <cstddef>
#include <string_view>

namespace millwright::widgets {

/// What differs between two texts, in bytes, on borders of UTF-8 letters.
struct TextDifference {
    std::size_t at = 0;       ///< where both begin to differ
    std::size_t removed = 0;  ///< of the first one
    std::size_t inserted = 0; ///< of the second one
};

[[nodiscard]] TextDifference difference(std::string_view before, std::string_view after);

/// The writing of a text, key by key.
class TextSteps {
public:
    /// Whether the change begins a step: a word after a blank, a new line, a pasted piece, erasing after
    /// typing, or either of them at another place. `caret_before` and `caret_after` are byte offsets.
    [[nodiscard]] bool
    begins(std::string_view before, std::string_view after, int caret_before, int caret_after);
    /// What comes next begins a step.
    void end() { kind_ = Kind::none; }

private:
    enum class Kind { none, typed, erased, piece };
    [[nodiscard]] static Kind kind_of(std::string_view before, std::string_view after);

    Kind kind_ = Kind::none;
    int caret_ = -1; ///< behind the last change
};

} // namespace millwright::widgets
