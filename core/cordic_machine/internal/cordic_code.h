// Instructions of the CORDIC processor, one after another, and what is wrong with them: numbers as the format
// holds them, registers loaded only when their value changes.
#pragma once

#include "core/cordic/instruction.h"
#include "core/cordic_machine/cordic_program.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::cordic_machine::internal {

/// What a fault is about: a word of the line that asked for it; with a code, as G18.
struct FaultyWord {
    gcode::SourcePlace source;
    char letter = '\0';
    std::optional<double> code{};
};

class CordicCode {
public:
    CordicCode(std::filesystem::path file, const CordicProgramSettings& settings);

    /// The line that the next faults may be in.
    void begin_line(const gcode::SourceLine& now) { now_ = now; }
    /// What is said already is counted, not said again.
    void fault(const FaultyWord& word, std::string message, std::string hint = {});
    /// Whether the line that asked has such a word.
    [[nodiscard]] bool has_word(gcode::SourcePlace source, char letter, double code) const;
    void warn(const FaultyWord& word, std::string message, std::string hint = {});

    /// The bits of a number; nothing, and a fault, if it does not fit.
    std::optional<cordic::Word> number(double value, std::string_view what, const FaultyWord& word);
    [[nodiscard]] double as_held(cordic::Word word) const;

    void op(cordic::Opcode opcode);
    /// Loads a register unless the program left that in it.
    void mov(cordic::Register target, cordic::Word word);
    /// A register that instructions change: what is in it is known, or not.
    void set_loaded(cordic::Register target, std::optional<cordic::Word> word);

    [[nodiscard]] CordicProgram& result() { return result_; }
    /// The result, with how often each fault was found. Nothing comes after it.
    [[nodiscard]] CordicProgram take();

private:
    [[nodiscard]] Place place_of(const FaultyWord& word) const;
    /// On the next page of the ROM where this one is full.
    void add(const cordic::Instruction& instruction);
    void put(const cordic::Instruction& instruction);

    std::filesystem::path file_;
    CordicProgramSettings settings_;
    CordicProgram result_;
    std::map<std::string, std::int64_t> times_; ///< that a fault was found, by its message
    gcode::SourceLine now_;                     ///< of the call that is being made
    std::array<std::optional<cordic::Word>, cordic::register_count> loaded_;
};

// What is no motion, as instructions of the CORDIC processor: dwell, spindle, tool, coolant, stops.

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
