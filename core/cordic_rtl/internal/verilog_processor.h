// The processor as Verilog, module by module, and what its test bench compares.
#pragma once

#include "core/cordic/microcode.h"
#include "core/cordic/processor.h"
#include "core/cordic_rtl/internal/verilog.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::cordic::internal {

void replace_all(std::string& text, std::string_view name, std::string_view value);

/// Every control signal as a wire of its name.
[[nodiscard]] std::string control_wires();

[[nodiscard]] std::string sequencer_module(const Verilog& verilog);
[[nodiscard]] std::string control_module(const Verilog& verilog, const Microprogram& program);
[[nodiscard]] std::string fold_modules(const Verilog& verilog);
[[nodiscard]] std::string arithmetic_module(const Verilog& verilog, bool halves_acceleration);
[[nodiscard]] std::string bus_module(const Verilog& verilog);
[[nodiscard]] std::string register_module(const Verilog& verilog, const NumberFormat& format);
[[nodiscard]] std::string
processor_module(const Verilog& verilog, const NumberFormat& format, const ProcessorSettings& settings);

/// What the benches read.
struct ProcessorVectors {
    std::string program;  ///< memory of the programs, byte by byte
    std::string expected; ///< one line per instruction that ends, and where the processor stops
    std::string records;  ///< one line per set-point and command
    std::vector<int> first_pages;
    std::vector<int> pages;
    std::int64_t instructions = 0;
    std::int64_t lines = 0;
    std::int64_t record_count = 0;
    std::int64_t most_clocks = 0; ///< of a program
};

/// Executes the programs one after the other, each after a reset. Throws Error for one that has more than
/// `most_clocks` clocks.
[[nodiscard]] ProcessorVectors processor_vectors(const Verilog& verilog,
                                                 const ProcessorSettings& settings,
                                                 std::span<const Image> programs,
                                                 std::int64_t most_clocks);
[[nodiscard]] std::string processor_bench(const Verilog& verilog,
                                          const NumberFormat& format,
                                          const ProcessorSettings& settings,
                                          const ProcessorVectors& vectors);

[[nodiscard]] std::string sequencer_vectors(std::int64_t count, std::uint64_t seed);
[[nodiscard]] std::string sequencer_bench(const Verilog& verilog, std::int64_t count);

} // namespace millwright::cordic::internal
