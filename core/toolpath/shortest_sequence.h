// The branch and turn of every path point chosen for the whole path at once. The layers of a graph are the
// path points, the places of a layer all axis positions that reach its pose: every branch of the inverse
// kinematics in every turn inside the axes' limits. The least sum of moves from layer to layer is a shortest
// path (Bellman 1957), so no other choice costs less. One point after another (sequence) does not see a limit
// that comes.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/parametric_surface.h"
#include "core/grid/track_path.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/toolpath.h"

#include <functional>
#include <vector>

namespace millwright::toolpath {

// What a move of the machine's axes costs, by which the branches and turns along a path are chosen. The axes
// go linearly from one position to the next, so the cost of a move is a function of its two ends alone.

/// Not negative; infinity where the move must not be made. The same for both ends moved by whole turns.
using StepCost =
    std::function<double(const kinematics::AxisPositions& from, const kinematics::AxisPositions& to)>;

/// The cost of moves from path point n - 1 to path point n >= 1. Callable from several threads.
using StepCosts = std::function<StepCost(std::size_t n)>;

/// sum over the axes of weight |travel|. `weights`: one per axis in the order of MachineModel::axes(), not
/// negative; if empty 1 for each rotary axis (rad) and 0 for the others, which is AxisPath::rotary_travel.
[[nodiscard]] StepCosts travel_costs(const kinematics::MachineModel& machine,
                                     std::vector<double> weights = {});

/// s: the axis that takes longest at its largest velocity, but not faster than `feed` (mm/s) of the tip along
/// the straight move.
[[nodiscard]] StepCosts
time_costs(const kinematics::MachineModel& machine, const Toolpath& toolpath, double feed);

/// `cost` of the error that the move will have, as the grid's optimisers measure it: of the true tip from the
/// way that the path's tool should take between the points, of the true tool axis from the one that it should
/// have there. Copies what it needs, and keeps patch.shared().
[[nodiscard]] StepCosts error_costs(const geometry::ParametricSurface& patch,
                                    const kinematics::MachineModel& machine,
                                    const Toolpath& toolpath,
                                    const grid::MoveCost& cost,
                                    grid::Sampling sampling);

/// Of each path point all axis positions that reach it inside the limits. Axes without limits are given in
/// the turn nearest to zero alone: what a move to them costs does not depend on it. On a pole, where one
/// angle is free, with the angles of the nearest points off it before and after on the same track, zero if
/// there are none: the way to a track turns the axis, no cut. Throws Error as `sequence` does.
[[nodiscard]] std::vector<std::vector<kinematics::AxisPositions>>
feasible_rotations(const kinematics::MachineModel& machine, const Toolpath& toolpath);

/// A cost as good as equal is decided by rotary travel: what one rad counts beside the cost of a move.
inline constexpr double tie_break = 1e-9;

/// The sum over the moves of `costs` + tie_break rotary travel; of the moves from track to track `link_share`
/// of the cost alone, 0 to 1: 0 where they are made off the part and cost nothing.
[[nodiscard]] double cost_of(const kinematics::MachineModel& machine,
                             const Toolpath& toolpath,
                             const AxisPath& axes,
                             const StepCosts& costs,
                             double link_share);

/// The axis positions with the least cost_of; of equal paths the one that begins nearest to the axes' zero.
/// Parallel over moves; the same bytes on any number of threads. Throws Error as `sequence` does, and where
/// every move between two points costs infinity; Cancelled.
[[nodiscard]] AxisPath shortest_sequence(const kinematics::MachineModel& machine,
                                         const Toolpath& toolpath,
                                         const StepCosts& costs,
                                         double link_share,
                                         const Progress& progress);

/// The largest travel of one rotary axis in one move of a kind, rad.
[[nodiscard]] double largest_rotary_step(const kinematics::MachineModel& machine,
                                         const Toolpath& toolpath,
                                         const AxisPath& axes,
                                         MoveKind kind);

} // namespace millwright::toolpath
