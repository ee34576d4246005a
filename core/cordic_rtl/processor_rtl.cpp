#include "core/cordic_rtl/processor_rtl.h"

#include "core/base/error.h"
#include "core/cordic_rtl/internal/verilog_processor.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace millwright::cordic {
namespace {

constexpr std::int64_t most_simulated_clocks = 5'000'000;
constexpr std::int64_t sequencer_operations = 4000;
constexpr std::uint64_t sequencer_seed = 1;

void expect_hardware(const ProcessorSettings& settings, std::span<const Image> programs) {
    expects(!programs.empty(), "a test bench has a program");
    const NumberFormat& format = programs.front().format;
    expects(std::ranges::all_of(programs, [&](const Image& image) { return image.format == format; }),
            "the programs of a test bench have one format");
    if (!is_fixed(format)) {
        throw no_hardware_of(format);
    }
    if (settings.zero != SignOfZero::positive) {
        throw Error("hardware turns in every step: sign(0) is 1",
                    {},
                    "leave out --matlab-zero, and .zero matlab in assembly source");
    }
    // Pre leaves directions of up to 90 degrees; the model looks for those that the steps do not reach.
    if (vectoring_range(settings.sequence) < std::numbers::pi / 2.0) {
        throw Error(fmt::format("{} steps do not cover every direction", settings.sequence.step_count),
                    {},
                    "use 4 or more iterations");
    }
}

} // namespace

std::vector<RtlFile> make_processor_rtl(const ProcessorSettings& settings, std::span<const Image> programs) {
    expect_hardware(settings, programs);
    const NumberFormat format = with_rounding(programs.front().format, settings.rounding);
    const internal::Verilog verilog(format, settings.sequence);
    const Microprogram microprogram = make_microprogram(settings.sequence, format, settings.publishing);
    internal::ProcessorVectors vectors =
        internal::processor_vectors(verilog, settings, programs, most_simulated_clocks);
    return {{"micro_sequencer.v", internal::sequencer_module(verilog)},
            {"control_unit.v", internal::control_module(verilog, microprogram)},
            {"fold.v", internal::fold_modules(verilog)},
            {"arithmetic_unit.v", internal::arithmetic_module(verilog, settings.halves_acceleration)},
            {"bus_unit.v", internal::bus_module(verilog)},
            {"register_file.v", internal::register_module(verilog, format)},
            {"gcode_processor.v", internal::processor_module(verilog, format, settings)},
            {"gcode_processor_tb.v", internal::processor_bench(verilog, format, settings, vectors)},
            {"micro_sequencer_tb.v", internal::sequencer_bench(verilog, sequencer_operations)},
            {"sequencer.hex", internal::sequencer_vectors(sequencer_operations, sequencer_seed)},
            {"program.hex", std::move(vectors.program)},
            {"expected.hex", std::move(vectors.expected)},
            {"records.hex", std::move(vectors.records)}};
}

} // namespace millwright::cordic
