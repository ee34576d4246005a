// How well a few typed letters fit a title: "gadp" finds "Grid: adapt".
#pragma once

#include <optional>
#include <string_view>

namespace millwright::widgets {

/// Empty unless every letter of `letters` (blanks aside, case of ASCII ignored) occurs in `text` in that
/// order. Higher is better: starts of words and unbroken runs count more, long texts less. No letters: 0.
[[nodiscard]] std::optional<int> fuzzy_score(std::string_view letters, std::string_view text);

} // namespace millwright::widgets
