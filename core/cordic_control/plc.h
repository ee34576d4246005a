// A programmable logic controller beside the processor: switches, lamps, timers and interlocks of the
// machine, in the instruction list of IEC 61131-3. A scan executes all instructions in their order; what it
// reads and writes are bits that the machine sets before and looks at behind it. Times us.
// Source: IEC 61131-3, docs/reference/cordic.md#logic.
#pragma once

#include "core/base/error.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::cordic {

/// Index of a bit: inputs I0 to I31, outputs Q0 to Q31, memory M0 to M63, timers T0 to T15, counters C0 to
/// C15, the machine's own commands U100 to U199, and those with a name.
using PlcBit = int;

enum PlcNamedBit : PlcBit {
    plc_moving = 260, ///< the axes move; as those that follow, set by the machine
    plc_spindle,      ///< is on
    plc_coolant,      ///< is on
    plc_waiting,      ///< at M00, M01 or M06, until START
    plc_ended,        ///< the program is at its end
    plc_hold,         ///< the axes stand while it is true; as those that follow, set by the logic
    plc_start,        ///< goes on behind M00, M01 or M06
    plc_fin,          ///< the machine's own command is done
    plc_stop,         ///< ends the run
    plc_bit_count
};

inline constexpr PlcBit plc_first_user_command = 160; ///< U100

/// Capital and small letters alike; nothing for any other text.
[[nodiscard]] std::optional<PlcBit> plc_bit(std::string_view name);
[[nodiscard]] std::string plc_name(PlcBit bit);
/// Whether the logic may set it.
[[nodiscard]] bool plc_writes(PlcBit bit);
/// Whether the machine may: inputs.
[[nodiscard]] bool plc_is_input(PlcBit bit);
[[nodiscard]] bool plc_is_timer(PlcBit bit);
[[nodiscard]] bool plc_is_counter(PlcBit bit);

enum class PlcOp : std::uint8_t {
    load,
    load_not,
    and_,
    and_not,
    or_,
    or_not,
    xor_,
    and_open, ///< AND( up to its ): the result so far waits
    or_open,
    close,
    not_,
    store,
    store_not,
    set,
    reset,
    on_delay,  ///< TON: true once the result was true for the preset
    off_delay, ///< TOF: false once it was false for the preset
    pulse,     ///< TP: true for the preset from when it became true
    count_up   ///< CTU: true once it became true as often as the preset
};

struct PlcInstruction {
    PlcOp op = PlcOp::load;
    PlcBit bit = 0;
    std::int64_t preset = 0; ///< us, or a count
};

inline constexpr std::size_t plc_nesting = 8; ///< of AND( and OR(
inline constexpr std::size_t most_plc_instructions = 4096;

struct PlcProgram {
    std::vector<PlcInstruction> instructions;
    std::vector<Diagnostic> errors; ///< with line and column; the program is of use only if there are none
};

class Plc {
public:
    /// `program` has no errors. All bits are false.
    explicit Plc(PlcProgram program);

    [[nodiscard]] bool get(PlcBit bit) const { return bits_[static_cast<std::size_t>(bit)]; }
    void set(PlcBit bit, bool value) { bits_[static_cast<std::size_t>(bit)] = value; }
    /// Once through the program. `now_us` does not go back from one scan to the next.
    void scan(std::int64_t now_us);
    [[nodiscard]] std::size_t size() const { return program_.instructions.size(); }

private:
    struct Timer {
        bool input = false;
        bool pulsing = false;
        std::int64_t since_us = 0; ///< when the input last changed, or the pulse began
        std::int64_t count = 0;
    };

    [[nodiscard]] bool timed(const PlcInstruction& at, bool input, std::int64_t now_us);

    PlcProgram program_;
    std::array<bool, plc_bit_count> bits_{};
    std::array<Timer, plc_bit_count> timers_{}; ///< those of T and C are used
};

// What happens to the inputs of a machine's logic from outside: doors, clamps, buttons, at their times.

/// What happens to an input from outside.
struct InputChange {
    double seconds = 0.0;
    PlcBit bit = 0;
    bool value = false;
};

struct ReadInputs {
    std::vector<InputChange> changes; ///< by ascending time
    std::vector<Diagnostic> errors;   ///< with line and column
};

/// Lines of "SECONDS BIT 0|1"; a semicolon begins a comment.
[[nodiscard]] ReadInputs read_inputs(std::string_view text, const std::filesystem::path& name);

} // namespace millwright::cordic
