// The stage in which the file of a plot or a picture is read.
#pragma once

#include "core/plan/internal/plot_stages.h"

namespace millwright::plan {

[[nodiscard]] bool same_reading(const PlotSource& then, const PlotSource& now);
/// What the file has, whatever kind it is. Throws Error or Cancelled.
void make_reading(const PlotStageWork& work);
void clear_reading(PlotResult& result, PlotParts& parts);

} // namespace millwright::plan
