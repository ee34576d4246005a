// The state of the processor as plain values, what it is set to, and what it hands to the motion controller.
#pragma once

#include "core/cordic/arithmetic.h"
#include "core/cordic/bus.h"
#include "core/cordic/image.h"
#include "core/cordic/instruction.h"
#include "core/cordic/kernel.h"
#include "core/cordic/microprogram.h"
#include "core/cordic/sequencer.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace millwright::cordic {

struct ProcessorSettings {
    Sequence sequence = thesis_sequence(); ///< circular
    Rounding rounding = Rounding::truncate;
    SignOfZero zero = SignOfZero::positive;
    ArcSense sense = ArcSense::iso;
    Publishing publishing = Publishing::latch;
    bool halves_acceleration = true; ///< the axes get Amax/2, as in eq. 4.2
    int wait_states = 0;             ///< of every bus cycle
};

/// Why the processor stands.
enum class Stop : std::uint8_t {
    none,                ///< it runs
    halted,              ///< HLT
    overflow,            ///< a number did not fit the word
    no_number,           ///< MOV or LD of bits that are none: NaN, infinity
    no_speed,            ///< Vmax or Amax is not above 0
    illegal_instruction, ///< an opcode that the mapping ROM does not know
    stack_overflow,      ///< of the microprogram
    stack_underflow,
    microprogram_end, ///< behind its last word
    too_many_bytes,   ///< a microprogram moves more than there are
    too_many_steps,   ///< more than the sequence has
    rom_write,
    across_memories, ///< LD or ST that begins in one and ends in another
    beyond_bus,      ///< an address behind the last one
    no_page,         ///< PAGE behind the last page of the program ROM
    arc_too_coarse,  ///< |Dz| beyond the convergence range, or no chord at all
    out_of_reach,    ///< a direction that the steps cannot turn to the x axis
};

/// A sentence for people.
[[nodiscard]] std::string_view to_text(Stop stop);

/// The registers of the arithmetic unit, which programs do not see.
struct DataPath {
    Word x = 0, y = 0, z = 0;
    Word x2 = 0, y2 = 0;         ///< second pair, turned along with the first
    Word xe = 0, ye = 0, ze = 0; ///< where the motion ends
    Word rise = 0;               ///< of a line in space
    Word bearing = 0;            ///< its direction in the plane
    bool f1 = false;             ///< of PreCORDIC
    bool f2 = false;
    bool standing = false; ///< the last motion had no length: speeds are 0
    bool upright = false;  ///< or none in the plane
    std::uint8_t step = 0;
    std::uint8_t correction = 0;

    friend bool operator==(const DataPath&, const DataPath&) = default;
};

/// Clocks since reset, by what they were spent on.
struct ClockCounts {
    std::int64_t total = 0;
    std::int64_t cordic = 0;    ///< steps and corrections
    std::int64_t fetch = 0;     ///< opcodes, with their bus cycles
    std::int64_t immediate = 0; ///< bytes of Mov, with their bus cycles
    std::int64_t publish = 0;   ///< bytes to the motion controller, with their bus cycles
    std::int64_t data = 0;      ///< bytes of LD and ST, with their bus cycles
    /// What is left: dispatch, folding, loading counters, returning.
    [[nodiscard]] std::int64_t control() const { return total - cordic - fetch - immediate - publish - data; }

    friend bool operator==(const ClockCounts&, const ClockCounts&) = default;
};

struct ProcessorState {
    SequencerState sequencer;
    MicroWord pipeline; ///< the micro-instruction executed in the last clock
    std::array<Word, register_count> registers{};
    std::uint8_t opcode = 0;        ///< IR
    CodeAddress instruction_at = 0; ///< where the instruction in IR lies
    Word temporary = 0;             ///< immediate or data on its way in
    std::uint8_t bytes_moved = 0;   ///< of the temporary, or of a register on its way out
    std::uint32_t data_address = 0; ///< of the next byte that LD reads or ST writes
    /// Next one to be written, of a set-point or, from command_port on, a command.
    std::uint8_t record_byte = 0;
    DataPath path;
    BusState bus;
    ClockCounts clocks;
    std::int64_t instructions = 0; ///< finished
    Stop stop = Stop::none;

    friend bool operator==(const ProcessorState&, const ProcessorState&) = default;
};

[[nodiscard]] inline Word& register_of(ProcessorState& state, Register name) {
    return state.registers[static_cast<std::size_t>(name)];
}
[[nodiscard]] inline Word register_of(const ProcessorState& state, Register name) {
    return state.registers[static_cast<std::size_t>(name)];
}

/// The first reason stays.
inline void stop(ProcessorState& state, Stop why) {
    state.stop = state.stop == Stop::none ? why : state.stop;
}

/// What was handed to the motion controller, and when.
struct Published {
    std::int64_t clock = 0;
    CodeAddress instruction_at = 0;
    Opcode opcode = Opcode::nop; ///< of the instruction
    std::array<Word, 9> words{}; ///< X, Y, Vx, Vy, Ax, Ay, and of the third axis Z, Vz, Az
};

/// A command that was handed over: the M-codes and G04.
struct Commanded {
    std::int64_t clock = 0;
    CodeAddress instruction_at = 0;
    Opcode opcode = Opcode::nop;
    std::uint32_t parameter = 0;        ///< P where the command takes one
    std::int64_t behind_set_points = 0; ///< how many had been published before it
};

} // namespace millwright::cordic
