// What the cordic commands have in common that take a program: where it comes from, and the processor for it.
#pragma once

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/cordic/processor.h"
#include "core/cordic_machine/cordic_program.h"

#include <CLI/App.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

struct CordicSource {
    std::string file;                  ///< G-code, assembler text (.asm) or image (.bin)
    std::optional<std::string> format; ///< of an image: its own; else f32
    double tolerance = cordic_machine::usual_chord_tolerance;
    double rapid_mm_per_min = to_mm_per_min(cordic_machine::CordicProgramSettings().rapid_speed);
    std::optional<double> acceleration; ///< Amax; of G-code without it that of CordicProgramSettings
    bool thesis_arcs = false;
    bool whole_arcs = false;
    bool other_axes = false;
    std::vector<double> origin;               ///< of the program on the machine; empty: not known
    bool plans_motion = false;                ///< what Amax limits then, whatever the program is
    std::vector<const CLI::Option*> of_gcode; ///< that mean nothing to other programs
};

/// What was asked for of the arithmetic; what was not, a program in assembler text or an image says.
struct CordicArithmetic {
    std::optional<int> iterations;
    std::optional<std::string> rounding;
    bool thesis_direction = false;
    bool matlab_zero = false;
};

struct CordicChoice {
    CordicArithmetic arithmetic;
    std::string microprogram; ///< text file; empty: ours
    int wait_states = 0;
    bool whole_acceleration = false;
    bool over_bus = false;
};

/// `kinds` says what FILE may be.
void add_cordic_source(CLI::App& command,
                       CordicSource& source,
                       const char* kinds = "G-code, assembly source (.asm) or image (.bin)");
/// Of --format.
[[nodiscard]] CLI::Validator number_format_text();
void add_cordic_arithmetic(CLI::App& command, CordicArithmetic& arithmetic);
/// Wait states, set-points over the bus, the whole acceleration.
void add_cordic_unit(CLI::App& command, CordicChoice& choice);
void add_cordic_choice(CLI::App& command, CordicChoice& choice); ///< both, and a microprogram
/// What a program is made for where only the options say so.
[[nodiscard]] cordic::MadeFor made_for_options(const CordicArithmetic& arithmetic);
void add_cordic_clock(CLI::App& command, double& clock_hz);

/// Throws Error if there are any: it, or how many they are behind the first of them, which are printed.
void refuse(const std::vector<Diagnostic>& errors);

/// Made for such arithmetic. Throws Error, after printing what is wrong, if it is no program of the
/// processor, for options that mean nothing to it, and if it is made for other arithmetic. Warnings are
/// printed.
[[nodiscard]] cordic_machine::CordicProgram cordic_program(const CordicSource& source,
                                                           const CordicArithmetic& arithmetic);

[[nodiscard]] cordic::Processor cordic_processor(const CordicChoice& choice, const cordic::Image& image);

/// To the end, or `most_clocks` where they are asked for. Throws Error for a program that goes round without
/// end, with the place in it; G-code ends, unless a microprogram of one's own executes it.
void execute_to_end(cordic::Processor& processor,
                    const cordic_machine::CordicProgram& program,
                    const CordicSource& source,
                    const CordicChoice& choice,
                    std::optional<std::int64_t> most_clocks);
/// Of the instruction that goes round.
[[nodiscard]] Error goes_round(const cordic::Processor& processor,
                               const cordic_machine::CordicProgram& program,
                               const CordicSource& source);
/// What is executed where no --clocks is given.
[[nodiscard]] std::int64_t most_clocks_of(const CordicSource& source, const CordicChoice& choice);
void add_cordic_clocks(CLI::App& command, std::optional<std::int64_t>& most_clocks);

/// Why the processor is not at the end of `program`, with the place in it or in the microprogram. `clocks`:
/// how many it had.
[[nodiscard]] Error not_at_its_end(const cordic::Processor& processor,
                                   const cordic_machine::CordicProgram& program,
                                   const CordicSource& source,
                                   const CordicChoice& choice);

} // namespace millwright::app
