// A best place of the part at the edge of what was searched is none to rely on: farther out may be better.
#pragma once

#include "core/toolpath/set_up_search.h"

#include <array>
#include <string>
#include <string_view>

namespace millwright::plan {

/// Says of which parameters the best place lies at the edge of `within`, each with its name in `reach_names`
/// (a, b, c, turn) of what limits it; empty where it does not, or where the start is the best.
[[nodiscard]] std::string edge_sentence(const toolpath::SetUpSearch& search,
                                        const toolpath::SetUpSearchSettings& within,
                                        const std::array<std::string_view, 4>& reach_names);

} // namespace millwright::plan
