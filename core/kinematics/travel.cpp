#include "core/kinematics/travel.h"

#include "core/base/units.h"

#include <fmt/format.h>

namespace millwright::kinematics {

std::string beyond_travel(const MachineAxis& axis, double position) {
    if (position >= axis.min && position <= axis.max) {
        return {};
    }
    const bool rotary = axis.kind == AxisKind::rotary;
    const auto shown = [&](double value) { return rotary ? to_degrees(value) : value; };
    return fmt::format("axis {} would move to {:.3f}, outside {:.3f} ... {:.3f} {}",
                       axis.letter,
                       shown(position),
                       shown(axis.min),
                       shown(axis.max),
                       rotary ? "deg" : "mm");
}

} // namespace millwright::kinematics
