// Typed letters matched with words: completion as in a shell, and how well a few letters fit a title.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace millwright::widgets {

// Letters compared without regard to case. ASCII only: the same in every locale.

[[nodiscard]] constexpr char lower_case(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

[[nodiscard]] constexpr bool same_letter(char a, char b) {
    return lower_case(a) == lower_case(b);
}

// Completing a line that is being typed, as a shell does.

/// `text` made longer as far as all lines of `history` (oldest first) that begin with it agree; where that
/// adds nothing the newest of them. Where none begins so, the word behind the last blank is completed
/// likewise from `words`, in their order. Case does not matter. `text` itself if there is nothing.
[[nodiscard]] std::string completed(std::string_view text,
                                    std::span<const std::string> history,
                                    std::span<const std::string_view> words);

// How well a few typed letters fit a title: "gadp" finds "Grid: adapt".

/// Empty unless every letter of `letters` (blanks aside, case of ASCII ignored) occurs in `text` in that
/// order. Higher is better: starts of words and unbroken runs count more, long texts less. No letters: 0.
[[nodiscard]] std::optional<int> fuzzy_score(std::string_view letters, std::string_view text);

} // namespace millwright::widgets
