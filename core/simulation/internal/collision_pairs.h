// Which bodies may not meet.
#pragma once

#include "core/simulation/collision.h"
#include "core/simulation/internal/collision_pair.h"

#include <string>
#include <vector>

namespace millwright::simulation {

/// Pairs with the same motion follow each other. What is left out is added to `unchecked`, a sentence each.
[[nodiscard]] std::vector<CollisionPair> pairs_of(const kinematics::MachineModel& machine,
                                                  const CollisionTool& tool,
                                                  const CollisionInput& input,
                                                  std::vector<std::string>& unchecked);

} // namespace millwright::simulation
