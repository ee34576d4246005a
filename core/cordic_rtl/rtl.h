// The iteration as synthesizable Verilog (IEEE 1364-2001), generated from the tables that the model uses: one
// core that does a step in each clock, one pipeline that takes a vector in each clock, and for each a test
// bench that compares it with vectors of the model.
#pragma once

#include "core/base/error.h"
#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <cstdint>
#include <string>
#include <vector>

namespace millwright::cordic {

struct RtlFile {
    std::string name; ///< cordic_core.v, cordic_pipeline.v, a bench of each as cordic_core_tb.v, vectors.hex
    std::string text;
};

/// Why there is no hardware of a format that is not fixed point.
[[nodiscard]] Error no_hardware_of(const NumberFormat& format);

/// Throws Error unless `format` is fixed point. `vector_count` random inputs, rotations and vectorings in
/// turn, a few of them so large that they overflow, go into vectors.hex with the model's results.
[[nodiscard]] std::vector<RtlFile>
make_rtl(const NumberFormat& format, const Sequence& sequence, std::int64_t vector_count, std::uint64_t seed);

} // namespace millwright::cordic
