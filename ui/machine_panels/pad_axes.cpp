#include "ui/machine_panels/internal/pad_axes.h"

#include <algorithm>
#include <cmath>

namespace millwright::panels {

namespace {

constexpr double dead_zone = 0.25;   ///< sticks do not come back to their middle exactly
constexpr double speed_levels = 4.0; ///< so that a trembling hand does not change the speed in every frame

double quarters(float stick) {
    const double beyond = (std::abs(static_cast<double>(stick)) - dead_zone) / (1.0 - dead_zone);
    return beyond > 0.0 ? std::copysign(std::ceil(speed_levels * std::min(beyond, 1.0)) / speed_levels,
                                        static_cast<double>(stick))
                        : 0.0;
}

} // namespace

std::vector<double> pad_axes(const render::Gamepad& pad, std::span<const program::ProgramAxis> axes) {
    std::vector<double> amounts(axes.size(), 0.0);
    if (!pad.left_bumper && !pad.right_bumper) {
        return amounts;
    }
    int rotary = 0;
    for (std::size_t n = 0; n < axes.size(); ++n) {
        if (axes[n].kind == kinematics::AxisKind::rotary) {
            amounts[n] = rotary == 0 ? pad.cross_x : rotary == 1 ? pad.cross_y : 0;
            ++rotary;
        } else if (axes[n].letter == 'X') {
            amounts[n] = quarters(pad.left_x);
        } else if (axes[n].letter == 'Y') {
            amounts[n] = quarters(pad.left_y);
        } else if (axes[n].letter == 'Z') {
            amounts[n] = quarters(pad.right_y);
        }
    }
    return amounts;
}

} // namespace millwright::panels
