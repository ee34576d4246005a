// Completing a line that is being typed, as a shell does.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace millwright::widgets {

/// `text` made longer as far as all lines of `history` (oldest first) that begin with it agree; where that
/// adds nothing the newest of them. Where none begins so, the word behind the last blank is completed
/// likewise from `words`, in their order. Case does not matter. `text` itself if there is nothing.
[[nodiscard]] std::string completed(std::string_view text,
                                    std::span<const std::string> history,
                                    std::span<const std::string_view> words);

} // namespace millwright::widgets
