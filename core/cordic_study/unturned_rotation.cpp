#include "core/cordic_study/unturned_rotation.h"

#include "core/cordic/arithmetic.h"
#include "core/cordic/kernel.h"
#include "core/cordic_study/internal/entered_numbers.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::cordic {

std::optional<double>
exceeded_range(const NumberFormat& format, const Sequence& sequence, const PassInput& input) {
    if (input.mode != Mode::rotation) {
        return std::nullopt;
    }
    return with_arithmetic(format, [&](const auto& arithmetic) -> std::optional<double> {
        const Kernel kernel(arithmetic, sequence, input.zero);
        if (kernel.reach_of_rotation(internal::entered(arithmetic, format, input.z)) == Reach::inside) {
            return std::nullopt;
        }
        constexpr double steps_per_unit = 1e5;
        return std::floor(kernel.rotation_range() * steps_per_unit) / steps_per_unit;
    });
}

std::string unturned_text(const PassInput& input, double range) {
    return fmt::format(
        "z = {} rad is outside the convergence range, |z| <= {:.5f} rad: the vector is not turned by "
        "all of it, and z is what is left",
        input.z.nearest_double(),
        range);
}

} // namespace millwright::cordic
