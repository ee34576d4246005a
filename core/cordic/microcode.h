// Micro-instructions: what the control unit's ROM holds, and the assembler that fills it from text.
// A word has an operation of the sequencer, the condition it tests, a branch address or count, and the
// control signals of the data path. Format of the text: docs/reference/cordic.md#micro-assembler.
#pragma once

#include "core/base/error.h"
#include "core/cordic/sequencer.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::cordic {

/// What a micro-instruction can test.
enum class Condition : std::uint8_t {
    never,
    always,
    bus_busy,       ///< a read or write is not at its end yet
    chords_left,    ///< register N is not 0
    last_byte_left, ///< the counter is not 0
};

/// What the data path and the bus do in a clock; several may go together. Registers show the result a clock
/// later.
enum class Control : std::uint8_t {
    read_program,   ///< begin to read the byte that PC points at
    load_opcode,    ///< IR <- byte read, PC + 1
    shift_byte,     ///< temporary <- byte read, behind those before it; PC + 1
    store_register, ///< register named by IR <- temporary
    take_end,       ///< (XE, YE) <- (XI, YJ)
    take_position,  ///< (X0, Y0, Z0) <- (XE, YE, ZE)
    publish,        ///< hand (XE, YE, Vx, Vy, Ax, Ay, ZE, Vz, Az) to the motion controller
    count_chord,    ///< N - 1
    fold_radius,    ///< (x, y, f1, f2) <- Pre((X0, Y0) - (XI, YJ)); z <- +-Dz
    fold_move,      ///< (x, y, f1, f2) <- Pre((XE, YE) - (X0, Y0)), normalised; z, Vz, Az <- 0
    load_speed,     ///< (x, y) <- (Vmax, 0); (x2, y2) <- (Amax/2, 0)
    rotate,         ///< a CORDIC step of (x, y, z), driving z to 0
    vector,         ///< a CORDIC step of (x, y, z), driving y to 0
    rotate_both,    ///< the same step of (x2, y2) along with `rotate`
    correct,        ///< a step of the gain correction of (x, y)
    correct_both,   ///< the same of (x2, y2) along with `correct`
    unfold_radius,  ///< (XE, YE) <- Post(x, y, f1, f2) + (XI, YJ)
    unfold_speed,   ///< (Vx, Vy) <- Post(x, y, f1, f2); (Ax, Ay) <- Post(x2, y2, f1, f2)
    write_byte,     ///< begin to write the next byte of the record to the motion controller
    halt,           ///< stop
    take_height,    ///< ZE <- Z
    fold_space,     ///< as fold_move, with ZE - Z0 -> rise, all three normalised together
    fold_rise,      ///< bearing <- z; y <- rise; z <- 0: the next direction is the slope
    unfold_rise,    ///< Vz <- y, Az <- y2; y, y2 <- 0; z <- bearing
    command,        ///< hand (IR, P) to the motion controller
    add_rise,       ///< ZE <- Z0 + Z
    next_page,      ///< page of the program ROM + 1, PC <- 0
    take_address,   ///< address of data <- temporary, which is then 0
    read_data,      ///< begin to read the byte at the address of data, which counts up
    shift_data,     ///< temporary <- byte read, behind those before it
    write_data,     ///< begin to write the next byte of the register named by IR there; the address counts up
};

inline constexpr int control_count = 31;
using ControlSignals = std::uint32_t; ///< one bit a Control

[[nodiscard]] constexpr ControlSignals bit_of(Control control) {
    return ControlSignals{1} << static_cast<unsigned>(control);
}

[[nodiscard]] std::string_view to_text(Condition condition);
[[nodiscard]] std::string_view to_text(Control control);

struct MicroWord {
    MicroOp op = MicroOp::CONT;
    Condition condition = Condition::never;
    std::uint8_t branch = 0;
    ControlSignals controls = 0;

    friend bool operator==(const MicroWord&, const MicroWord&) = default;
};

inline constexpr int micro_rom_size = 256;

struct Microprogram {
    std::array<MicroWord, micro_rom_size> words{};
    int count = 0;                                      ///< words that are written
    std::array<std::optional<std::uint8_t>, 256> map{}; ///< mapping ROM: opcode -> start address
    std::array<int, micro_rom_size> lines{};            ///< line of the text each word comes from
    std::map<std::string, std::uint8_t> labels;
};

struct AssembledMicroprogram {
    Microprogram program;
    std::vector<Diagnostic> errors; ///< with line and column; the program is of use only if there are none
};

/// `constants` are numbers that the text may use by name.
[[nodiscard]] AssembledMicroprogram
assemble_microprogram(std::string_view text,
                      const std::filesystem::path& name,
                      std::span<const std::pair<std::string, int>> constants = {});

/// One line a word: address, operation, condition, branch, signals.
[[nodiscard]] std::string listing(const Microprogram& program);

} // namespace millwright::cordic
