#include "core/cordic_machine/internal/cordic_commands.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

namespace millwright::cordic_machine::internal {
namespace {

using cordic::Opcode;
using cordic::Register;
using cordic::Word;

constexpr double microseconds = 1e6; // per second
constexpr double no_word = -1.0;     // P or Q of a user's command that was not programmed

/// What the processor cannot do, and the word that asked for it; no letter: it changes nothing that it does.
struct Refused {
    std::string_view what;
    char letter = '\0';
};

Refused refused(gcode::CommandKind kind) {
    switch (kind) {
    case gcode::CommandKind::orient_spindle:
        return {"spindle orientation", 'M'};
    case gcode::CommandKind::change_tool_number:
        return {"setting the tool number (M61)", 'M'};
    case gcode::CommandKind::start_speed_feed_synch:
        return {"feed per revolution", 'G'};
    case gcode::CommandKind::wait_input:
        return {"inputs", 'M'};
    case gcode::CommandKind::set_motion_output_bit:
    case gcode::CommandKind::clear_motion_output_bit:
    case gcode::CommandKind::set_aux_output_bit:
    case gcode::CommandKind::clear_aux_output_bit:
    case gcode::CommandKind::set_motion_output_value:
    case gcode::CommandKind::set_aux_output_value:
        return {"outputs", 'M'};
    case gcode::CommandKind::control_tip:
        return {"tool-tip control", 'G'};
    default:
        return {};
    }
}

} // namespace

void CordicCommands::hand_over(Opcode opcode, gcode::SourcePlace source) {
    code_.op(opcode);
    code_.result().command_lines.push_back(source.line);
}

void CordicCommands::hand_over(Opcode opcode,
                               double parameter,
                               const FaultyWord& word,
                               std::string_view what) {
    if (!(parameter >= 0.0 && parameter <= std::numeric_limits<std::uint32_t>::max())) {
        return code_.fault(word, fmt::format("{} of {} does not fit into register P", what, parameter));
    }
    const auto whole = static_cast<Word>(std::llround(parameter));
    if (whole == 0 && parameter > 0.0) {
        return code_.fault(word,
                           fmt::format("{} of {:.6g} would be rounded to 0 in register P", what, parameter),
                           "use a whole number: P cannot hold fractions");
    }
    code_.mov(Register::P, whole);
    hand_over(opcode, word.source);
}

void CordicCommands::turn_spindle(Opcode opcode, gcode::SourcePlace source) {
    spindle_ = opcode;
    hand_over(opcode, std::abs(spindle_rpm_), {source, 'S'}, "a spindle speed in rpm");
}

bool CordicCommands::switches_spindle(gcode::SourcePlace source) const {
    return code_.has_word(source, 'M', 3.0) || code_.has_word(source, 'M', 4.0) ||
           code_.has_word(source, 'M', 5.0);
}

void CordicCommands::switch_coolant_off(gcode::SourcePlace source) {
    if (coolant_) { // the reader tells mist and flood apart, M09 does not
        coolant_ = false;
        hand_over(Opcode::m09, source);
    }
}

void CordicCommands::user_command(const gcode::Command& command) {
    const FaultyWord word{command.source, 'M', static_cast<double>(command.index)};
    if (command.value > no_word || command.value_2 > no_word) {
        return code_.fault(word,
                           fmt::format("the CORDIC processor cannot pass P and Q to M{}", command.index));
    }
    hand_over(Opcode::muser, command.index, word, "a command's number");
}

void CordicCommands::warn_of_corners(const gcode::Command& command) {
    const auto mode = static_cast<program::PathMode>(command.index);
    const bool rests = mode == program::PathMode::exact_stop;
    const bool rounds = mode == program::PathMode::continuous && command.value > 0.0;
    const FaultyWord word{command.source, 'G', rests ? 61.1 : 64.0};
    if (!(rests || rounds) || !code_.has_word(word.source, word.letter, *word.code)) {
        return; // what a cycle changes on its own is as the program had it
    }
    code_.warn(word,
               rests ? "the CORDIC processor does not stop at corners, as G61.1 requires"
                     : "the CORDIC processor does not round corners, as this tolerance would allow: its path "
                       "leads through the programmed points",
               rests ? "insert G4 between two moves to let the axes stop" : "");
}

void CordicCommands::end(gcode::SourcePlace source) {
    hand_over(code_.has_word(source, 'M', 30.0) ? Opcode::m30 : Opcode::m02, source);
    ended_ = true;
}

void CordicCommands::command(const gcode::Command& command) {
    const gcode::SourcePlace source = command.source;
    switch (command.kind) {
    case gcode::CommandKind::set_motion_control_mode:
        return warn_of_corners(command);
    case gcode::CommandKind::dwell:
        if (command.value > 0.0) {
            hand_over(Opcode::g04, command.value * microseconds, {source, 'P'}, "a dwell in us");
        }
        return;
    case gcode::CommandKind::set_spindle_speed:
        spindle_rpm_ = command.value;
        if (spindle_ != Opcode::m05 && !switches_spindle(source)) {
            turn_spindle(spindle_, source);
        }
        return;
    case gcode::CommandKind::start_spindle_clockwise:
        return turn_spindle(Opcode::m03, source);
    case gcode::CommandKind::start_spindle_counterclockwise:
        return turn_spindle(Opcode::m04, source);
    case gcode::CommandKind::stop_spindle_turning:
        if (spindle_ != Opcode::m05) {
            spindle_ = Opcode::m05;
            hand_over(Opcode::m05, source);
        }
        return;
    case gcode::CommandKind::select_tool:
        tool_ = command.index;
        return;
    case gcode::CommandKind::change_tool:
        return hand_over(Opcode::m06, tool_, {source, 'T'}, "a tool number");
    case gcode::CommandKind::mist_on:
    case gcode::CommandKind::flood_on:
        coolant_ = true;
        return hand_over(command.kind == gcode::CommandKind::mist_on ? Opcode::m07 : Opcode::m08, source);
    case gcode::CommandKind::mist_off:
    case gcode::CommandKind::flood_off:
        return switch_coolant_off(source);
    case gcode::CommandKind::program_stop:
        return hand_over(Opcode::m00, source);
    case gcode::CommandKind::optional_program_stop:
        return hand_over(Opcode::m01, source);
    case gcode::CommandKind::user_command:
        return user_command(command);
    case gcode::CommandKind::program_end:
        return end(source);
    case gcode::CommandKind::pallet_shuttle: // of M30 too, where it asks for nothing
        if (code_.has_word(source, 'M', 60.0)) {
            code_.fault({source, 'M', 60.0}, "the CORDIC processor has no pallets");
        }
        return;
    default:
        if (const Refused cannot = refused(command.kind); cannot.letter != '\0') {
            code_.fault({source, cannot.letter},
                        fmt::format("the CORDIC processor does not support {}", cannot.what));
        }
    }
}

} // namespace millwright::cordic_machine::internal
