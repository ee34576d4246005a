// Collisions along a program: what of tool, machine, fixtures and part meets that may not, found along the
// motion of all axes and not at samples of it. docs/reference/simulation.md. Lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/kinematics/machine_model.h"
#include "core/program/program.h"
#include "core/simulation/collision_bodies.h"
#include "core/simulation/simulation.h"
#include "core/toolpath/profile.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::simulation {

/// Bodies that reach less deep into each other only touch.
inline constexpr double touch_depth = 1e-3; // mm

/// What is in the spindle from a block on.
struct CollisionTool {
    int first_block = 0;
    std::optional<toolpath::Profile> cutter{}; ///< the part that cuts
    std::optional<toolpath::Profile> shank{};  ///< above it, does not cut
    std::optional<toolpath::Profile> holder{};
    std::shared_ptr<const kinematics::MachineModel>
        machine{}; ///< with its gauge length; null: that of the input
};

struct CollisionInput {
    const program::Program& program;
    const kinematics::MachineModel& machine; ///< its part coordinates are those of the places
    std::vector<CollisionTool> tools; ///< in the order of the blocks; before the first there is nothing
    std::vector<CollisionBody> bodies;
    int first_block = 0;          ///< where all axes are known
    double clearance = 0.0;       ///< pairs that come nearer without contact are near misses; 0: none
    double part_allowance = 0.01; ///< cutter and shank may reach so deep into the part
    /// What cuts the stock, by the same program: bodies are then compared with what is left of it before each
    /// block. Null: with the uncut stock.
    const SimulationInput* removal = nullptr;
};

/// Two bodies that meet, or come near, through one move or through several without another between them.
struct Collision {
    std::string moving, still;
    int block = 0, line = 0; ///< of the first contact, or of the nearest place; line 0: unknown
    double time = 0.0;       ///< fraction of that move, 0 to 1
    bool rapid = false;
    Vec3 place = Vec3::Zero(); ///< there, in workpiece coordinates
    double depth = 0.0;        ///< the largest that was found; of a near miss the least distance
    int deepest_block = 0, deepest_line = 0; ///< where that is
    int last_line = 0;
    int moves = 1;
};

/// An axis beyond its limits at the end of a move, through one move or several.
struct LimitViolation {
    char axis = 'X';
    int block = 0, line = 0, last_line = 0;
    double position = 0.0, limit = 0.0; ///< the farthest; mm, rotary axes rad
    int moves = 1;
};

struct CollisionReport {
    std::vector<Collision> collisions;  ///< in the order of the blocks
    std::vector<Collision> near_misses; ///< of pairs on moves that do not meet on them
    std::vector<LimitViolation> limits;
    std::vector<std::string> unchecked; ///< pairs, and what else was not looked at, a sentence each
    int pairs = 0;                      ///< that were looked at
    int moves = 0;
};

/// Throws Cancelled, and with `removal` as simulate().
[[nodiscard]] CollisionReport check_collisions(const CollisionInput& input, const Progress& progress);

} // namespace millwright::simulation
