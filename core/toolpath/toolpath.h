// From a grid to the poses of the cutter on the part, and from there to what the machine really does:
// strategies (zigzag), the cutter and how it leans, the branch of every pose (sequencing), the actual
// trajectory between poses, the error field, the machine's singular points on the surface. Without a cutter
// the tool is a point at the end of an axis along the surface normal (Parasilmongkol 1997, ch. 3), so that
// the cutter location is the cutter contact point.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/grid/grid.h"
#include "core/toolpath/tool.h"

#include <vector>

namespace millwright::toolpath {

/// How a path point is reached from the one before.
enum class MoveKind {
    start, ///< the first point: reached by an approach
    track, ///< inside a track: cuts
    cross, ///< from the end of a track to the start of the next
    over,  ///< over a part of the patch that does not belong to the design: always lifted
};

/// Where a path point comes from.
struct GridOrigin {
    int i = 0, j = 0;       ///< grid node; of a point of its own the track and its number there, as in a grid
    Vec2 uv = Vec2::Zero(); ///< its parameters
};

struct PathPoint {
    geometry::ToolPose pose;
    MoveKind reached_by = MoveKind::track;
    GridOrigin origin;
    Vec3 contact = Vec3::Zero(); ///< where the tool touches the surface
    Vec3 normal = Vec3::UnitZ(); ///< of the surface there, unit, on the side of the tool
};

struct Toolpath {
    grid::TrackDirection direction = grid::TrackDirection::along_v;
    Tool tool = {};                ///< that the poses are of
    std::vector<PathPoint> points; ///< one more than moves
};

/// The node of the numbers `track` and `node` along it, and back: its track.
[[nodiscard]] GridOrigin origin_at(grid::TrackDirection direction, int track, int node, const Vec2& uv);
[[nodiscard]] int track_of(grid::TrackDirection direction, const GridOrigin& origin);

/// Length of the path with straight moves, without those that go over what is not cut, mm.
[[nodiscard]] double length(const Toolpath& toolpath);

} // namespace millwright::toolpath
