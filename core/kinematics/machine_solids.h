// The bodies of a machine as solids with broken edges, made from what its file says: one a carrier.
#pragma once

#include "core/geometry/glb.h"
#include "core/kinematics/machine_model.h"

#include <vector>

namespace millwright::kinematics {

/// What one axis carries, or what stands on the floor: a body named "axis C" or "base", in m with all axes at
/// their physical zero; each of the file's bodies is one of its meshes. Base first, then in the order of
/// MachineModel::axes(); carriers of nothing are left out.
[[nodiscard]] std::vector<geometry::PlacedBody> machine_solids(const MachineModel& machine);

} // namespace millwright::kinematics
