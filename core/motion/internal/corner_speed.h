// The speed through a corner that is not rounded.
#pragma once

#include "core/motion/internal/planned_move.h"

namespace millwright::motion::internal {

/// By the settings' rule for corners; infinite where the way goes straight on.
[[nodiscard]] double corner_speed(const Mechanism& machine,
                                  const PlannerSettings& settings,
                                  const PlannedMove& before,
                                  const PlannedMove& after);

} // namespace millwright::motion::internal
