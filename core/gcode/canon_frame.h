// Where canonical positions are on the machine: unit, offsets and rotation, as LinuxCNC's canonical layer
// applies them (Proctor et al., NISTIR 6556; LinuxCNC, emccanon): (position + G92) turned about Z, + G5x +
// tool.
#pragma once

#include "core/gcode/canon.h"

namespace millwright::gcode {

/// Machine positions in mm and degrees.
class CanonFrame {
public:
    /// Takes in a command that changes the frame; others leave it as it is. Offsets are in the unit that is
    /// in force.
    void command(const Command& command);

    [[nodiscard]] double unit() const { return unit_; } ///< mm
    [[nodiscard]] AxisValues to_machine(const AxisValues& position) const;
    [[nodiscard]] AxisValues from_machine(const AxisValues& position) const;

private:
    [[nodiscard]] static AxisValues turned(AxisValues values, double angle);

    double unit_ = 1.0;
    double rotation_ = 0.0;       ///< rad
    AxisValues g5x_, g92_, tool_; ///< mm and degrees
};

} // namespace millwright::gcode
