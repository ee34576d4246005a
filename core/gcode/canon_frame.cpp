#include "core/gcode/canon_frame.h"

#include "core/base/units.h"

#include <cmath>

namespace millwright::gcode {

void CanonFrame::command(const Command& command) {
    constexpr double inch = 25.4;
    switch (command.kind) {
    case CommandKind::use_length_units:
        unit_ = command.index == 1 ? inch : 1.0;
        break;
    case CommandKind::set_g5x_offset:
        g5x_ = command.axes.lengths_scaled(unit_);
        break;
    case CommandKind::set_g92_offset:
        g92_ = command.axes.lengths_scaled(unit_);
        break;
    case CommandKind::set_xy_rotation:
        rotation_ = from_degrees(command.value);
        break;
    case CommandKind::use_tool_length_offset:
        tool_ = command.axes.lengths_scaled(unit_);
        break;
    default:
        break;
    }
}

AxisValues CanonFrame::to_machine(const AxisValues& position) const {
    return turned(position.lengths_scaled(unit_) + g92_, rotation_) + g5x_ + tool_;
}

AxisValues CanonFrame::from_machine(const AxisValues& position) const {
    return (turned(position - g5x_ - tool_, -rotation_) - g92_).lengths_scaled(1.0 / unit_);
}

AxisValues CanonFrame::turned(AxisValues values, double angle) {
    const double x = values[Axis::x];
    const double y = values[Axis::y];
    values[Axis::x] = x * std::cos(angle) - y * std::sin(angle);
    values[Axis::y] = x * std::sin(angle) + y * std::cos(angle);
    return values;
}

} // namespace millwright::gcode
