#include "core/cordic/sequence.h"

#include "core/base/error.h"
#include "core/cordic/angles.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::cordic {

std::string_view to_text(CoordinateSystem m) {
    switch (m) {
    case CoordinateSystem::linear:
        return "linear";
    case CoordinateSystem::hyperbolic:
        return "hyperbolic";
    case CoordinateSystem::circular:
        break;
    }
    return "circular";
}

CoordinateSystem parse_coordinate_system(std::string_view text) {
    for (const auto m :
         {CoordinateSystem::circular, CoordinateSystem::linear, CoordinateSystem::hyperbolic}) {
        if (to_text(m) == text) {
            return m;
        }
    }
    throw Error(
        fmt::format("\"{}\" is not a coordinate system", text), {}, "use circular, linear or hyperbolic");
}

double gain(const Sequence& sequence) {
    double square = 1.0;
    for (int i = 0; i < sequence.step_count; ++i) {
        square *= 1.0 + sign_of(sequence.m) *
                            power_of_two<double>(-2 * sequence.shifts[static_cast<std::size_t>(i)]);
    }
    return std::sqrt(square);
}

double correction(const Sequence& sequence) {
    if (sequence.multiplies) {
        return static_cast<double>(inverse_gain(sequence)) * power_of_two<double>(-gain_places);
    }
    double product = 1.0;
    for (int j = 0; j < sequence.correction_count; ++j) {
        const int a = sequence.corrections[static_cast<std::size_t>(j)];
        if (a != 0) {
            product *= 1.0 + (a < 0 ? -1 : 1) * power_of_two<double>(a < 0 ? a : -a);
        }
    }
    return product;
}

double convergence_range(const Sequence& sequence) {
    Int128 sum = 0;
    for (int i = 0; i < sequence.step_count; ++i) {
        sum += wide_angle(sequence.m, sequence.shifts[static_cast<std::size_t>(i)]);
    }
    return to_floating<double>(sum);
}

double vectoring_range(const Sequence& sequence) {
    const double range = convergence_range(sequence);
    return sequence.m == CoordinateSystem::hyperbolic ? std::tanh(range) : range;
}

} // namespace millwright::cordic
