// The processor as synthesizable Verilog (IEEE 1364-2001), generated from the tables and the microprogram
// that the model uses: control unit, register file, arithmetic unit with Pre and Post, and interface unit,
// each a module of its own (thesis figures 2.11 to 2.13 and 3.2 to 4.6). Test benches compare it with the
// model in every clock: pins, registers, what is handed to the motion controller, and why it stops.
#pragma once

#include "core/cordic/processor_state.h"
#include "core/cordic_rtl/rtl.h"

#include <cstdint>
#include <span>
#include <vector>

namespace millwright::cordic {

/// The modules, gcode_processor_tb.v with program.hex, expected.hex and records.hex, and micro_sequencer_tb.v
/// with sequencer.hex. The bench runs the programs one after the other, each after a reset, to the clock in
/// which the processor stops. Throws Error unless the programs are of one fixed-point format and the settings
/// are those of hardware: a sequence that reaches every direction, and sign(0) = 1.
[[nodiscard]] std::vector<RtlFile> make_processor_rtl(const ProcessorSettings& settings,
                                                      std::span<const Image> programs);

/// Programs that meet every instruction, and every way to stop: a long one of about `instructions` random
/// instructions, chosen by `seed`, and short ones that end in an error each.
[[nodiscard]] std::vector<Image>
rtl_test_programs(const NumberFormat& format, std::int64_t instructions, std::uint64_t seed);

} // namespace millwright::cordic
