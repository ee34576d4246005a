// What a link of the whole chain brought, as a line of the Grid workspace.
#pragma once

#include "core/grid/grid_optimiser.h"

#include <string>

namespace millwright::panels {

/// "0.448 / 0.260 / 15.2" of the best grid after it: largest / mean, mm / largest axis deviation, deg; "-" in
/// place of that on a machine that cannot turn the tool.
[[nodiscard]] std::string stage_figures(const grid::ChainStage& stage, bool turns);

/// How its nodes stood at its end, and why they were not taken where they were not, as a sentence.
[[nodiscard]] std::string stage_tip(const grid::ChainStage& stage, bool turns);

} // namespace millwright::panels
