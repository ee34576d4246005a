// The norm of every iteration of the elliptic grid or the harmonic map, as a plot of the Grid workspace.
#pragma once

#include "core/grid/grid_optimiser.h"
#include "ui/widgets/ui.h"

#include <vector>

namespace millwright::panels {

/// Draws nothing without iterations. Iterations that have no norm leave a gap.
void norm_plot(widgets::Ui& ui, const std::vector<grid::IterationNorm>& norms);

} // namespace millwright::panels
