#include "core/toolpath/internal/move_error.h"

#include "core/kinematics/forward.h"

#include <algorithm>
#include <cmath>

namespace millwright::toolpath {

grid::MoveError move_error(const kinematics::MachineModel& machine,
                           const kinematics::AxisPositions& from,
                           const kinematics::AxisPositions& to,
                           const ChordCurve& curve,
                           int tip_samples) {
    const kinematics::AxisPositions step = to - from;
    double squared = 0.0;
    grid::MoveError error;
    error.length = curve.length();
    for (int k = 1; k <= tip_samples; ++k) {
        const double t = static_cast<double>(k) / (tip_samples + 1);
        const geometry::ToolPose actual = kinematics::forward(machine, from + t * step);
        const ChordCurve::Nearest nearest = curve.nearest(actual.tip);
        squared = std::max(squared, nearest.squared);
        const double off = std::abs((actual.tip - nearest.point).dot(nearest.normal.normalized()));
        error.off_surface = std::max(error.off_surface, off);
        error.param = std::max(error.param, (actual.tip - curve.at(t)).norm());
        error.axis = std::max(error.axis, angle_between(actual.axis, nearest.normal));
    }
    error.tip = std::sqrt(squared);
    return error;
}

} // namespace millwright::toolpath
