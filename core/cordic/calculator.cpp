#include "core/cordic/calculator.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/cordic/fold.h"
#include "core/cordic/kernel.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace millwright::cordic {
namespace {

constexpr double right_angle_deg = 90.0;
constexpr long double pi_long = std::numbers::pi_v<long double>;

struct TurnedDegrees {
    std::int64_t quarter_turns = 0;
    double rest_deg = 0.0; ///< -45 to 45
};

/// Exact: degrees of a circle are whole numbers.
TurnedDegrees reduced_degrees(double angle_deg) {
    const double within = std::fmod(angle_deg, 360.0);
    const double quarters = std::nearbyint(within / right_angle_deg);
    return {static_cast<std::int64_t>(quarters), within - quarters * right_angle_deg};
}

void refuse(bool overflow, const NumberFormat& format) {
    if (overflow) {
        throw Error(
            fmt::format("the result or a number on the way to it does not fit into {}", to_text(format)),
            {},
            "the iteration needs room for the vector times its gain, up to 1.65");
    }
}

template <class Arithmetic>
typename Arithmetic::Number entered(const Arithmetic& arithmetic, const NumberFormat& format, double value) {
    bool overflow = false;
    const auto number = arithmetic.from_double(value, overflow);
    if (overflow) {
        throw Error(fmt::format("{} does not fit into {}", value, to_text(format)));
    }
    return number;
}

/// How far `found` is from (x, y) turned by `angle_deg`.
double distance_from_rotated(long double x, long double y, double angle_deg, const Rotated& found) {
    const long double angle = static_cast<long double>(angle_deg) * (pi_long / 180.0L);
    const long double c = std::cos(angle);
    const long double s = std::sin(angle);
    return static_cast<double>(std::hypot(static_cast<long double>(found.x) - (x * c - y * s),
                                          static_cast<long double>(found.y) - (y * c + x * s)));
}

} // namespace

Rotated rotate(const NumberFormat& format, const Sequence& sequence, double x, double y, double angle_deg) {
    if (!std::isfinite(angle_deg)) {
        throw Error("the angle is no finite number");
    }
    const auto [quarter_turns, rest_deg] = reduced_degrees(angle_deg);
    return with_arithmetic(format, [&, turns = quarter_turns, rest = rest_deg](const auto& arithmetic) {
        const Kernel kernel(arithmetic, sequence);
        auto from_x = entered(arithmetic, format, x);
        auto from_y = entered(arithmetic, format, y);
        bool overflow = false;
        quarter_turn(arithmetic, from_x, from_y, turns, overflow);
        const auto turned =
            kernel.rotated({from_x, from_y, entered(arithmetic, format, from_degrees(rest))}, overflow);
        refuse(overflow, format);
        Rotated answer{arithmetic.to_double(turned.x),
                       arithmetic.to_double(turned.y),
                       arithmetic.to_double(turned.z),
                       0.0,
                       sequence.clock_count()};
        // The exact result, with the quarter turns taken out of the angle so that none of its digits are
        // lost.
        double exact_x = x;
        double exact_y = y;
        quarter_turn(FloatArithmetic<double>(), exact_x, exact_y, turns, overflow);
        answer.error = distance_from_rotated(
            static_cast<long double>(exact_x), static_cast<long double>(exact_y), rest, answer);
        return answer;
    });
}

Polar polar(const NumberFormat& format, const Sequence& sequence, double x, double y) {
    return with_arithmetic(format, [&](const auto& arithmetic) {
        const Kernel kernel(arithmetic, sequence);
        bool overflow = false;
        const auto folded =
            pre(arithmetic, entered(arithmetic, format, x), entered(arithmetic, format, y), overflow);
        const Reach reach = kernel.reach_of_vectoring(folded.x, folded.y);
        if (reach == Reach::zero_vector) {
            throw Error(fmt::format("({}, {}) has no direction in {}", x, y, to_text(format)));
        }
        if (reach == Reach::outside) {
            throw Error(
                fmt::format(
                    "({}, {}) lies beyond what {} steps turn to the x axis", x, y, sequence.step_count),
                {},
                "take more iterations");
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
        answer.length_error = std::abs(answer.length - std::hypot(x, y));
        answer.angle_error_deg =
            std::abs(std::remainder(answer.angle_deg - to_degrees(std::atan2(y, x)), 360.0));
        answer.clocks = sequence.clock_count();
        return answer;
    });
}

} // namespace millwright::cordic
