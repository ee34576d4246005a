// Finishing a mesh of triangles as it is: parallel passes of a cutter that rests on the triangles, and passes
// across them where they would leave too much on steep places. docs/reference/meshes.md. Lengths mm, angles
// rad.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/triangle_mesh.h"
#include "core/geometry/tool_pose.h"
#include "core/mesh_finish/drop_tree.h"
#include "core/toolpath/profile.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace millwright::mesh_finish {

/// A cylinder that begins `tool_length` behind the tip.
struct FinishHolder {
    double radius = 0.0;
    double tool_length = 0.0;
};

struct FinishSettings {
    Vec3 axis = Vec3::UnitZ(); ///< unit, from the tip towards the spindle, on the part
    double direction = 0.0;    ///< of the passes in the plane square to the axis, from the part's X
    double step_over = 0.5;    ///< between neighbouring passes, seen along the axis
    double tolerance = 0.005;  ///< by which a move may bite into the mesh
    double overrun = 0.0;      ///< of the tool's axis beyond the mesh's box, seen along the axis
    bool across = true;        ///< with passes square to the first ones on steep places
    bool between = true; ///< with passes between two others where the way dips, of a cutter with a corner
    double link_clearance = 2.0; ///< of links above the mesh and the material over it
    /// Thickness of the material around the mesh. Nullopt: not known, and no move but straight up is fast
    /// that is not above the whole mesh.
    std::optional<double> allowance{};
    std::optional<FinishHolder> holder{}; ///< links are above the mesh with it, too
};

/// Of parallel passes with the step between them that leaves no ridge higher than `scallop` where a cutter of
/// that corner radius fits, on slopes and along inner edges, too, with passes across and between. Throws
/// Defect unless both are above 0.
[[nodiscard]] double step_for_scallop(double corner_radius, double scallop);

struct FinishPass {
    std::vector<Vec3> tips;     ///< on the part
    std::vector<Vec3> contacts; ///< one per tip
    bool is_across = false;
    /// Of the tip from the pass before to this one, at least link_clearance above mesh and allowance: how far
    /// along the axis from the part's origin. Of the first pass the one above its own beginning.
    double link_level = 0.0;
    double plunge_level = 0.0; ///< from where on the tool comes down at the plunge rate, as link_level
};

struct FinishPath {
    Vec3 axis = Vec3::UnitZ();
    std::vector<FinishPass> passes; ///< in their order
    double safe_level = 0.0;        ///< above mesh and allowance, along the axis from the part's origin
    bool knows_material = false;    ///< with an allowance; else only moves up are fast below the safe level
    std::int64_t drops = 0;         ///< points at which the cutter was lowered and kept before thinning
};

/// The rotation from part coordinates to those of the passes: +Z along the axis, +X along the first passes.
[[nodiscard]] Mat3 pass_frame(const Vec3& axis, double direction);

/// `mesh` in the coordinates of the passes.
[[nodiscard]] DropTree drop_tree(const exchange::TriangleMesh& mesh,
                                 const std::vector<std::uint8_t>& open_edges,
                                 const Mat3& frame,
                                 const Progress& progress);

/// `tree` is that of the settings' pass_frame. The same on any number of threads. Throws Error for settings
/// out of range, passes of more points than fit into memory, or a mesh that the passes do not meet;
/// Cancelled.
[[nodiscard]] FinishPath finish(const DropTree& tree,
                                const CutterOutline& cutter,
                                const FinishSettings& settings,
                                const Progress& progress);

/// How far the holder has to stay behind the tip on the path, so that it touches the mesh nowhere: the least
/// length of the cutter from tip to holder, mm, with the place of the tip. Nothing where it never comes near.
/// Links, which are higher for a shorter cutter, count where the holder touches on them.
struct HolderReach {
    double length = 0.0;
    Vec3 tip = Vec3::Zero();
};
[[nodiscard]] std::optional<HolderReach> holder_reach(const DropTree& tree,
                                                      const Mat3& frame,
                                                      const FinishPath& path,
                                                      const FinishHolder& holder,
                                                      const Progress& progress);

} // namespace millwright::mesh_finish
