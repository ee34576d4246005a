#include "core/cordic/accuracy.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/cordic/fold.h"
#include "core/cordic/kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace millwright::cordic {
namespace {

constexpr double sqrt_2 = std::numbers::sqrt2;
constexpr double of_double = 1e-15; // what the bounds lose by being computed in binary64 themselves

bool is_fixed(const NumberFormat& format) {
    return format.kind == NumberKind::fixed;
}

/// Largest error of one shift, in units of the last place (fixed point).
double shift_error(const NumberFormat& format) {
    const bool halves = format.rounding == Rounding::nearest || format.rounding == Rounding::nearest_even;
    return (halves ? 0.5 : 1.0) * resolution(format);
}

/// Largest relative error of one operation (floating point).
double operation_error(const NumberFormat& format) {
    return is_fixed(format) ? 0.0 : 0.5 * resolution(format);
}

struct Step {
    double angle = 0.0;       ///< exact
    double angle_error = 0.0; ///< of the angle as the format holds it
    double gain = 0.0;
    double rounding = 0.0; ///< of the vector, absolute (fixed point)
};

std::vector<Step> steps_of(const NumberFormat& format, const Sequence& sequence) {
    std::vector<Step> steps;
    for (int i = 0; i < sequence.step_count; ++i) {
        const int shift = sequence.shifts[static_cast<std::size_t>(i)];
        const Int128 wide = wide_angle(sequence.m, shift);
        const auto exact = to_floating<double>(wide);
        const double error = with_arithmetic(format, [&](const auto& arithmetic) {
            return std::abs(arithmetic.to_double(arithmetic.angle(sequence.m, shift)) - exact);
        });
        steps.push_back({.angle = exact,
                         .angle_error = error + of_double * exact,
                         .gain = std::sqrt(1.0 + std::ldexp(1.0, -2 * shift)),
                         .rounding = is_fixed(format) && shift > 0 ? sqrt_2 * shift_error(format) : 0.0});
    }
    return steps;
}

/// What rounding adds to x and y over steps and corrections: fixed point.
double
absolute_rounding(const NumberFormat& format, const Sequence& sequence, const std::vector<Step>& steps) {
    double error = 0.0;
    for (const Step& step : steps) {
        error = error * step.gain + step.rounding;
    }
    const double once = sqrt_2 * shift_error(format);
    if (sequence.multiplies) {
        return error * correction(sequence) + once;
    }
    for (int j = 0; j < sequence.correction_count; ++j) {
        const int a = sequence.corrections[static_cast<std::size_t>(j)];
        if (a != 0) {
            error = error * (1.0 + (a < 0 ? -1.0 : 1.0) * std::ldexp(1.0, -std::abs(a))) + once;
        }
    }
    return error;
}

double rounding_bound(const NumberFormat& format,
                      const Sequence& sequence,
                      const std::vector<Step>& steps,
                      double length) {
    if (is_fixed(format)) {
        return absolute_rounding(format, sequence, steps);
    }
    const int operations = sequence.step_count + (sequence.multiplies ? 2 : sequence.correction_count);
    return length * std::expm1(operations * std::log1p(operation_error(format)));
}

double gain_error(const Sequence& sequence) {
    return std::abs(gain(sequence) * correction(sequence) - 1.0) + of_double;
}

} // namespace

RotationBound rotation_bound(const NumberFormat& format, const Sequence& sequence, double length) {
    expects(sequence.m == CoordinateSystem::circular, "bounds are for circular sequences");
    const auto steps = steps_of(format, sequence);
    double left = convergence_range(sequence);
    double wrong = 0.0;
    for (const Step& step : steps) {
        left = std::max(step.angle, left - step.angle) + step.angle_error;
        const double rounded = operation_error(format) * left;
        left += rounded;
        wrong += rounded + step.angle_error;
    }
    RotationBound bound;
    bound.angle = left + wrong;
    bound.gain = gain_error(sequence);
    bound.rounding = rounding_bound(format, sequence, steps, length);
    bound.total = length * (bound.angle + bound.gain) + bound.rounding;
    return bound;
}

VectoringBound vectoring_bound(const NumberFormat& format, const Sequence& sequence, double length) {
    expects(sequence.m == CoordinateSystem::circular, "bounds are for circular sequences");
    const auto steps = steps_of(format, sequence);
    double left = convergence_range(sequence);
    double wrong = 0.0;
    double turned = 0.0; // largest |z|
    double shortest = length;
    for (const Step& step : steps) {
        const double turned_length = step.gain * shortest;
        const double rounding = step.rounding + operation_error(format) * turned_length;
        if (!(rounding < turned_length)) {
            return {std::numbers::pi, length + rounding_bound(format, sequence, steps, length)};
        }
        const double bent = std::asin(rounding / turned_length);
        shortest = turned_length - rounding;
        left = std::max(step.angle, left - step.angle) + bent;
        turned += step.angle + step.angle_error;
        wrong += bent + step.angle_error + operation_error(format) * turned;
    }
    return {std::min(left + wrong, std::numbers::pi),
            length * (gain_error(sequence) + 0.5 * left * left) +
                rounding_bound(format, sequence, steps, length)};
}

namespace {

constexpr std::int64_t sample_chunk = 4096;
constexpr int most_exhaustive_bits = 24;

/// splitmix64: number `index` of a stream, so that threads need not share one.
std::uint64_t random_word(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t z = seed + (index + 1) * 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

/// -1 to 1.
double random_fraction(std::uint64_t seed, std::uint64_t index) {
    return static_cast<double>(static_cast<std::int64_t>(random_word(seed, index))) * 0x1p-63;
}

template <class Arithmetic> class Meter {
public:
    Meter(const Arithmetic& arithmetic, const Sequence& sequence)
        : arithmetic_(arithmetic), kernel_(arithmetic, sequence) {}

    using Number = typename Arithmetic::Number;

    /// A vector of direction `theta` rotated by z, compared with the exact rotation of what the format holds.
    void rotate(double theta, Number z, Accuracy& worst) const {
        const auto [turns, rest, too_large] = reduced(arithmetic_, z);
        expects(!too_large, "measured angles can be reduced");
        Number x = number(std::cos(theta));
        Number y = number(std::sin(theta));
        const long double from_x = exact(x);
        const long double from_y = exact(y);
        quarter_turn(arithmetic_, x, y, turns, overflow_);
        const auto turned = kernel_.rotated({x, y, rest}, overflow_);
        const long double c = std::cos(exact(z));
        const long double s = std::sin(exact(z));
        const auto error = std::hypot(exact(turned.x) - (from_x * c - from_y * s),
                                      exact(turned.y) - (from_y * c + from_x * s));
        worst.rotation = std::max(worst.rotation, static_cast<double>(error));
    }
    void vector(double theta, Accuracy& worst) const {
        const Number x = number(std::cos(theta));
        const Number y = number(std::sin(theta));
        const auto folded = pre(arithmetic_, x, y, overflow_);
        const auto found = kernel_.vectored({folded.x, folded.y, Number{}}, overflow_);
        const long double a = exact(folded.x);
        const long double b = exact(folded.y);
        worst.angle = std::max(worst.angle, static_cast<double>(std::abs(exact(found.z) - std::atan2(b, a))));
        worst.length =
            std::max(worst.length, static_cast<double>(std::abs(exact(found.x) - std::hypot(a, b))));
    }
    [[nodiscard]] Number number(double value) const { return arithmetic_.from_double(value, overflow_); }
    void check() const { expects(!overflow_, "measured vectors fit the format"); }

private:
    [[nodiscard]] long double exact(Number value) const {
        return static_cast<long double>(arithmetic_.to_double(value));
    }

    Arithmetic arithmetic_;
    Kernel<Arithmetic> kernel_;
    mutable bool overflow_ = false;
};

} // namespace

Accuracy measure_accuracy(const NumberFormat& format,
                          const Sequence& sequence,
                          const Sampling& sampling,
                          const Progress& progress) {
    const bool exhaustive = !sampling.random;
    expects(!exhaustive || (is_fixed(format) && format.word() <= most_exhaustive_bits),
            "every word is tried for short fixed-point words only");
    const std::int64_t count =
        exhaustive ? std::int64_t{1} << std::min(format.word(), most_exhaustive_bits) : *sampling.random;
    expects(!is_fixed(format) || format.integer_bits >= 2, "a unit vector and its gain fit the format");
    const double widest = is_fixed(format) ? std::min(std::ldexp(1.0, format.integer_bits - 1), 4.0) : 4.0;
    const std::int64_t half = count / 2;
    const std::int64_t chunks = (count + sample_chunk - 1) / sample_chunk;
    std::vector<Accuracy> found(static_cast<std::size_t>(chunks));
    with_arithmetic(format, [&](const auto& arithmetic) {
        const auto measure = [&](std::int64_t n, Accuracy& worst, const auto& meter) {
            const auto index = static_cast<std::uint64_t>(2 * n);
            const double turn = exhaustive ? static_cast<double>(n) / static_cast<double>(count)
                                           : random_fraction(sampling.seed, index);
            const double theta = 2.0 * std::numbers::pi * turn;
            const double angle = exhaustive ? std::ldexp(static_cast<double>(n - half), -format.fraction_bits)
                                            : widest * 0.999 * random_fraction(sampling.seed, index + 1);
            meter.rotate(exhaustive ? 0.0 : theta, meter.number(angle), worst);
            meter.vector(theta, worst);
        };
        parallel_for(chunks, 1, [&](std::ptrdiff_t c) {
            progress.check();
            const Meter meter(arithmetic, sequence);
            Accuracy& worst = found[static_cast<std::size_t>(c)];
            const std::int64_t end = std::min(count, (c + 1) * sample_chunk);
            for (std::int64_t n = c * sample_chunk; n < end; ++n) {
                measure(n, worst, meter);
            }
            meter.check();
        });
    });
    Accuracy all{.count = count};
    for (const Accuracy& part : found) {
        all.rotation = std::max(all.rotation, part.rotation);
        all.angle = std::max(all.angle, part.angle);
        all.length = std::max(all.length, part.length);
    }
    return all;
}

} // namespace millwright::cordic
