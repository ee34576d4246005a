// Numbers as a PMAC tells them.
#pragma once

#include <optional>
#include <string_view>

namespace millwright::pmac::internal {

/// Decimal, or "$C003" in hexadecimal; nothing for anything else, and for numbers beyond 1e12.
[[nodiscard]] std::optional<double> card_number(std::string_view text);

} // namespace millwright::pmac::internal
