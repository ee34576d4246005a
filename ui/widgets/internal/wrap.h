// Texts of several lines. Dear ImGui also breaks a line behind a point or a comma, in the middle of
// "1450.141".
#pragma once

#include <functional>
#include <string>
#include <string_view>

struct ImFont;

namespace millwright::widgets {

/// `text` with a line end in place of each blank at which it has to be broken to fit into `width`, measured
/// by `width_of`. A word that is longer stays as it is.
[[nodiscard]] std::string
broken_at_blanks(std::string_view text, float width, const std::function<float(std::string_view)>& width_of);

/// The same in a font at its size.
[[nodiscard]] std::string broken_at_blanks(const ImFont* font, std::string_view text, float width);

} // namespace millwright::widgets
