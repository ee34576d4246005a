// A number with what it counts, in the singular or the plural.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace millwright {

/// "1 point", "2 points"; `many`: the plural where it is not `one` with an s.
template <std::integral Count>
[[nodiscard]] std::string counted(Count count, std::string_view one, std::string_view many = {}) {
    std::string text = std::to_string(count) + " ";
    if (count == 1) {
        return text.append(one);
    }
    return many.empty() ? text.append(one).append("s") : text.append(many);
}

} // namespace millwright
