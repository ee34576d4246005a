// Bernstein polynomials of one degree n at one parameter, with derivatives, from those of lower degrees.
#pragma once

#include "core/geometry/bezier_patch.h"

#include <array>
#include <cstddef>

namespace millwright::geometry {

/// The first n + 1 count; the rest has no value.
using Bernstein = std::array<double, max_degree + 1>;

/// B_i^n from B_i^(n-1): the stable triangle of de Casteljau.
inline void raise_degree(Bernstein& b, int degree, double t) {
    double carried = 0.0;
    for (int i = 0; i < degree; ++i) {
        const double lower = b[static_cast<std::size_t>(i)];
        b[static_cast<std::size_t>(i)] = carried + (1.0 - t) * lower;
        carried = t * lower;
    }
    b[static_cast<std::size_t>(degree)] = carried;
}

/// `b` becomes the polynomials of `degree`, of the least degree 0.
inline void begin_at_degree(Bernstein& b, int degree, double t) {
    b[0] = 1.0;
    for (int n = 1; n <= degree; ++n) {
        raise_degree(b, n, t);
    }
}

/// B_i' = n (B_(i-1)^(n-1) - B_i^(n-1)) from `lower`, of the degree n - 1.
inline void differentiate(const Bernstein& lower, int n, Bernstein& first) {
    double before = 0.0;
    for (int i = 0; i < n; ++i) {
        const double here = lower[static_cast<std::size_t>(i)];
        first[static_cast<std::size_t>(i)] = n * (before - here);
        before = here;
    }
    first[static_cast<std::size_t>(n)] = n * before;
}

} // namespace millwright::geometry
