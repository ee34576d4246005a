// The iteration in a number format that is known only at run time.
#pragma once

#include "core/cordic/arithmetic.h"
#include "core/cordic/kernel.h"
#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <variant>

namespace millwright::cordic {

using AnyKernel =
    std::variant<Kernel<FloatArithmetic<double>>, Kernel<FloatArithmetic<float>>, Kernel<FixedArithmetic>>;

[[nodiscard]] inline AnyKernel
any_kernel(const NumberFormat& format, const Sequence& sequence, SignOfZero zero) {
    return with_arithmetic(
        format, [&](const auto& arithmetic) { return AnyKernel(Kernel(arithmetic, sequence, zero)); });
}

} // namespace millwright::cordic
