// What the data path does for a line in space: bearing and length in the plane first, then the slope.
#pragma once

#include "core/cordic/kernel.h"
#include "core/cordic/processor_state.h"
#include "core/cordic/quadrant_fold.h"

#include <algorithm>

namespace millwright::cordic::internal {

/// How far to shift three differences together; those of zero length do not count.
template <class Arithmetic, class Number = typename Arithmetic::Number>
[[nodiscard]] constexpr int
space_shift(const Arithmetic& arithmetic, const Folded<Number>& plane, Number rise) {
    const Number zero{};
    const bool level = !(rise < zero) && !(zero < rise);
    const bool upright = !(plane.x < zero) && !(zero < plane.x) && !(plane.y < zero) && !(zero < plane.y);
    const int in_plane = normalising_shift(arithmetic, plane.x, plane.y);
    const int of_rise = normalising_shift(arithmetic, rise, rise);
    if (level || upright) {
        return level ? in_plane : of_rise;
    }
    return std::min(in_plane, of_rise);
}

template <class Arithmetic>
void fold_space(const Kernel<Arithmetic>& kernel, ProcessorState& state, bool& overflow) {
    const Arithmetic& arithmetic = kernel.arithmetic();
    using Number = typename Arithmetic::Number;
    DataPath& path = state.path;
    const auto way = [&](Word to, Register from) {
        return arithmetic.difference(
            arithmetic.from_word(to), arithmetic.from_word(register_of(state, from)), overflow);
    };
    const Number dx = way(path.xe, Register::X0);
    const Number dy = way(path.ye, Register::Y0);
    const Number rise = way(path.ze, Register::Z0);
    const Folded<Number> folded = pre(arithmetic, dx, dy, overflow);
    const int shift = space_shift(arithmetic, folded, rise);
    path.x = arithmetic.to_word(normalised(arithmetic, folded.x, shift));
    path.y = arithmetic.to_word(normalised(arithmetic, folded.y, shift));
    path.rise = arithmetic.to_word(normalised(arithmetic, rise, shift));
    path.f1 = folded.f1;
    path.f2 = folded.f2;
    path.z = arithmetic.to_word(Number{});
    const Reach reach = kernel.reach_of_vectoring(folded.x, folded.y);
    path.upright = reach == Reach::zero_vector;
    path.standing = path.upright && kernel.reach_of_vectoring(rise, Number{}) == Reach::zero_vector;
    if (reach == Reach::outside) {
        stop(state, Stop::out_of_reach);
    }
}

template <class Arithmetic> void fold_rise(const Kernel<Arithmetic>& kernel, ProcessorState& state) {
    DataPath& path = state.path;
    const Word zero = kernel.arithmetic().to_word(typename Arithmetic::Number{});
    path.bearing = path.z;
    path.x = path.upright ? zero : path.x; // of no length there is nothing but what rounding made of it
    path.y = path.rise;
    path.z = zero;
    const auto across = kernel.arithmetic().from_word(path.x);
    if (kernel.reach_of_vectoring(across, kernel.arithmetic().from_word(path.y)) == Reach::outside) {
        stop(state, Stop::out_of_reach);
    }
}

template <class Arithmetic> void unfold_rise(const Kernel<Arithmetic>& kernel, ProcessorState& state) {
    DataPath& path = state.path;
    const Word zero = kernel.arithmetic().to_word(typename Arithmetic::Number{});
    register_of(state, Register::Vz) = path.standing ? zero : path.y;
    register_of(state, Register::Az) = path.standing ? zero : path.y2;
    path.y = zero;
    path.y2 = zero;
    path.z = path.bearing;
}

} // namespace millwright::cordic::internal
