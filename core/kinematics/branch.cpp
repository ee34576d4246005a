#include "core/kinematics/branch.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>

namespace millwright::kinematics {

double rotary_travel(const MachineModel& machine, const AxisPositions& a, const AxisPositions& b) {
    double travel = 0.0;
    for (const int n : machine.rotary_axes()) {
        travel += std::abs(b[n] - a[n]);
    }
    return travel;
}

const AxisPositions& nearest_branch(const MachineModel& machine,
                                    std::span<const AxisPositions> branches,
                                    const AxisPositions& previous) {
    expects(!branches.empty(), "there is at least one branch to choose");
    return *std::min_element(
        branches.begin(), branches.end(), [&](const AxisPositions& a, const AxisPositions& b) {
            return rotary_travel(machine, previous, a) < rotary_travel(machine, previous, b);
        });
}

} // namespace millwright::kinematics
