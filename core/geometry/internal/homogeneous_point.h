// The homogeneous surface (w x, w y, w z, w) of a patch at one place, with its derivatives up to the order 0,
// 1 or 2: the sums over the net that everything about a patch begins with. Whatever the order, and written
// out or not, the terms are added in the same sequence: the bits are the same.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/parametric_surface.h"

#include <array>
#include <cstddef>
#include <span>

namespace millwright::geometry {

// Bernstein polynomials of one degree n at one parameter, with derivatives, from those of lower degrees.

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

using Vec4 = Eigen::Vector4d;

/// Derivatives above the order stay zero.
struct HomogeneousPoint {
    Vec4 s = Vec4::Zero(), u = Vec4::Zero(), v = Vec4::Zero();
    Vec4 uu = Vec4::Zero(), uv = Vec4::Zero(), vv = Vec4::Zero();
};

/// `points`: [rows x columns], row-major.
template <int Order>
HomogeneousPoint
sum_of_any_degree(std::span<const Vec4> points, int rows, int columns, const Basis& bu, const Basis& bv) {
    HomogeneousPoint sum;
    const Vec4* point = points.data();
    for (std::size_t i = 0; i < static_cast<std::size_t>(rows); ++i) {
        Vec4 row = Vec4::Zero(), row_v = Vec4::Zero(), row_vv = Vec4::Zero();
        for (std::size_t j = 0; j < static_cast<std::size_t>(columns); ++j, ++point) {
            row += bv.value[j] * *point;
            if constexpr (Order >= 1) {
                row_v += bv.first[j] * *point;
            }
            if constexpr (Order == 2) {
                row_vv += bv.second[j] * *point;
            }
        }
        sum.s += bu.value[i] * row;
        if constexpr (Order >= 1) {
            sum.u += bu.first[i] * row;
            sum.v += bu.value[i] * row_v;
        }
        if constexpr (Order == 2) {
            sum.uu += bu.second[i] * row;
            sum.uv += bu.first[i] * row_v;
            sum.vv += bu.value[i] * row_vv;
        }
    }
    return sum;
}

/// The product of a row of four points with four polynomials. Left to the compiler, this is not inlined, and
/// costs a third of the time.
[[gnu::always_inline]] inline Vec4 sum_of_four(const Vec4* p, const std::array<double, 4>& b) {
    return b[0] * p[0] + b[1] * p[1] + b[2] * p[2] + b[3] * p[3];
}

template <int Order>
[[gnu::always_inline]] inline HomogeneousPoint
bicubic_sum(std::span<const Vec4> points, const CubicBasis& bu, const CubicBasis& bv) {
    HomogeneousPoint sum;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec4* const p = points.data() + 4 * i;
        const Vec4 row = sum_of_four(p, bv.value);
        sum.s += bu.value[i] * row;
        if constexpr (Order >= 1) {
            const Vec4 row_v = sum_of_four(p, bv.first);
            sum.u += bu.first[i] * row;
            sum.v += bu.value[i] * row_v;
            if constexpr (Order == 2) {
                sum.uv += bu.first[i] * row_v;
            }
        }
        if constexpr (Order == 2) {
            sum.uu += bu.second[i] * row;
            sum.vv += bu.value[i] * sum_of_four(p, bv.second);
        }
    }
    return sum;
}

/// What `use` makes of the sum for a place. It is handed over, not returned, so that the sum of a bicubic
/// patch stays in registers.
template <int Order, class Use>
auto with_homogeneous_point(const BezierPatch& patch, double u, double v, const Use& use) {
    const std::span<const Vec4> points = patch.homogeneous();
    const int rows = patch.net().rows, columns = patch.net().columns;
    if (rows == 4 && columns == 4) {
        return use(bicubic_sum<Order>(points, cubic_basis(u), cubic_basis(v)));
    }
    Basis bu, bv;
    fill<Order>(bu, rows - 1, u);
    fill<Order>(bv, columns - 1, v);
    return use(sum_of_any_degree<Order>(points, rows, columns, bu, bv));
}

// From a homogeneous point with its derivatives to those of the surface in space.

/// Quotient rule for S = A / w.
inline SurfaceDerivatives projected(const HomogeneousPoint& h) {
    const double w = h.s.w();
    SurfaceDerivatives at;
    at.position = h.s.head<3>() / w;
    at.du = (h.u.head<3>() - h.u.w() * at.position) / w;
    at.dv = (h.v.head<3>() - h.v.w() * at.position) / w;
    at.duu = (h.uu.head<3>() - 2.0 * h.u.w() * at.du - h.uu.w() * at.position) / w;
    at.duv = (h.uv.head<3>() - h.u.w() * at.dv - h.v.w() * at.du - h.uv.w() * at.position) / w;
    at.dvv = (h.vv.head<3>() - 2.0 * h.v.w() * at.dv - h.vv.w() * at.position) / w;
    return at;
}

} // namespace millwright::geometry
