// What a move of the machine's axes costs, by which the branches and turns along a path are chosen. The axes
// go linearly from one position to the next, so the cost of a move is a function of its two ends alone.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/grid/move_cost.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/toolpath.h"

#include <functional>
#include <vector>

namespace millwright::toolpath {

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

} // namespace millwright::toolpath
