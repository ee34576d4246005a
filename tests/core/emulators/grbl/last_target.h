// Where a program takes the machine, as its reader says.
#pragma once

#include "core/gcode/canon.h"
#include "core/gcode/canon_frame.h"

namespace millwright::test {

/// mm, in machine coordinates.
class LastTarget final : public gcode::CanonSink {
public:
    void move(const gcode::Move& move, const gcode::SourceLine&) override {
        at = frame_.to_machine(move.target);
    }
    void curve(const gcode::Curve&, const gcode::SourceLine&) override {}
    void command(const gcode::Command& command, const gcode::SourceLine&) override {
        frame_.command(command);
    }

    gcode::AxisValues at;

private:
    gcode::CanonFrame frame_;
};

} // namespace millwright::test
