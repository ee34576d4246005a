// The processor, clock by clock: control unit, data path and bus. Its whole state is plain values that may be
// looked at, copied and compared between any two clocks.
#pragma once

#include "core/cordic/interpolation.h"
#include "core/cordic/kernel.h"
#include "core/cordic/processor_state.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace millwright::cordic {

/// The third axis of a set-point.
struct HeightPoint {
    double z = 0.0, vz = 0.0, az = 0.0;
};

class Processor {
public:
    /// With `image` in the program ROM, after reset. Throws Error if the image is longer than all pages of
    /// the ROM, or the sequence is not circular.
    Processor(const ProcessorSettings& settings, const Image& image);
    /// A microprogram of one's own.
    Processor(const ProcessorSettings& settings, const Image& image, Microprogram microprogram);

    [[nodiscard]] const ProcessorState& state() const { return state_; }
    [[nodiscard]] const Microprogram& microprogram() const { return *microprogram_; }
    [[nodiscard]] const NumberFormat& format() const { return format_; }
    [[nodiscard]] const ProcessorSettings& settings() const { return settings_; }
    [[nodiscard]] Memory& memory() { return memory_; }
    [[nodiscard]] const Memory& memory() const { return memory_; }
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
    [[nodiscard]] bool condition(Condition condition) const;
    void sequence(const MicroWord& word);
    [[nodiscard]] bool moves_data(ControlSignals controls) const;
    void use_bus(ControlSignals controls);
    void begin_data(BusCycle cycle, std::uint8_t data);
    void write_data();
    void count(const MicroWord& word);
    void move_data(ControlSignals controls);
    void take_opcode();
    void take_byte();
    void count_chord();
    void store_register();
    void store_number(Register target);
    void turn_page();
    void publish();
    void hand_over_command();
    void write_byte();
    template <class Arithmetic> void one_clock(const Kernel<Arithmetic>& kernel);

    [[nodiscard]] Word& reg(Register name) { return register_of(state_, name); }
    [[nodiscard]] Word reg(Register name) const { return register_of(state_, name); }

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
