// What the ranks of a set-up search tell one another: the places that are asked for, and what they cost.
#pragma once

#include "core/toolpath/set_up_search.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::app {

struct CostMessage {
    std::size_t first = 0; ///< index of the first place; the others are as many ranks apart
    std::vector<toolpath::PlaceFigures> figures;
    std::string why_not; ///< nothing more comes: "was stopped", or "failed: ..."
};

/// Never empty. Figures to the last bit.
[[nodiscard]] std::string packed(std::span<const toolpath::SetUpPlace> places);
[[nodiscard]] std::string packed(const CostMessage& message);
/// Throw Error if these are none of our bytes.
[[nodiscard]] std::vector<toolpath::SetUpPlace> unpacked_places(std::string_view bytes);
[[nodiscard]] CostMessage unpacked_costs(std::string_view bytes);

} // namespace millwright::app
