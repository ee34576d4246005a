#include "core/cordic_rtl/rtl.h"

#include "core/cordic_rtl/internal/verilog.h"

#include <fmt/format.h>

namespace millwright::cordic {

Error no_hardware_of(const NumberFormat& format) {
    return Error(fmt::format("hardware can only be generated for fixed point, not for {}", to_text(format)),
                 {},
                 "use a format such as q2.22, for which a shift is a wire; floating point would need an "
                 "adder that aligns, normalises and rounds in each step, which is not generated");
}

std::vector<RtlFile> make_rtl(const NumberFormat& format,
                              const Sequence& sequence,
                              std::int64_t vector_count,
                              std::uint64_t seed) {
    if (format.kind != NumberKind::fixed) {
        throw no_hardware_of(format);
    }
    expects(vector_count > 0, "a test bench has vectors");
    const internal::Verilog verilog(format, sequence);
    return {{"cordic_core.v", internal::core_module(verilog)},
            {"cordic_pipeline.v", internal::pipeline_module(verilog)},
            {"cordic_core_tb.v", internal::core_bench(verilog, vector_count)},
            {"cordic_pipeline_tb.v", internal::pipeline_bench(verilog, vector_count)},
            {"vectors.hex", internal::test_vectors(verilog, vector_count, seed)}};
}

} // namespace millwright::cordic
