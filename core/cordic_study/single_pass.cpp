#include "core/cordic_study/single_pass.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/cordic/arithmetic.h"
#include "core/cordic/kernel.h"
#include "core/cordic/quadrant_fold.h"
#include "core/cordic_study/internal/entered_numbers.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

namespace millwright::cordic {

namespace {

constexpr const char* room_for_a_pass =
    "choose a format with room for the vector, the result and the gain in between";

/// The range in a message, rounded towards 0: what it names is inside.
double rounded_inwards(double range) {
    constexpr double steps_per_unit = 1e5;
    return std::floor(range * steps_per_unit) / steps_per_unit;
}

const char* unit_of(CoordinateSystem m) {
    return m == CoordinateSystem::linear ? "" : " rad";
}

void refuse_rotation(const Sequence& sequence, const PassInput& input, double range) {
    throw Error(fmt::format("z = {}{} is outside the convergence range: |z| <= {:.5f}{} with {} {} steps",
                            input.z.nearest_double(),
                            unit_of(sequence.m),
                            rounded_inwards(range),
                            unit_of(sequence.m),
                            sequence.step_count,
                            to_text(sequence.m)));
}

void refuse_vectoring(const Sequence& sequence, const PassInput& input) {
    const double range = vectoring_range(sequence);
    const std::string vector = fmt::format("({}, {})", input.x.nearest_double(), input.y.nearest_double());
    if (sequence.m == CoordinateSystem::circular) {
        throw Error(fmt::format("the direction of {} is outside the convergence range: {:.5f} degrees to "
                                "either side of the x axis with {}",
                                vector,
                                rounded_inwards(to_degrees(range)),
                                counted(sequence.step_count, "step")),
                    {},
                    input.folds ? "use more iterations"
                                : "use folding, which brings every direction into the range");
    }
    throw Error(fmt::format("{} is outside the convergence range: x > 0 and |y/x| <= {:.5f} with {} {} steps",
                            vector,
                            rounded_inwards(range),
                            sequence.step_count,
                            to_text(sequence.m)));
}

struct ExactVector {
    long double x = 0.0L, y = 0.0L, z = 0.0L;
};

/// Table 3.2, rotation: z is used up.
ExactVector exact_rotation(CoordinateSystem m, const ExactVector& v) {
    switch (m) {
    case CoordinateSystem::linear:
        return {v.x, v.y + v.x * v.z};
    case CoordinateSystem::hyperbolic: {
        const long double c = std::cosh(v.z);
        const long double s = std::sinh(v.z);
        return {v.x * c + v.y * s, v.y * c + v.x * s};
    }
    case CoordinateSystem::circular:
        break;
    }
    const long double c = std::cos(v.z);
    const long double s = std::sin(v.z);
    return {v.x * c - v.y * s, v.y * c + v.x * s};
}

/// Table 3.2, vectoring: y is used up.
ExactVector exact_vectoring(CoordinateSystem m, const ExactVector& v) {
    switch (m) {
    case CoordinateSystem::linear:
        return {v.x, 0.0L, v.z + v.y / v.x};
    case CoordinateSystem::hyperbolic:
        return {std::sqrt((v.x - v.y) * (v.x + v.y)), 0.0L, v.z + std::atanh(v.y / v.x)};
    case CoordinateSystem::circular:
        break;
    }
    return {std::hypot(v.x, v.y), 0.0L, v.z + std::atan2(v.y, v.x)};
}

/// What pre() did with the vector that the format holds, with the one that was given.
ExactVector folded_as(const ExactVector& given, bool f1, bool f2) {
    ExactVector v = f1 ? ExactVector{given.y, -given.x, given.z} : given;
    if (f2) {
        v.x = -v.x;
        v.y = -v.y;
    }
    return v;
}

/// The pass, with all that is on the way.
template <class Arithmetic>
Vector3<typename Arithmetic::Number> iterated(const Kernel<Arithmetic>& kernel,
                                              Mode mode,
                                              Vector3<typename Arithmetic::Number> v,
                                              std::vector<PassStep>& steps,
                                              bool& overflow) {
    const Arithmetic& arithmetic = kernel.arithmetic();
    const auto keep = [&](bool corrects) {
        steps.push_back(
            {arithmetic.to_double(v.x), arithmetic.to_double(v.y), arithmetic.to_double(v.z), corrects});
    };
    const Sequence& sequence = kernel.sequence();
    keep(false);
    for (int i = 0; i < sequence.step_count; ++i) {
        kernel.step(v, i, kernel.direction(mode, v), overflow);
        keep(false);
    }
    if (sequence.multiplies) {
        v.x = kernel.multiplied(v.x, overflow);
        v.y = kernel.multiplied(v.y, overflow);
        keep(true);
    }
    for (int j = 0; j < sequence.correction_count; ++j) {
        v.x = kernel.corrected(v.x, j, overflow);
        v.y = kernel.corrected(v.y, j, overflow);
        keep(true);
    }
    return v;
}

/// Throws Error for what the steps do not turn to the end, but for a circular rotation.
template <class Arithmetic>
void refuse_unreached(const Kernel<Arithmetic>& kernel,
                      const NumberFormat& format,
                      const PassInput& input,
                      const Vector3<typename Arithmetic::Number>& v) {
    const Sequence& sequence = kernel.sequence();
    const Reach direction = kernel.reach_of_vectoring(v.x, v.y);
    internal::refuse_vanished(format, input.x, input.y, direction != Reach::zero_vector);
    if (input.mode == Mode::rotation) {
        const bool takes_any_z = sequence.m == CoordinateSystem::circular;
        if (!takes_any_z && kernel.reach_of_rotation(v.z) != Reach::inside) {
            refuse_rotation(sequence, input, kernel.rotation_range());
        }
        return;
    }
    if (direction == Reach::zero_vector && sequence.m == CoordinateSystem::circular) {
        throw Error(fmt::format("(0, 0) has no direction in {}", to_text(format)));
    }
    if (direction != Reach::inside) {
        refuse_vectoring(sequence, input);
    }
}

} // namespace

SinglePass single_pass(const NumberFormat& format, const Sequence& sequence, const PassInput& input) {
    if (input.folds && sequence.m != CoordinateSystem::circular) {
        throw Error(fmt::format("folding is only possible in the circular system, not in the {} system",
                                to_text(sequence.m)));
    }
    return with_arithmetic(format, [&](const auto& arithmetic) {
        const Kernel kernel(arithmetic, sequence, input.zero);
        using Number = typename std::decay_t<decltype(arithmetic)>::Number;
        bool overflow = false;
        const Number x = internal::entered(arithmetic, format, input.x);
        const Number y = internal::entered(arithmetic, format, input.y);
        const Number z = internal::entered(arithmetic, format, input.z);
        const Folded<Number> folded =
            input.folds ? pre(arithmetic, x, y, overflow) : Folded<Number>{.x = x, .y = y};
        const Vector3<Number> start{folded.x, folded.y, z};
        refuse_unreached(kernel, format, input, start);
        SinglePass answer{.f1 = folded.f1, .f2 = folded.f2, .clocks = sequence.clock_count()};
        auto v = iterated(kernel, input.mode, start, answer.steps, overflow);
        const ExactVector given{
            input.x.nearest_long_double(), input.y.nearest_long_double(), input.z.nearest_long_double()};
        ExactVector exact;
        if (input.mode == Mode::rotation) {
            const Folded<Number> back =
                post(arithmetic, Folded<Number>{v.x, v.y, folded.f1, folded.f2}, overflow);
            v.x = back.x;
            v.y = back.y;
            exact = exact_rotation(sequence.m, given);
            answer.error = static_cast<double>(std::hypot(internal::exactly(arithmetic, v.x) - exact.x,
                                                          internal::exactly(arithmetic, v.y) - exact.y));
        } else {
            exact = exact_vectoring(sequence.m, folded_as(given, folded.f1, folded.f2));
            answer.error = static_cast<double>(std::abs(internal::exactly(arithmetic, v.x) - exact.x));
            answer.quarter_turns = quarter_turns_of(folded);
        }
        internal::refuse_overflow(overflow, format, room_for_a_pass);
        answer.z_error = static_cast<double>(std::abs(internal::exactly(arithmetic, v.z) - exact.z));
        answer.x = arithmetic.to_double(v.x);
        answer.y = arithmetic.to_double(v.y);
        answer.z = arithmetic.to_double(v.z);
        answer.exact_x = static_cast<double>(exact.x);
        answer.exact_y = static_cast<double>(exact.y);
        answer.exact_z = static_cast<double>(exact.z);
        answer.words = internal::words_of_vector(arithmetic, format, v);
        return answer;
    });
}

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
