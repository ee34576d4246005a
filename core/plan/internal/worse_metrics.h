// In which figures one error is larger than another, for people.
#pragma once

#include "core/grid/error_model.h"

#include <string>

namespace millwright::plan {

/// "mean 0.095 against 0.087 mm, axis 9.3 against 4.0 deg" of what is larger in `a`, as far as it is written;
/// "" if nothing is. The axis counts where it `turns`.
[[nodiscard]] std::string worse_metrics(const grid::ErrorSummary& a, const grid::ErrorSummary& b, bool turns);

} // namespace millwright::plan
