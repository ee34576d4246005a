// The processor, clock by clock: control unit, data path and bus. Its whole state is plain values that may be
// looked at, copied and compared between any two clocks.
#pragma once

#include "core/cordic/arithmetic.h"
#include "core/cordic/bus.h"
#include "core/cordic/instruction.h"
#include "core/cordic/interpolation.h"
#include "core/cordic/kernel.h"
#include "core/cordic/microprogram.h"
#include "core/cordic/sequencer.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace millwright::cordic {

/// Which way G02 turns.
enum class ArcSense : std::uint8_t {
    iso,   ///< clockwise, as ISO 6983 says
    thesis ///< counter-clockwise, as the thesis's model does
};

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
    illegal_instruction, ///< an opcode that the mapping ROM does not know
    stack_overflow,      ///< of the microprogram
    stack_underflow,
    rom_write,
    arc_too_coarse, ///< |Dz| beyond the convergence range, or no chord at all
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
    /// What is left: dispatch, folding, loading counters, returning.
    [[nodiscard]] std::int64_t control() const { return total - cordic - fetch - immediate - publish; }

    friend bool operator==(const ClockCounts&, const ClockCounts&) = default;
};

struct ProcessorState {
    SequencerState sequencer;
    MicroWord pipeline; ///< the micro-instruction executed in the last clock
    std::array<Word, register_count> registers{};
    std::uint8_t opcode = 0;          ///< IR
    std::uint16_t instruction_at = 0; ///< where the instruction in IR lies
    Word temporary = 0;               ///< immediate on its way in
    std::uint8_t immediate_bytes_in = 0;
    std::uint8_t record_byte =
        0; ///< next one to be written, of a set-point or, from command_port on, a command
    DataPath path;
    BusState bus;
    ClockCounts clocks;
    std::int64_t instructions = 0; ///< finished
    Stop stop = Stop::none;

    friend bool operator==(const ProcessorState&, const ProcessorState&) = default;
};

/// What was handed to the motion controller, and when.
struct Published {
    std::int64_t clock = 0;
    std::uint16_t instruction_at = 0;
    Opcode opcode = Opcode::nop; ///< of the instruction
    std::array<Word, 9> words{}; ///< X, Y, Vx, Vy, Ax, Ay, and of the third axis Z, Vz, Az
};

/// A command that was handed over: the M-codes and G04.
struct Commanded {
    std::int64_t clock = 0;
    std::uint16_t instruction_at = 0;
    Opcode opcode = Opcode::nop;
    std::uint32_t parameter = 0;        ///< P where the command takes one
    std::int64_t behind_set_points = 0; ///< how many had been published before it
};

/// The third axis of a set-point.
struct HeightPoint {
    double z = 0.0, vz = 0.0, az = 0.0;
};

class Processor {
public:
    /// With `image` in the program ROM, after reset. Throws Error if the image is longer than the ROM, or the
    /// sequence is not circular.
    Processor(const ProcessorSettings& settings, const Image& image);
    /// A microprogram of one's own.
    Processor(const ProcessorSettings& settings, const Image& image, Microprogram microprogram);

    [[nodiscard]] const ProcessorState& state() const { return state_; }
    [[nodiscard]] const Microprogram& microprogram() const { return *microprogram_; }
    [[nodiscard]] const NumberFormat& format() const { return format_; }
    [[nodiscard]] const ProcessorSettings& settings() const { return settings_; }
    [[nodiscard]] Memory& memory() { return memory_; }
    /// All that was published since reset.
    [[nodiscard]] const std::vector<Published>& published() const { return published_; }
    /// And all commands.
    [[nodiscard]] const std::vector<Commanded>& commanded() const { return commanded_; }
    /// A register or a published word as a number.
    [[nodiscard]] double number(Word word) const;
    [[nodiscard]] SetPoint<double> set_point(const Published& record) const;
    [[nodiscard]] HeightPoint height_point(const Published& record) const;

    /// One clock. Does nothing once the processor stands.
    void clock() { run(1); }
    /// Up to so many clocks, until it stands. Returns how many.
    std::int64_t run(std::int64_t clocks);
    /// To the end of the instruction that is being executed, at most `clocks`. Returns how many.
    std::int64_t run_instruction(std::int64_t clocks);
    /// Everything but the memory as after power on.
    void reset();

private:
    using AnyKernel = std::
        variant<Kernel<FloatArithmetic<double>>, Kernel<FloatArithmetic<float>>, Kernel<FixedArithmetic>>;

    [[nodiscard]] bool condition(Condition condition) const;
    void sequence(const MicroWord& word);
    void move_data(ControlSignals controls);
    void use_bus(ControlSignals controls);
    void count(const MicroWord& word);
    void publish();
    void hand_over_command();
    void write_byte();
    void store_register();
    void stop(Stop why);
    template <class Arithmetic> void calculate(const Kernel<Arithmetic>& kernel, ControlSignals controls);
    template <class Arithmetic> void iterate(const Kernel<Arithmetic>& kernel, ControlSignals controls);
    template <class Arithmetic> void fold(const Kernel<Arithmetic>& kernel, ControlSignals controls);
    template <class Arithmetic> void unfold(const Kernel<Arithmetic>& kernel, ControlSignals controls);
    template <class Arithmetic> void one_clock(const Kernel<Arithmetic>& kernel);

    [[nodiscard]] Word& reg(Register name) { return state_.registers[static_cast<std::size_t>(name)]; }
    [[nodiscard]] Word reg(Register name) const { return state_.registers[static_cast<std::size_t>(name)]; }

    ProcessorSettings settings_;
    NumberFormat format_;
    std::shared_ptr<const Microprogram> microprogram_;
    AnyKernel kernel_;
    Memory memory_;
    ProcessorState state_;
    std::vector<Published> published_;
    std::vector<Commanded> commanded_;
};

} // namespace millwright::cordic
