// The bodies of a machine and what stands on its table, as meshes that can collide. Lengths mm, frame m with
// all axes at their physical zero (core/kinematics/machine_model.h).
#pragma once

#include "core/base/progress.h"
#include "core/geometry/solid.h"
#include "core/kinematics/machine_model.h"
#include "core/simulation/collision_mesh.h"
#include "core/simulation/stock.h"
#include "core/toolpath/profile.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace millwright::simulation {

enum class BodyRole {
    machine,
    fixture,
    part,      ///< its whole surface: tools may touch it, nothing else
    cut_faces, ///< of the part, that are looked at elsewhere: the cutter is not compared with them
    stock      ///< uncut: tools may be in it
};

struct CollisionBody {
    std::string name; ///< for people: "axis Z", "fixture vise.stl"
    BodyRole role = BodyRole::machine;
    char carrier = '\0';                       ///< letter of an axis; '\0': the base
    std::shared_ptr<const CollisionMesh> mesh; ///< in m
    bool closed = true;                        ///< the mesh encloses its inside
};

/// One body a carrier, named after it. `solids` as of read_machine_solids(), as the window draws them; empty:
/// the simple bodies of the machine file without the cutter that it shows.
[[nodiscard]] std::vector<CollisionBody>
machine_collision_bodies(const kinematics::MachineModel& machine,
                         std::span<const geometry::SolidBody> solids);

/// Something on the table, in workpiece coordinates.
[[nodiscard]] CollisionBody collision_body(const kinematics::MachineModel& machine,
                                           std::string name,
                                           BodyRole role,
                                           CollisionTriangles triangles,
                                           bool closed);

/// The surface of an uncut stock. Cylinders have `facets` sides, around the round surface.
[[nodiscard]] CollisionTriangles surface_of(const Stock& stock, int facets = 180);

/// The surface of a tool at its physical zero, with so many sides.
[[nodiscard]] CollisionTriangles
surface_of(const toolpath::Profile& body, const geometry::ToolPose& pose, int facets);

/// A fixture stands on what carries it. Throws Error, naming it with the place and the depth, if it lies
/// deeper than 0.05 mm in it, or is inside of it as a whole.
void expect_on_table(const CollisionBody& fixture,
                     std::span<const CollisionBody> machine_bodies,
                     const kinematics::MachineModel& machine);

} // namespace millwright::simulation
