#include "core/cordic_machine/internal/cordic_code.h"

#include "core/cordic/arithmetic.h"
#include "core/gcode/word_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

namespace millwright::cordic_machine::internal {

using cordic::Opcode;
using cordic::Register;
using cordic::Word;

CordicCode::CordicCode(std::filesystem::path file, const CordicProgramSettings& settings)
    : file_(std::move(file)), settings_(settings) {
    result_.image.format = settings.format;
}

Place CordicCode::place_of(const FaultyWord& word) const {
    if (word.source != now_.place) {
        return {file_, word.source.line, 0, -1}; // asked for by an earlier line, whose text is gone
    }
    const int column = gcode::column_of_word(now_.text, word.letter, word.code);
    return {file_, word.source.line, column > 0 ? column : gcode::first_column(now_.text), -1};
}

bool CordicCode::has_word(gcode::SourcePlace source, char letter, double code) const {
    return source == now_.place && gcode::column_of_word(now_.text, letter, code) > 0;
}

void CordicCode::fault(const FaultyWord& word, std::string message, std::string hint) {
    if (const auto known = times_.find(message); known != times_.end()) {
        ++known->second;
    } else if (result_.faults.size() < settings_.most_faults) {
        times_.emplace(message, 1);
        result_.faults.push_back({place_of(word), std::move(message), std::move(hint)});
    }
}

CordicProgram CordicCode::take() {
    for (Diagnostic& fault : result_.faults) {
        if (const std::int64_t times = times_.at(fault.message); times > 1) {
            fault.message += fmt::format(" (the first of {} times)", times);
        }
    }
    return std::move(result_);
}

void CordicCode::warn(const FaultyWord& word, std::string message, std::string hint) {
    result_.warnings.push_back({place_of(word), std::move(message), std::move(hint)});
}

std::optional<Word> CordicCode::number(double value, std::string_view what, const FaultyWord& word) {
    bool overflow = false;
    const Word bits = cordic::with_arithmetic(settings_.format, [&](const auto& arithmetic) {
        return arithmetic.to_word(arithmetic.from_double(value, overflow));
    });
    if (overflow) {
        fault(word,
              fmt::format("{} {} does not fit into {}", what, value, cordic::to_text(settings_.format)),
              "choose a number format with more integer bits");
        return std::nullopt;
    }
    return bits;
}

double CordicCode::as_held(Word word) const {
    return cordic::with_arithmetic(settings_.format, [&](const auto& arithmetic) {
        return arithmetic.to_double(arithmetic.from_word(word));
    });
}

void CordicCode::add(const cordic::Instruction& instruction) {
    const bool loads = instruction.opcode == Opcode::mov;
    const int size = loads ? 1 + cordic::immediate_bytes(settings_.format) : 1;
    const auto used = static_cast<int>(result_.image.code.size() % cordic::rom_size);
    if (used + size + 1 > cordic::rom_size) { // one byte stays for PAGE
        put({.opcode = Opcode::page});
        result_.image.code.resize(cordic::page_count(result_.image.code.size()) * cordic::rom_size, 0xff);
    }
    put(instruction);
}

/// A program that is too long is not kept for ever.
void CordicCode::put(const cordic::Instruction& instruction) {
    if (result_.image.code.size() <= cordic::most_code) {
        const int column = now_.text.empty() ? 0 : gcode::first_column(now_.text);
        result_.code_lines.push_back(
            {cordic::code_address_at(result_.image.code.size()), now_.place.line, column});
        cordic::append(result_.image.code, instruction, settings_.format);
    }
}

void CordicCode::op(Opcode opcode) {
    add({.opcode = opcode});
}

void CordicCode::mov(Register target, Word word) {
    auto& loaded = loaded_[static_cast<std::size_t>(target)];
    if (loaded != word) {
        const Word immediate = cordic::is_whole(target) ? word : cordic::to_immediate(settings_.format, word);
        add({Opcode::mov, target, immediate});
        loaded = word;
    }
}

void CordicCode::set_loaded(Register target, std::optional<Word> word) {
    loaded_[static_cast<std::size_t>(target)] = word;
}

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
