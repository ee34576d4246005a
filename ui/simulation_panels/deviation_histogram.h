// The deviations of a simulated part as bars over their height, in the colours of the view.
#pragma once

#include "core/simulation/deviation_histogram.h"
#include "ui/widgets/ui.h"

namespace millwright::panels {

/// One bar a bin; nothing without a bin.
void deviation_histogram(widgets::Ui& ui, const simulation::DeviationHistogram& histogram, double tolerance);

} // namespace millwright::panels
