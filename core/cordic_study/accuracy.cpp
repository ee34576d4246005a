#include "core/cordic_study/accuracy.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/cordic/kernel.h"
#include "core/cordic/quadrant_fold.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace millwright::cordic {
namespace {

constexpr std::int64_t sample_chunk = 4096;
constexpr int most_exhaustive_bits = 24;
constexpr double measured_linear_x = 1.2345678; // shifts of 1 itself would not be rounded
constexpr double convergence_share = 0.999;     // of the range: inputs are rounded into the format

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
    /// The same without reducing z, which is within the convergence range, in any coordinate system.
    void rotate_raw(double theta, Number z, Accuracy& worst) const {
        const Number x = number(std::cos(theta));
        const Number y = number(std::sin(theta));
        const auto turned = kernel_.rotated({x, y, z}, overflow_);
        const auto [exact_x, exact_y] = exactly_rotated(exact(x), exact(y), exact(z));
        const auto error = std::hypot(exact(turned.x) - exact_x, exact(turned.y) - exact_y);
        worst.rotation = std::max(worst.rotation, static_cast<double>(error));
        ++worst.count;
    }
    /// (x, y) onto the x axis of the linear or hyperbolic system.
    void vector_raw(Number x, Number y, Accuracy& worst) const {
        const auto found = kernel_.vectored({x, y, Number{}}, overflow_);
        const long double a = exact(x);
        const long double b = exact(y);
        const bool linear = kernel_.sequence().m == CoordinateSystem::linear;
        const long double z = linear ? b / a : std::atanh(b / a);
        const long double length = linear ? a : std::sqrt((a - b) * (a + b));
        worst.angle = std::max(worst.angle, static_cast<double>(std::abs(exact(found.z) - z)));
        worst.length = std::max(worst.length, static_cast<double>(std::abs(exact(found.x) - length)));
    }
    void vector(double theta, Accuracy& worst) const {
        ++worst.count;
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
    [[nodiscard]] std::pair<long double, long double>
    exactly_rotated(long double x, long double y, long double z) const {
        if (kernel_.sequence().m == CoordinateSystem::linear) {
            return {x, y + x * z};
        }
        return {x * std::cosh(z) + y * std::sinh(z), y * std::cosh(z) + x * std::sinh(z)};
    }
    [[nodiscard]] long double exact(Number value) const {
        return static_cast<long double>(arithmetic_.to_double(value));
    }

    Arithmetic arithmetic_;
    Kernel<Arithmetic> kernel_;
    mutable bool overflow_ = false;
};

/// Calls a meter with input `n` of `count`.
auto inputs_of(const NumberFormat& format,
               const Sequence& sequence,
               const Sampling& sampling,
               std::int64_t count) {
    const bool exhaustive = !sampling.random;
    const bool circular = sequence.m == CoordinateSystem::circular;
    const double widest = is_fixed(format) ? std::min(std::ldexp(1.0, format.integer_bits - 1), 4.0) : 4.0;
    const double most_z = convergence_share * (circular ? widest : convergence_range(sequence));
    const double x = sequence.m == CoordinateSystem::linear ? measured_linear_x : 1.0;
    const double most_y = convergence_share * vectoring_range(sequence) * x;
    const std::uint64_t seed = sampling.seed;
    const int fraction_bits = format.fraction_bits;
    return [=](std::int64_t n, const auto& meter, Accuracy& worst) {
        const auto index = static_cast<std::uint64_t>(2 * n);
        const double turn =
            exhaustive ? static_cast<double>(n) / static_cast<double>(count) : random_fraction(seed, index);
        const double theta = 2.0 * std::numbers::pi * turn;
        const double word = std::ldexp(static_cast<double>(n - count / 2), -fraction_bits);
        const double z = exhaustive ? word : most_z * random_fraction(seed, index + 1);
        if (circular) {
            meter.rotate(exhaustive ? 0.0 : theta, meter.number(z), worst);
            meter.vector(theta, worst);
            return;
        }
        if (std::abs(z) <= most_z) {
            meter.rotate_raw(theta, meter.number(z), worst);
        }
        const double y = exhaustive ? word : most_y * turn;
        if (std::abs(y) <= most_y) {
            meter.vector_raw(meter.number(x), meter.number(y), worst);
        }
    };
}

} // namespace

int measured_integer_bits(CoordinateSystem m) {
    switch (m) {
    case CoordinateSystem::linear:
        return 3; // up to 2.3
    case CoordinateSystem::hyperbolic:
        return 4; // up to 6.4
    case CoordinateSystem::circular:
        break;
    }
    return 2;
}

Accuracy measure_accuracy(const NumberFormat& format,
                          const Sequence& sequence,
                          const Sampling& sampling,
                          const Progress& progress) {
    const bool exhaustive = !sampling.random;
    expects(!exhaustive || (is_fixed(format) && format.word() <= most_exhaustive_bits),
            "every word is tried for short fixed-point words only");
    const std::int64_t count =
        exhaustive ? std::int64_t{1} << std::min(format.word(), most_exhaustive_bits) : *sampling.random;
    expects(!is_fixed(format) || format.integer_bits >= measured_integer_bits(sequence.m),
            "a unit vector, its gain and its rotations fit the format");
    const std::int64_t chunks = (count + sample_chunk - 1) / sample_chunk;
    std::vector<Accuracy> found(static_cast<std::size_t>(chunks));
    with_arithmetic(format, [&](const auto& arithmetic) {
        const auto tries = inputs_of(format, sequence, sampling, count);
        parallel_for(chunks, 1, [&](std::ptrdiff_t c) {
            progress.check();
            const Meter meter(arithmetic, sequence);
            Accuracy& worst = found[static_cast<std::size_t>(c)];
            const std::int64_t end = std::min(count, (c + 1) * sample_chunk);
            for (std::int64_t n = c * sample_chunk; n < end; ++n) {
                tries(n, meter, worst);
            }
            meter.check();
        });
    });
    Accuracy all;
    for (const Accuracy& part : found) {
        all.count += part.count;
        all.rotation = std::max(all.rotation, part.rotation);
        all.angle = std::max(all.angle, part.angle);
        all.length = std::max(all.length, part.length);
    }
    return all;
}

} // namespace millwright::cordic
