#include "core/program/retract.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::program {

using kinematics::AxisPositions;
using kinematics::AxisSide;
using kinematics::MachineAxis;
using kinematics::MachineModel;

RetractAxis retract_axis(const MachineModel& machine) {
    RetractAxis best;
    double best_alignment = -1.0;
    for (const int n : machine.linear_axes()) {
        const MachineAxis& axis = machine.axis(n);
        const double sense = axis.side == AxisSide::head ? 1.0 : -1.0;
        const double along = sense * axis.direction.dot(machine.description().tool_axis);
        if (std::abs(along) > best_alignment) {
            best_alignment = std::abs(along);
            best = {n, along < 0.0 ? -1.0 : 1.0};
        }
    }
    return best;
}

double safe_position(const MachineModel& machine, const ProgramSettings& settings) {
    if (settings.safe_position) {
        return *settings.safe_position;
    }
    const RetractAxis retract = retract_axis(machine);
    const MachineAxis& axis = machine.axis(retract.axis);
    const double limit = retract.sense > 0.0 ? axis.max : axis.min;
    if (!std::isfinite(limit)) {
        throw Error(fmt::format("axis {} of machine '{}' has no travel limit to retract to",
                                axis.letter,
                                machine.name()),
                    {},
                    "set a safe position for the program");
    }
    return limit;
}

AxisPositions
retracted(const MachineModel& machine, AxisPositions positions, const ProgramSettings& settings) {
    positions[retract_axis(machine).axis] = safe_position(machine, settings);
    return positions;
}

} // namespace millwright::program
