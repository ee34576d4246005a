#include "core/geometry/bspline_surface.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/geometry/internal/control_net.h"
#include "core/geometry/internal/homogeneous_point.h"
#include "core/geometry/internal/unit_normal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::geometry {

// The B-spline functions that are not zero at one parameter, with derivatives.
// Source: Piegl and Tiller, The NURBS Book, algorithms A2.1 and A2.3.

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

namespace {

std::string fault_of_knots(const char* name, const std::vector<double>& knots, int degree, int points) {
    if (degree < 1 || degree > max_bspline_degree) {
        return fmt::format("degree {} along {} is not between 1 and {}", degree, name, max_bspline_degree);
    }
    if (points <= degree) {
        return fmt::format("{} control points along {} are too few for degree {}", points, name, degree);
    }
    if (std::ssize(knots) != points + degree + 1) {
        return fmt::format("{} knots along {} do not match {} control points of degree {}: there must be {}",
                           knots.size(),
                           name,
                           points,
                           degree,
                           points + degree + 1);
    }
    if (!std::ranges::all_of(knots, [](double knot) { return std::isfinite(knot); })) {
        return fmt::format("a knot along {} is not finite", name);
    }
    if (!std::ranges::is_sorted(knots)) {
        return fmt::format("the knots along {} decrease", name);
    }
    const auto inner = knots.begin() + degree + 1, inner_end = knots.end() - degree - 1;
    if (!exactly_equal(knots.front(), 0.0) || !exactly_equal(*(inner - 1), 0.0) ||
        !exactly_equal(knots.back(), 1.0) || !exactly_equal(*inner_end, 1.0)) {
        return fmt::format(
            "the first {} knots along {} must be 0 and the last {} must be 1", degree + 1, name, degree + 1);
    }
    for (auto at = inner; at < inner_end; ++at) {
        if (!(*at > 0.0 && *at < 1.0) || (inner_end - at > degree && !(*at < *(at + degree)))) {
            return fmt::format("knot {} along {} is repeated more than {} times: the surface breaks there",
                               *at,
                               name,
                               degree);
        }
    }
    return {};
}

/// The sums over the points that count at a place.
template <int Order>
HomogeneousPoint homogeneous_at(const BsplineNet& net, std::span<const Vec4> points, double u, double v) {
    BsplineBasis bu, bv;
    fill<Order>(bu, net.knots_u, net.degree_u, u);
    fill<Order>(bv, net.knots_v, net.degree_v, v);
    HomogeneousPoint sum;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(net.degree_u); ++i) {
        const Vec4* point = &points[net.index(bu.first + static_cast<int>(i), bv.first)];
        Vec4 row = Vec4::Zero(), row_v = Vec4::Zero(), row_vv = Vec4::Zero();
        for (std::size_t j = 0; j <= static_cast<std::size_t>(net.degree_v); ++j, ++point) {
            row += bv.value[j] * *point;
            if constexpr (Order >= 1) {
                row_v += bv.slope[j] * *point;
            }
            if constexpr (Order == 2) {
                row_vv += bv.bend[j] * *point;
            }
        }
        sum.s += bu.value[i] * row;
        if constexpr (Order >= 1) {
            sum.u += bu.slope[i] * row;
            sum.v += bu.value[i] * row_v;
        }
        if constexpr (Order == 2) {
            sum.uu += bu.bend[i] * row;
            sum.uv += bu.slope[i] * row_v;
            sum.vv += bu.value[i] * row_vv;
        }
    }
    return sum;
}

/// The normal beside a side of the parameters that is one point in space: from inside, S_v goes to zero there
/// as
/// +-u S_uv. Nothing where that does not tell either.
std::optional<Vec3> limit_of_normal(double smallest, const SurfaceDerivatives& at, double u, double v) {
    const auto inwards = [](double t) { return t < 0.5 ? 1.0 : -1.0; };
    const bool has_du = at.du.norm() > smallest, has_dv = at.dv.norm() > smallest;
    if (has_du == has_dv) {
        return std::nullopt;
    }
    return has_du ? unit_normal(smallest, at.du, inwards(u) * at.duv)
                  : unit_normal(smallest, inwards(v) * at.duv, at.dv);
}

/// The points of one span's Bezier curve from those of the B-spline that count in it, `stride` apart. The
/// Bezier point r is the blossom at degree - r times the span's begin and r times its end.
/// Source: Farin, Curves and Surfaces for CAGD, ch. 8 (blossoms of B-splines).
std::vector<Vec4>
bezier_points(std::span<const double> knots, int degree, int span, std::vector<Vec4> of_bspline) {
    const auto knot = [&](int n) { return knots[static_cast<std::size_t>(n)]; };
    std::vector<Vec4> result;
    for (int r = 0; r <= degree; ++r) {
        std::vector<Vec4> d = of_bspline;
        for (int level = 1; level <= degree; ++level) {
            const double t = level <= degree - r ? knot(span) : knot(span + 1);
            for (int i = degree; i >= level; --i) {
                const double left = knot(span - degree + i), right = knot(span + 1 + i - level);
                const double share = (t - left) / (right - left);
                d[static_cast<std::size_t>(i)] = (1.0 - share) * d[static_cast<std::size_t>(i - 1)] +
                                                 share * d[static_cast<std::size_t>(i)];
            }
        }
        result.push_back(d[static_cast<std::size_t>(degree)]);
    }
    return result;
}

/// The knots at which spans that have a length begin.
std::vector<int> span_places(const std::vector<double>& knots, int degree) {
    std::vector<int> places;
    for (int k = degree; k + degree + 1 < std::ssize(knots); ++k) {
        if (knots[static_cast<std::size_t>(k)] < knots[static_cast<std::size_t>(k) + 1]) {
            places.push_back(k);
        }
    }
    return places;
}

/// The patch over the spans that begin at the knots `ku` and `kv`.
BezierPatch patch_over(const BsplineNet& net, std::span<const Vec4> points, int ku, int kv) {
    std::vector<std::vector<Vec4>> rows; // along v made Bezier, along u not yet
    for (int i = 0; i <= net.degree_u; ++i) {
        std::vector<Vec4> row;
        for (int j = 0; j <= net.degree_v; ++j) {
            row.push_back(points[net.index(ku - net.degree_u + i, kv - net.degree_v + j)]);
        }
        rows.push_back(bezier_points(net.knots_v, net.degree_v, kv, std::move(row)));
    }
    ControlNet patch = ControlNet::sized(net.degree_u + 1, net.degree_v + 1);
    for (int j = 0; j <= net.degree_v; ++j) {
        std::vector<Vec4> column;
        for (const std::vector<Vec4>& row : rows) {
            column.push_back(row[static_cast<std::size_t>(j)]);
        }
        column = bezier_points(net.knots_u, net.degree_u, ku, std::move(column));
        for (int i = 0; i <= net.degree_u; ++i) {
            const Vec4& h = column[static_cast<std::size_t>(i)];
            patch.point(i, j) = h.head<3>() / h.w();
            patch.weight(i, j) = h.w();
        }
    }
    return BezierPatch(std::move(patch));
}

} // namespace

std::string fault_of(const BsplineNet& net) {
    for (std::string fault : {fault_of_knots("u", net.knots_u, net.degree_u, net.rows),
                              fault_of_knots("v", net.knots_v, net.degree_v, net.columns)}) {
        if (!fault.empty()) {
            return fault;
        }
    }
    const auto count = static_cast<std::size_t>(net.rows) * static_cast<std::size_t>(net.columns);
    if (count > most_bspline_points) {
        return fmt::format("more than {} control points", most_bspline_points);
    }
    return fault_of_points(net);
}

BsplineNet turned_over(const BsplineNet& net) {
    BsplineNet turned = net;
    std::swap(turned.degree_u, turned.degree_v);
    std::swap(turned.knots_u, turned.knots_v);
    std::swap(turned.rows, turned.columns);
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            turned.points[turned.index(j, i)] = net.points[net.index(i, j)];
            turned.weights[turned.index(j, i)] = net.weights[net.index(i, j)];
        }
    }
    return turned;
}

std::vector<double> span_ends(const std::vector<double>& knots) {
    std::vector<double> ends = knots;
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
}

BsplineSurface::BsplineSurface(BsplineNet net) : net_(std::move(net)) {
    if (std::string fault = fault_of(net_); !fault.empty()) {
        throw Error(std::move(fault));
    }
    WeightedPoints points = weighted(net_.points, net_.weights);
    homogeneous_ = std::move(points.homogeneous);
    rational_ = points.rational;
    box_ = points.box;
    smallest_tangent_ = geometry::smallest_tangent(box_);
}

std::pair<int, int> BsplineSurface::spans() const {
    return {static_cast<int>(std::ssize(span_ends(net_.knots_u))) - 1,
            static_cast<int>(std::ssize(span_ends(net_.knots_v))) - 1};
}

Vec3 BsplineSurface::position(double u, double v) const {
    const HomogeneousPoint h = homogeneous_at<0>(net_, homogeneous_, u, v);
    return rational_ ? Vec3(h.s.head<3>() / h.s.w()) : Vec3(h.s.head<3>());
}

SurfaceDerivatives BsplineSurface::derivatives(double u, double v) const {
    const HomogeneousPoint h = homogeneous_at<2>(net_, homogeneous_, u, v);
    return rational_ ? projected(h)
                     : SurfaceDerivatives{h.s.head<3>(),
                                          h.u.head<3>(),
                                          h.v.head<3>(),
                                          h.uu.head<3>(),
                                          h.uv.head<3>(),
                                          h.vv.head<3>()};
}

SurfacePoint BsplineSurface::point(double u, double v) const {
    const HomogeneousPoint h = homogeneous_at<1>(net_, homogeneous_, u, v);
    SurfaceDerivatives at{h.s.head<3>(), h.u.head<3>(), h.v.head<3>()};
    if (rational_) {
        at = projected(h);
    }
    auto normal = geometry::unit_normal(smallest_tangent_, at.du, at.dv);
    return {at.position, normal ? normal : limit_of_normal(smallest_tangent_, derivatives(u, v), u, v)};
}

std::vector<SurfacePiece> BsplineSurface::pieces() const {
    std::vector<SurfacePiece> pieces;
    const auto end = [](const std::vector<double>& knots, int k) {
        return knots[static_cast<std::size_t>(k)];
    };
    for (const int ku : span_places(net_.knots_u, net_.degree_u)) {
        for (const int kv : span_places(net_.knots_v, net_.degree_v)) {
            pieces.push_back({patch_over(net_, homogeneous_, ku, kv),
                              {end(net_.knots_u, ku), end(net_.knots_v, kv)},
                              {end(net_.knots_u, ku + 1), end(net_.knots_v, kv + 1)}});
        }
    }
    return pieces;
}

std::shared_ptr<const ParametricSurface> BsplineSurface::shared() const {
    return std::make_shared<const BsplineSurface>(*this);
}

} // namespace millwright::geometry
