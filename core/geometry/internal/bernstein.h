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

/// B_i'' = n (n-1) (B_(i-2) - 2 B_(i-1) + B_i)^(n-2) from `lower`, of the degree n - 2.
inline void differentiate_twice(const Bernstein& lower, int n, Bernstein& second) {
    const auto at = [&](int i) { return i < 0 || i > n - 2 ? 0.0 : lower[static_cast<std::size_t>(i)]; };
    for (int i = 0; i <= n; ++i) {
        second[static_cast<std::size_t>(i)] =
            n < 2 ? 0.0 : n * (n - 1) * (at(i - 2) - 2.0 * at(i - 1) + at(i));
    }
}

/// Polynomials of the degree `n` with their derivatives up to `Order`, 0 to 2; those above have no value.
struct Basis {
    Bernstein value, first, second;
};

template <int Order> void fill(Basis& basis, int n, double t) {
    Bernstein& b = basis.value;
    begin_at_degree(b, n - Order, t);
    if constexpr (Order == 2) {
        differentiate_twice(b, n, basis.second);
        if (n >= 2) {
            raise_degree(b, n - 1, t);
        }
    }
    if constexpr (Order >= 1) {
        differentiate(b, n, basis.first);
        raise_degree(b, n, t);
    }
}

/// The same of the degree 3, written out: most patches are bicubic. The same bits.
struct CubicBasis {
    std::array<double, 4> value, first, second;
};

inline CubicBasis cubic_basis(double t) {
    const double s = 1.0 - t;
    const double q0 = s * s, q1 = t * s + s * t, q2 = t * t;
    return {{s * q0, t * q0 + s * q1, t * q1 + s * q2, t * q2},
            {3.0 * (0.0 - q0), 3.0 * (q0 - q1), 3.0 * (q1 - q2), 3.0 * q2},
            {6.0 * s, 6.0 * (t - 2.0 * s), 6.0 * (s - 2.0 * t), 6.0 * t}};
}

} // namespace millwright::geometry
