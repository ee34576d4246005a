// What is no motion, as instructions of the CORDIC processor: dwell, spindle, tool, coolant, stops.
#pragma once

#include "core/cordic_machine/internal/cordic_code.h"

#include <cstdint>

namespace millwright::cordic_machine::internal {

class CordicCommands {
public:
    explicit CordicCommands(CordicCode& code) : code_(code) {}

    /// Commands that change nothing that the processor does are passed over.
    void command(const gcode::Command& command);
    [[nodiscard]] bool ended() const { return ended_; } ///< by M02 or M30

private:
    void hand_over(cordic::Opcode opcode, gcode::SourcePlace source);
    void hand_over(cordic::Opcode opcode, double parameter, const FaultyWord& word, std::string_view what);
    void turn_spindle(cordic::Opcode opcode, gcode::SourcePlace source);
    /// The line does so behind its S word, whose speed is then for that.
    [[nodiscard]] bool switches_spindle(gcode::SourcePlace source) const;
    void switch_coolant_off(gcode::SourcePlace source);
    void user_command(const gcode::Command& command);
    /// Its motions lead exactly through the programmed points, and do not rest there.
    void warn_of_corners(const gcode::Command& command);
    void end(gcode::SourcePlace source);

    CordicCode& code_;
    double spindle_rpm_ = 0.0;
    cordic::Opcode spindle_ = cordic::Opcode::m05;
    bool coolant_ = false;
    int tool_ = 0;
    bool ended_ = false;
};

} // namespace millwright::cordic_machine::internal
