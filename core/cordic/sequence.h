// Which shifts an iteration uses, and how its gain is taken out again: by additions of shifted values as in
// the thesis (table 3.3), or by one multiplication.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace millwright::cordic {

/// m of the generalised iteration: x' = x - m s 2^-S y, y' = y + s 2^-S x.
enum class CoordinateSystem : std::int8_t { hyperbolic = -1, linear = 0, circular = 1 };

/// m as a number.
[[nodiscard]] constexpr int sign_of(CoordinateSystem m) {
    return static_cast<int>(m);
}

/// "circular", "linear" or "hyperbolic".
[[nodiscard]] std::string_view to_text(CoordinateSystem m);
/// What to_text() gives. Throws Error that quotes the text.
[[nodiscard]] CoordinateSystem parse_coordinate_system(std::string_view text);

inline constexpr int most_steps = 62;
inline constexpr int most_corrections = 8;

struct Sequence {
    CoordinateSystem m = CoordinateSystem::circular;
    int step_count = 0;
    std::array<int, most_steps> shifts{}; ///< S: one step for each
    int correction_count = 0;
    /// a: x' = x + sign(a) 2^-|a| x, the same for y; 0 does nothing.
    std::array<int, most_corrections> corrections{};
    bool multiplies = false; ///< the gain is taken out by one multiplication instead

    /// Steps and corrections, or the multiplication: one clock each.
    [[nodiscard]] constexpr int clock_count() const {
        return step_count + (multiplies ? 1 : correction_count);
    }

    friend bool operator==(const Sequence&, const Sequence&) = default;
};

/// Table 3.3: 29 steps, the same for every m, and 8 corrections.
[[nodiscard]] constexpr Sequence thesis_sequence(CoordinateSystem m = CoordinateSystem::circular) {
    Sequence made;
    made.m = m;
    made.step_count = 29;
    constexpr std::array<int, 29> S = {1,  2,  2,  2,  2,  3,  4,  5,  6,  6,  7,  8,  9,  10, 11,
                                       12, 13, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24};
    for (std::size_t i = 0; i < S.size(); ++i) {
        made.shifts[i] = S[i];
    }
    made.correction_count = most_corrections;
    if (m == CoordinateSystem::circular) {
        made.corrections = {-2, 4, -5, 6, 0, 17, -20, 0};
    } else if (m == CoordinateSystem::hyperbolic) {
        made.corrections = {2, 4, 0, 6, -6, 0, -20, -21};
    }
    return made;
}

/// The textbook sequence of `count` steps (1 to most_steps): shifts 0, 1, 2 ...; hyperbolic from 1 with 4, 13
/// and 40 done twice, without which it does not converge (Walther 1971).
[[nodiscard]] constexpr Sequence classic_sequence(CoordinateSystem m, int count) {
    Sequence made;
    made.m = m;
    made.step_count = count;
    made.multiplies = m != CoordinateSystem::linear;
    const bool hyperbolic = m == CoordinateSystem::hyperbolic;
    int shift = hyperbolic ? 1 : 0;
    bool repeated = false;
    for (int i = 0; i < count; ++i) {
        made.shifts[static_cast<std::size_t>(i)] = shift;
        const bool again = hyperbolic && !repeated && (shift == 4 || shift == 13 || shift == 40);
        shift += again ? 0 : 1;
        repeated = again;
    }
    return made;
}

/// k: what the steps multiply lengths by.
[[nodiscard]] double gain(const Sequence& sequence);

/// P: what the corrections, or the multiplication in infinite precision, multiply lengths by.
[[nodiscard]] double correction(const Sequence& sequence);

/// The largest |z| that rotation brings to zero, and |angle| that vectoring does: the sum of all elementary
/// angles.
[[nodiscard]] double convergence_range(const Sequence& sequence);

/// The largest |angle| (circular, rad) or |y/x| (linear, hyperbolic) whose vector the steps turn to the x
/// axis.
[[nodiscard]] double vectoring_range(const Sequence& sequence);

} // namespace millwright::cordic
