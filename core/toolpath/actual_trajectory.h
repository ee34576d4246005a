// What the tool really does between two poses: the machine interpolates its axes linearly, the part sees a
// curve. Source: Parasilmongkol 1997, ch. 3.4: M(t), A(t), B(t) linear in t, W(t) = inverse map of them.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/toolpath.h"

#include <optional>
#include <string>
#include <vector>

namespace millwright::toolpath {

/// The tool pose on the part at t in [0,1] of the move from `a` to `b`.
[[nodiscard]] geometry::ToolPose actual_pose(const kinematics::MachineModel& machine,
                                             const kinematics::AxisPositions& a,
                                             const kinematics::AxisPositions& b,
                                             double t);

/// Poses at `count` equal steps, both ends included. Throws Defect if count < 2.
[[nodiscard]] std::vector<geometry::ToolPose> actual_poses(const kinematics::MachineModel& machine,
                                                           const kinematics::AxisPositions& a,
                                                           const kinematics::AxisPositions& b,
                                                           int count);

// The surface that the machine makes: the true tracks of the tool, joined by straight lines from track to
// track. Source: Parasilmongkol 1997, ch. 3 eqs 10 and 11 (corrected), which take the middle of each move.

/// Points T of the produced surface, mm: row `t` lies on track t, the columns run along it, in the direction
/// of growing node numbers on every track.
struct ProducedSurface {
    int tracks = 0;
    int places = 0;           ///< along each track: moves * steps + 1
    std::vector<Vec3> points; ///< [tracks x places]

    [[nodiscard]] const Vec3& at(int track, int place) const {
        return points[static_cast<std::size_t>(track) * static_cast<std::size_t>(places) +
                      static_cast<std::size_t>(place)];
    }
};

/// Why `path` has no produced surface, as a sentence without its full stop; empty: it has one. It needs
/// tracks of equally many moves side by side, which a spiral, a path with added points and a trimmed patch do
/// not have, and a tool that is a point: the tip of a cutter is not where it cuts.
[[nodiscard]] std::string why_no_produced_surface(const Toolpath& path);

/// `steps` places per move (an even number has its middle among them) of the path that `axes` follow. Nothing
/// where why_no_produced_surface() has a reason. Throws Defect for less than one step.
[[nodiscard]] std::optional<ProducedSurface> produced_surface(const kinematics::MachineModel& machine,
                                                              const Toolpath& path,
                                                              const AxisPath& axes,
                                                              int steps);

} // namespace millwright::toolpath
