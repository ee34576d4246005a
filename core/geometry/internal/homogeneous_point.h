// The homogeneous surface (w x, w y, w z, w) of a patch at one place, with its derivatives up to the order 0,
// 1 or 2: the sums over the net that everything about a patch begins with. Whatever the order, and written
// out or not, the terms are added in the same sequence: the bits are the same.
#pragma once

#include "core/geometry/internal/bernstein.h"

#include <cstddef>
#include <span>

namespace millwright::geometry {

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

} // namespace millwright::geometry
