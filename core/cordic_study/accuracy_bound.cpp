#include "core/cordic/arithmetic.h"
#include "core/cordic_study/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace millwright::cordic {
namespace {

constexpr double sqrt_2 = std::numbers::sqrt2;
constexpr double of_double = 1e-15; // what the bounds lose by being computed in binary64 themselves

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
    double tangent = 0.0;     ///< 2^-shift
    double gain = 0.0;        ///< circular
    double rounding = 0.0;    ///< of one coordinate, absolute (fixed point)
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
                         .tangent = std::ldexp(1.0, -shift),
                         .gain = std::sqrt(1.0 + std::ldexp(1.0, -2 * shift)),
                         .rounding = is_fixed(format) && shift > 0 ? shift_error(format) : 0.0});
    }
    return steps;
}

/// What rounding adds to x and y over steps and corrections: fixed point.
double
absolute_rounding(const NumberFormat& format, const Sequence& sequence, const std::vector<Step>& steps) {
    double error = 0.0;
    for (const Step& step : steps) {
        error = error * step.gain + sqrt_2 * step.rounding;
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

/// By how much z, of the convergence range at most, is turned wrongly: what is left of it behind the steps,
/// and the errors of the angles and of z itself.
double angle_bound(const NumberFormat& format, const Sequence& sequence, const std::vector<Step>& steps) {
    double left = convergence_range(sequence);
    double wrong = 0.0;
    for (const Step& step : steps) {
        left = std::max(step.angle, left - step.angle) + step.angle_error;
        const double rounded = operation_error(format) * left;
        left += rounded;
        wrong += rounded + step.angle_error;
    }
    return left + wrong;
}

/// The length of a vector and the error of it, along steps and corrections.
struct Growth {
    double length = 0.0;
    double error = 0.0;

    /// An operation that multiplies both by `factor` at most and rounds: by so much, and by a part of what
    /// comes out.
    void grow(double factor, double absolute, double relative) {
        length *= factor;
        error *= factor;
        error += absolute + relative * (length + error);
    }
};

/// The corrections, or the multiplication, of one coordinate (`coordinates` 1) or both (sqrt 2).
void correct(Growth& growth, const NumberFormat& format, const Sequence& sequence, double coordinates) {
    const double once = is_fixed(format) ? coordinates * shift_error(format) : 0.0;
    if (sequence.multiplies) {
        growth.grow(correction(sequence), once, 2.0 * operation_error(format)); // of the factor, too
    }
    for (int j = 0; j < sequence.correction_count; ++j) {
        const int a = sequence.corrections[static_cast<std::size_t>(j)];
        if (a != 0) {
            growth.grow(
                1.0 + (a < 0 ? -1.0 : 1.0) * std::ldexp(1.0, -std::abs(a)), once, operation_error(format));
        }
    }
}

RotationBound hyperbolic_rotation_bound(const NumberFormat& format, const Sequence& sequence, double length) {
    const auto steps = steps_of(format, sequence);
    RotationBound bound{.angle = angle_bound(format, sequence, steps), .gain = gain_error(sequence)};
    Growth growth{.length = length};
    for (const Step& step : steps) {
        growth.grow(1.0 + step.tangent, sqrt_2 * step.rounding, operation_error(format));
    }
    correct(growth, format, sequence, sqrt_2);
    bound.rounding = growth.error;
    const double longest = length * std::exp(convergence_range(sequence)); // of the exact result
    bound.total = longest * (std::expm1(bound.angle) + bound.gain * std::exp(bound.angle)) + bound.rounding;
    return bound;
}

RotationBound linear_rotation_bound(const NumberFormat& format, const Sequence& sequence, double length) {
    const auto steps = steps_of(format, sequence);
    RotationBound bound{.angle = angle_bound(format, sequence, steps)};
    double turned = 0.0; // largest sum of the tangents so far
    for (const Step& step : steps) {
        turned += step.tangent;
        bound.rounding +=
            step.rounding + operation_error(format) * (length * std::hypot(1.0, turned) + bound.rounding);
    }
    bound.total = length * bound.angle + bound.rounding;
    return bound;
}

/// x stays exact, so that only y and z round.
VectoringBound linear_vectoring_bound(const NumberFormat& format, const Sequence& sequence, double x) {
    double left = convergence_range(sequence); // of y/x
    double wrong = 0.0;
    double turned = 0.0; // largest |z|
    for (const Step& step : steps_of(format, sequence)) {
        left = std::max(step.angle, left - step.angle);
        const double bent = step.rounding / x + operation_error(format) * left;
        left += bent;
        turned += step.angle + step.angle_error;
        wrong += bent + step.angle_error + operation_error(format) * turned;
    }
    return {left + wrong, 0.0};
}

/// With p = x + y and q = x - y, whose product is the square of the length l and whose quotient is e^2phi:
/// roundings of x and y by e change both by 2e together, which is most of the smaller one, l e^-|phi|.
VectoringBound hyperbolic_vectoring_bound(const NumberFormat& format, const Sequence& sequence, double x) {
    const double u = operation_error(format);
    double left = convergence_range(sequence); // of phi
    double wrong = 0.0;
    double turned = 0.0;                   // largest |z|
    double shortest = x / std::cosh(left); // of the lengths of all vectors of this x
    double least = 1.0;                    // length, in parts of the exact one
    double most = 1.0;
    for (const Step& step : steps_of(format, sequence)) {
        left = std::max(step.angle, left - step.angle);
        shortest *= std::sqrt((1.0 - step.tangent) * (1.0 + step.tangent));
        const double part =
            2.0 * step.rounding * std::exp(left) / shortest + u * (1.0 + std::exp(2.0 * left));
        if (!(part < 1.0)) {
            return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        }
        const double bent = -0.5 * std::log1p(-part);
        shortest *= std::sqrt(1.0 - part);
        least *= std::sqrt(1.0 - part);
        most *= 1.0 + 0.5 * part;
        left += bent;
        turned += step.angle + step.angle_error;
        wrong += bent + step.angle_error + u * turned;
    }
    const double g = gain_error(sequence);
    const double beside = std::max(most * std::cosh(left) * (1.0 + g) - 1.0, 1.0 - least * (1.0 - g));
    Growth growth{.length = x * most * std::cosh(left) * gain(sequence)};
    correct(growth, format, sequence, 1.0);
    return {left + wrong, x * beside + growth.error};
}

RotationBound circular_rotation_bound(const NumberFormat& format, const Sequence& sequence, double length) {
    const auto steps = steps_of(format, sequence);
    RotationBound bound;
    bound.angle = angle_bound(format, sequence, steps);
    bound.gain = gain_error(sequence);
    bound.rounding = rounding_bound(format, sequence, steps, length);
    bound.total = length * (bound.angle + bound.gain) + bound.rounding;
    return bound;
}

VectoringBound circular_vectoring_bound(const NumberFormat& format, const Sequence& sequence, double length) {
    const auto steps = steps_of(format, sequence);
    double left = convergence_range(sequence);
    double wrong = 0.0;
    double turned = 0.0; // largest |z|
    double shortest = length;
    for (const Step& step : steps) {
        const double turned_length = step.gain * shortest;
        const double rounding = sqrt_2 * step.rounding + operation_error(format) * turned_length;
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

} // namespace

RotationBound rotation_bound(const NumberFormat& format, const Sequence& sequence, double length) {
    switch (sequence.m) {
    case CoordinateSystem::linear:
        return linear_rotation_bound(format, sequence, length);
    case CoordinateSystem::hyperbolic:
        return hyperbolic_rotation_bound(format, sequence, length);
    case CoordinateSystem::circular:
        break;
    }
    return circular_rotation_bound(format, sequence, length);
}

VectoringBound vectoring_bound(const NumberFormat& format, const Sequence& sequence, double size) {
    switch (sequence.m) {
    case CoordinateSystem::linear:
        return linear_vectoring_bound(format, sequence, size);
    case CoordinateSystem::hyperbolic:
        return hyperbolic_vectoring_bound(format, sequence, size);
    case CoordinateSystem::circular:
        break;
    }
    return circular_vectoring_bound(format, sequence, size);
}

} // namespace millwright::cordic
