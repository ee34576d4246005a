// The bodies of a machine as solids with broken edges, made from what its file says: one per carrier.
#pragma once

#include "core/geometry/glb.h"
#include "core/geometry/vectors.h"
#include "core/kinematics/machine_model.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace millwright::kinematics {

// The colors that drawn machines and arms share.

inline const Vec3 paint(0.86, 0.87, 0.88), graphite(0.27, 0.29, 0.32), steel(0.60, 0.64, 0.68);

/// What one axis carries, or what stands on the floor: a body named "axis C" or "base", in m with all axes at
/// their physical zero; each of the file's bodies is one of its meshes. Base first, then in the order of
/// MachineModel::axes(); carriers of nothing are left out.
[[nodiscard]] std::vector<geometry::PlacedBody> machine_solids(const MachineModel& machine);

/// The bodies of the glb that `machine_file` names as its "solids", beside it: each is named after its
/// carrier as above, and lies in m with all axes at their physical zero. Null if the file names none. Throws
/// Error naming the file, or the body that no axis of `machine` carries.
[[nodiscard]] std::shared_ptr<const std::vector<geometry::SolidBody>>
read_machine_solids(const std::filesystem::path& machine_file, const MachineModel& machine);

/// Whether the body is the cutter that the file shows: a cylinder on the head side whose lower end is the tip
/// of the machine file's own tool.
[[nodiscard]] bool is_cutter(const MachineModel& machine, const MachineBody& body);

/// The letter of the axis that carries the body, by its name; zero for the base.
[[nodiscard]] char carrier_of(const geometry::SolidBody& body);

} // namespace millwright::kinematics
