// Set-points of lines and arcs as the arithmetic unit computes them: where to go next, and the speed and
// acceleration of each axis. Source: thesis eqs 4.1 to 4.3, sections 4.1 to 4.3 and the listings of
// chapter 5.
#pragma once

#include "core/cordic/kernel.h"
#include "core/cordic/quadrant_fold.h"

namespace millwright::cordic {

/// What the processor hands to the motion controller: position, speed and acceleration of both axes.
template <class Number> struct SetPoint {
    Number x{}, y{}, vx{}, vy{}, ax{}, ay{};

    friend bool operator==(const SetPoint&, const SetPoint&) = default;
};

/// G00 and G01 from (x0, y0) to (x1, y1) with speed v and acceleration a along the path; for eq. 4.2 the
/// caller passes half of the largest acceleration, as the thesis's model does. Without motion there is no
/// direction: the caller leaves such moves out.
template <class Arithmetic, class Number = typename Arithmetic::Number>
[[nodiscard]] constexpr SetPoint<Number> line_set_point(const Kernel<Arithmetic>& kernel,
                                                        Number x1,
                                                        Number y1,
                                                        Number x0,
                                                        Number y0,
                                                        Number v,
                                                        Number a,
                                                        bool& overflow) {
    const Arithmetic& arithmetic = kernel.arithmetic();
    const Number dx = arithmetic.difference(x1, x0, overflow);
    const Number dy = arithmetic.difference(y1, y0, overflow);
    const Folded<Number> folded = pre(arithmetic, dx, dy, overflow);
    const int shift = normalising_shift(arithmetic, folded.x, folded.y);
    const Number z =
        kernel
            .vectored(
                {normalised(arithmetic, folded.x, shift), normalised(arithmetic, folded.y, shift), Number{0}},
                overflow)
            .z;
    const auto along = [&](Number length) {
        const auto turned = kernel.rotated({length, Number{0}, z}, overflow);
        return post(arithmetic, Folded<Number>{turned.x, turned.y, folded.f1, folded.f2}, overflow);
    };
    const Folded<Number> speed = along(v);
    const Folded<Number> acceleration = along(a);
    return {x1, y1, speed.x, speed.y, acceleration.x, acceleration.y};
}

/// One chord of G02 and G03: (x, y) turned by dz about (i, j), counter-clockwise for dz > 0.
template <class Arithmetic, class Number = typename Arithmetic::Number>
[[nodiscard]] constexpr SetPoint<Number> arc_point(
    const Kernel<Arithmetic>& kernel, Number i, Number j, Number x, Number y, Number dz, bool& overflow) {
    const Arithmetic& arithmetic = kernel.arithmetic();
    const Number from_x = arithmetic.difference(x, i, overflow);
    const Number from_y = arithmetic.difference(y, j, overflow);
    const Folded<Number> folded = pre(arithmetic, from_x, from_y, overflow);
    const auto turned = kernel.rotated({folded.x, folded.y, dz}, overflow);
    const Folded<Number> back =
        post(arithmetic, Folded<Number>{turned.x, turned.y, folded.f1, folded.f2}, overflow);
    return {.x = arithmetic.sum(back.x, i, overflow), .y = arithmetic.sum(back.y, j, overflow)};
}

} // namespace millwright::cordic
