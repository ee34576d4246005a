// The CORDIC iteration itself, step by step as the hardware does it, in any number format.
// Source: thesis eqs 3.1 to 3.5, without the factor k that is printed in eq. 3.1 (it belongs to the results).
#pragma once

#include "core/cordic/angles.h"
#include "core/cordic/arithmetic.h"
#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <array>
#include <cstdint>
#include <variant>

namespace millwright::cordic {

enum class Mode : std::uint8_t {
    rotation, ///< turns (x, y) by z, driving z to 0
    vectoring ///< turns (x, y) onto the x axis, driving y to 0 and adding the angle to z
};

/// Which way a step turns when there is nothing left to turn.
enum class SignOfZero : std::uint8_t {
    positive, ///< as if it were positive: what hardware does, and what the gain correction needs
    zero      ///< not at all: the thesis's MATLAB model, whose lengths are then short by up to 21.6 %
};

/// Whether an operation can do what was asked.
enum class Reach : std::uint8_t {
    inside,
    outside,    ///< beyond the convergence range: the result is not the rotation asked for
    zero_vector ///< vectoring: (0, 0) has no direction
};

template <class Number> struct Vector3 {
    Number x{}, y{}, z{};

    friend bool operator==(const Vector3&, const Vector3&) = default;
};

template <class Arithmetic> class Kernel {
public:
    using Number = typename Arithmetic::Number;
    using Vector = Vector3<Number>;

    constexpr Kernel(const Arithmetic& arithmetic,
                     const Sequence& sequence,
                     SignOfZero zero = SignOfZero::positive)
        : arithmetic_(arithmetic), sequence_(sequence), zero_(zero),
          factor_(arithmetic.factor(sequence.multiplies ? inverse_gain(sequence) : 0)) {
        for (int i = 0; i < sequence.step_count; ++i) {
            const int shift = shift_of(i);
            const Number angle = arithmetic.angle(sequence.m, shift);
            const auto tangent = power_of_two<double>(-shift);
            const double x = limit_x_ - sign_of(sequence.m) * tangent * limit_y_;
            limit_y_ += tangent * limit_x_;
            limit_x_ = x;
            range_ += arithmetic.to_double(angle);
            angles_[static_cast<std::size_t>(i)] = angle;
        }
    }

    /// Turns (x, y) by z. `overflow` is set if a value did not fit.
    [[nodiscard]] constexpr Vector rotated(Vector v, bool& overflow) const {
        return run(Mode::rotation, v, overflow);
    }
    /// (length, about 0, z + angle of (x, y)).
    [[nodiscard]] constexpr Vector vectored(Vector v, bool& overflow) const {
        return run(Mode::vectoring, v, overflow);
    }

    /// sigma: +1, -1, or 0 with SignOfZero::zero. IEEE's -0 counts as zero.
    [[nodiscard]] constexpr int direction(Mode mode, const Vector& v) const {
        const Number decides = mode == Mode::rotation ? v.z : v.y;
        const int sign = decides < Number{0} ? -1 : 1;
        if (zero_ == SignOfZero::zero && !(decides < Number{0}) && !(decides > Number{0})) {
            return 0;
        }
        return mode == Mode::rotation ? sign : -sign;
    }
    /// Step `i` of x and y.
    constexpr void turn(Number& x, Number& y, int i, int sigma, bool& overflow) const {
        if (sigma == 0) {
            return;
        }
        const int shift = shift_of(i);
        const Number dx = arithmetic_.shifted(y, shift);
        const Number dy = arithmetic_.shifted(x, shift);
        if (sequence_.m != CoordinateSystem::linear) {
            const bool subtracts = (sigma > 0) == (sequence_.m == CoordinateSystem::circular);
            x = subtracts ? arithmetic_.difference(x, dx, overflow) : arithmetic_.sum(x, dx, overflow);
        }
        y = sigma > 0 ? arithmetic_.sum(y, dy, overflow) : arithmetic_.difference(y, dy, overflow);
    }
    /// Step `i` of x, y and z.
    constexpr void step(Vector& v, int i, int sigma, bool& overflow) const {
        turn(v.x, v.y, i, sigma, overflow);
        if (sigma != 0) {
            const Number angle = angles_[static_cast<std::size_t>(i)];
            v.z = sigma > 0 ? arithmetic_.difference(v.z, angle, overflow)
                            : arithmetic_.sum(v.z, angle, overflow);
        }
    }
    /// Correction `j` of x or y.
    [[nodiscard]] constexpr Number corrected(Number value, int j, bool& overflow) const {
        const int a = sequence_.corrections[static_cast<std::size_t>(j)];
        if (a == 0) {
            return value;
        }
        const Number part = arithmetic_.shifted(value, a < 0 ? -a : a);
        return a < 0 ? arithmetic_.difference(value, part, overflow) : arithmetic_.sum(value, part, overflow);
    }
    /// The multiplication that stands for the corrections of a sequence that multiplies.
    [[nodiscard]] constexpr Number multiplied(Number value, bool& overflow) const {
        return arithmetic_.scaled(value, factor_, overflow);
    }

    /// Whether rotation by z converges: |z| is within the sum of the angles, as this format holds them.
    [[nodiscard]] constexpr Reach reach_of_rotation(Number z) const {
        const double angle = arithmetic_.to_double(z);
        return angle <= range_ && angle >= -range_ ? Reach::inside : Reach::outside;
    }
    /// The largest |z| that rotation brings to zero: the sum of the angles, as this format holds them.
    [[nodiscard]] constexpr double rotation_range() const { return range_; }
    /// Whether vectoring of (x, y) converges: its direction lies between those that all steps of one sense
    /// reach.
    [[nodiscard]] constexpr Reach reach_of_vectoring(Number x, Number y) const {
        const double a = arithmetic_.to_double(x);
        const double b = arithmetic_.to_double(y) < 0 ? -arithmetic_.to_double(y) : arithmetic_.to_double(y);
        if (!(a > 0) && !(a < 0) && !(b > 0)) {
            return Reach::zero_vector;
        }
        const bool forward = sequence_.m == CoordinateSystem::circular || a > 0;
        return forward && a * limit_y_ - b * limit_x_ >= 0 ? Reach::inside : Reach::outside;
    }

    [[nodiscard]] constexpr const Arithmetic& arithmetic() const { return arithmetic_; }
    [[nodiscard]] constexpr const Sequence& sequence() const { return sequence_; }
    [[nodiscard]] constexpr Number angle(int i) const { return angles_[static_cast<std::size_t>(i)]; }

private:
    [[nodiscard]] constexpr int shift_of(int i) const {
        return sequence_.shifts[static_cast<std::size_t>(i)];
    }
    [[nodiscard]] constexpr Vector run(Mode mode, Vector v, bool& overflow) const {
        for (int i = 0; i < sequence_.step_count; ++i) {
            step(v, i, direction(mode, v), overflow);
        }
        if (sequence_.multiplies) {
            return {multiplied(v.x, overflow), multiplied(v.y, overflow), v.z};
        }
        for (int j = 0; j < sequence_.correction_count; ++j) {
            v.x = corrected(v.x, j, overflow);
            v.y = corrected(v.y, j, overflow);
        }
        return v;
    }

    Arithmetic arithmetic_;
    Sequence sequence_;
    SignOfZero zero_;
    typename Arithmetic::Factor factor_;
    std::array<Number, most_steps> angles_{};
    double range_ = 0.0;
    double limit_x_ =
        1.0; ///< (1, 0) turned by every step in the same sense: the edge of what vectoring reaches
    double limit_y_ = 0.0;
};

// The iteration in a number format that is known only at run time.

using AnyKernel =
    std::variant<Kernel<FloatArithmetic<double>>, Kernel<FloatArithmetic<float>>, Kernel<FixedArithmetic>>;

[[nodiscard]] inline AnyKernel
any_kernel(const NumberFormat& format, const Sequence& sequence, SignOfZero zero) {
    return with_arithmetic(
        format, [&](const auto& arithmetic) { return AnyKernel(Kernel(arithmetic, sequence, zero)); });
}

} // namespace millwright::cordic
