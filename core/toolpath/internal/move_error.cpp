#include "core/toolpath/internal/move_error.h"

#include "core/base/numbers.h"
#include "core/kinematics/forward.h"
#include "core/toolpath/internal/largest_angle.h"

#include <algorithm>
#include <cmath>

namespace millwright::toolpath {

grid::MoveError move_error(const kinematics::MachineModel& machine,
                           const kinematics::AxisPositions& from,
                           const kinematics::AxisPositions& to,
                           const ChordCurve& curve,
                           int tip_samples) {
    const kinematics::StraightForward way(machine, from, to);
    double tip = 0.0; // squares
    double off_surface = 0.0;
    double param = 0.0;
    LargestAngle axis;
    for (int k = 1; k <= tip_samples; ++k) {
        const double t = static_cast<double>(k) / (tip_samples + 1);
        const geometry::ToolPose actual = way.at(t);
        const ChordCurve::Nearest nearest = curve.nearest(actual.tip);
        const double normal = nearest.normal.squaredNorm(); // 0 where those of the chord's ends cancel
        const double off = square((actual.tip - nearest.point).dot(nearest.normal));
        tip = std::max(tip, nearest.squared);
        off_surface = normal > 0.0 ? std::max(off_surface, off / normal) : off_surface;
        param = std::max(param, (actual.tip - curve.at(t)).squaredNorm());
        axis.see(actual.axis, nearest.normal);
    }
    return {.tip = std::sqrt(tip),
            .axis = axis.angle(),
            .length = curve.length(),
            .off_surface = std::sqrt(off_surface),
            .param = std::sqrt(param)};
}

} // namespace millwright::toolpath
