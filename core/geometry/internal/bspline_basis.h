// The B-spline functions that are not zero at one parameter, with derivatives.
// Source: Piegl and Tiller, The NURBS Book, algorithms A2.1 and A2.3.
#pragma once

#include "core/geometry/bspline_surface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace millwright::geometry {

/// The degree + 1 functions N_first, N_first+1, ... count; the rest has no value.
struct BsplineBasis {
    using Values = std::array<double, max_bspline_degree + 1>;
    int first = 0;
    Values value, slope, bend; ///< and derivatives, as far as they were asked for
};

/// The k with knots[k] <= t < knots[k + 1]; of the ends and beyond the first and the last span.
inline int span_at(const std::vector<double>& knots, int degree, double t) {
    const auto first = knots.begin() + degree;
    const auto last = knots.end() - degree - 1; // the end of the last span
    return static_cast<int>(std::upper_bound(first + 1, last, t) - 1 - knots.begin());
}

/// Derivatives up to `Order`, 0 to 2.
template <int Order> void fill(BsplineBasis& basis, const std::vector<double>& knots, int degree, double t) {
    const int k = span_at(knots, degree, t);
    basis.first = k - degree;
    const auto knot = [&](int n) { return knots[static_cast<std::size_t>(n)]; };
    const auto at = [](auto& values, int n) -> auto& {
        return values[static_cast<std::size_t>(n)];
    };
    std::array<BsplineBasis::Values, 2> lower{}; // the functions of one and two degrees less
    BsplineBasis::Values& n = basis.value;
    n[0] = 1.0;
    for (int p = 1; p <= degree; ++p) {
        if (p == degree) {
            lower[0] = n;
        } else if (p == degree - 1) {
            lower[1] = n;
        }
        double carried = 0.0;
        for (int r = 0; r < p; ++r) { // N_(k-p+1+r), of the degree p - 1
            const double left = knot(k - p + 1 + r), right = knot(k + 1 + r);
            const double share = at(n, r) / (right - left);
            at(n, r) = carried + (right - t) * share;
            carried = (t - left) * share;
        }
        at(n, p) = carried;
    }
    // N' = p N_i,(p-1) / (t_(i+p) - t_i) - p N_(i+1),(p-1) / (t_(i+p+1) - t_(i+1))
    const auto derive = [&](const BsplineBasis::Values& of, int p, BsplineBasis::Values& into) {
        double before = 0.0;
        for (int r = 0; r < p; ++r) {
            const double here = p * at(of, r) / (knot(k + 1 + r) - knot(k - p + 1 + r));
            at(into, r) = before - here;
            before = here;
        }
        at(into, p) = before;
    };
    if constexpr (Order >= 1) {
        derive(lower[0], degree, basis.slope);
    }
    if constexpr (Order == 2) {
        BsplineBasis::Values slope{};
        if (degree >= 2) {
            derive(lower[1], degree - 1, slope);
        }
        derive(slope, degree, basis.bend);
    }
}

} // namespace millwright::geometry
