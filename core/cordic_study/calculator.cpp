#include "core/cordic_study/calculator.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/cordic/angles.h"
#include "core/cordic/kernel.h"
#include "core/cordic/quadrant_fold.h"
#include "core/cordic_study/internal/entered_numbers.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>

namespace millwright::cordic {
namespace {

constexpr double right_angle_deg = 90.0;

constexpr const char* room_for_turning =
    "choose a format with room for the vector times its gain, up to 1.65";

void refuse(bool overflow, const NumberFormat& format) {
    internal::refuse_overflow(overflow, format, room_for_turning);
}

template <class Number> struct Turn {
    std::int64_t quarter_turns = 0;
    Number rest{};            ///< rad, within 45 degrees
    long double exact = 0.0L; ///< the same
};

/// Exact as far as the quarter turns go: degrees of a circle are whole numbers.
template <class Arithmetic>
Turn<typename Arithmetic::Number>
turn_of(const Arithmetic& arithmetic, const NumberFormat& format, const Decimal& angle_deg) {
    if constexpr (std::is_same_v<Arithmetic, FixedArithmetic>) {
        const auto [quarters, rest] = angle_deg.as_degrees();
        const auto nearest_rest =
            static_cast<std::int64_t>(nearest(rest, angle_places - format.fraction_bits));
        if (nearest_rest > arithmetic.largest() || nearest_rest < -arithmetic.largest() - 1) {
            refuse(true, format);
        }
        return {quarters, nearest_rest, std::ldexp(static_cast<long double>(rest), -angle_places)};
    } else {
        const double within = std::fmod(angle_deg.nearest_double(), 360.0);
        const double quarters = std::nearbyint(within / right_angle_deg);
        const double rest_deg = within - quarters * right_angle_deg;
        constexpr long double degree = std::numbers::pi_v<long double> / 180.0L;
        bool overflow = false; // 45 degrees fit every floating format
        return {static_cast<std::int64_t>(quarters),
                arithmetic.from_double(from_degrees(rest_deg), overflow),
                static_cast<long double>(rest_deg) * degree};
    }
}

} // namespace

Rotated rotate(const NumberFormat& format,
               const Sequence& sequence,
               const Decimal& x,
               const Decimal& y,
               const Decimal& angle_deg) {
    return with_arithmetic(format, [&](const auto& arithmetic) {
        const Kernel kernel(arithmetic, sequence);
        auto from_x = internal::entered(arithmetic, format, x);
        auto from_y = internal::entered(arithmetic, format, y);
        internal::refuse_vanished(
            format, x, y, kernel.reach_of_vectoring(from_x, from_y) != Reach::zero_vector);
        const auto turn = turn_of(arithmetic, format, angle_deg);
        bool overflow = false;
        quarter_turn(arithmetic, from_x, from_y, turn.quarter_turns, overflow);
        const auto turned = kernel.rotated({from_x, from_y, turn.rest}, overflow);
        refuse(overflow, format);
        Rotated answer{arithmetic.to_double(turned.x),
                       arithmetic.to_double(turned.y),
                       arithmetic.to_double(turned.z),
                       0.0,
                       sequence.clock_count(),
                       internal::words_of_vector(arithmetic, format, turned)};
        // The exact result, with the quarter turns taken out of the angle so that none of its digits are
        // lost.
        long double exact_x = x.nearest_long_double();
        long double exact_y = y.nearest_long_double();
        quarter_turn(FloatArithmetic<long double>(), exact_x, exact_y, turn.quarter_turns, overflow);
        const long double c = std::cos(turn.exact);
        const long double s = std::sin(turn.exact);
        answer.error = static_cast<double>(
            std::hypot(internal::exactly(arithmetic, turned.x) - (exact_x * c - exact_y * s),
                       internal::exactly(arithmetic, turned.y) - (exact_y * c + exact_x * s)));
        return answer;
    });
}

Polar polar(const NumberFormat& format, const Sequence& sequence, const Decimal& x_in, const Decimal& y_in) {
    const double x = x_in.nearest_double();
    const double y = y_in.nearest_double();
    return with_arithmetic(format, [&](const auto& arithmetic) {
        const Kernel kernel(arithmetic, sequence);
        bool overflow = false;
        const auto folded = pre(arithmetic,
                                internal::entered(arithmetic, format, x_in),
                                internal::entered(arithmetic, format, y_in),
                                overflow);
        const Reach reach = kernel.reach_of_vectoring(folded.x, folded.y);
        if (reach == Reach::zero_vector) {
            throw Error(fmt::format("({}, {}) has no direction in {}", x, y, to_text(format)));
        }
        if (reach == Reach::outside) {
            throw Error(fmt::format("({}, {}) cannot be turned to the x axis by {}",
                                    x,
                                    y,
                                    counted(sequence.step_count, "step")),
                        {},
                        "use more iterations");
        }
        const int shift = normalising_shift(arithmetic, folded.x, folded.y);
        const auto found = kernel.vectored(
            {normalised(arithmetic, folded.x, shift), normalised(arithmetic, folded.y, shift), {}}, overflow);
        refuse(overflow, format);
        Polar answer;
        answer.length = std::ldexp(arithmetic.to_double(found.x), -shift);
        (void)arithmetic.from_double(answer.length, overflow);
        refuse(overflow, format);
        answer.angle_deg =
            to_degrees(arithmetic.to_double(found.z)) + right_angle_deg * quarter_turns_of(folded);
        answer.angle_deg -= answer.angle_deg > 180.0 ? 360.0 : 0.0;
        answer.angle_deg += answer.angle_deg < -180.0 ? 360.0 : 0.0;
        answer.length_error = std::abs(answer.length - std::hypot(x, y));
        answer.angle_error_deg =
            std::abs(std::remainder(answer.angle_deg - to_degrees(std::atan2(y, x)), 360.0));
        answer.clocks = sequence.clock_count();
        answer.shift = shift;
        answer.words = internal::words_of_vector(arithmetic, format, found);
        return answer;
    });
}

} // namespace millwright::cordic
