// A B-spline surface S(u,v) = sum_ij w_ij P_ij N_i,p(u) N_j,q(v) / sum_ij w_ij N_i,p(u) N_j,q(v) of any
// number of spans on [0,1]^2: a face of a CAD model as it is. Source: Piegl and Tiller, The NURBS Book, ch.
// 3, 4 and algorithm A2.3.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/parametric_surface.h"
#include "core/geometry/vectors.h"

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace millwright::geometry {

/// Control points, [rows x columns], row-major, and knots. A row belongs to u, a column to v.
struct BsplineNet {
    int degree_u = 0;
    int degree_v = 0;
    /// rows + degree_u + 1 and columns + degree_v + 1 numbers that do not fall, from 0 to 1: the first and
    /// last degree + 1 are equal, those inside at most `degree` times.
    std::vector<double> knots_u, knots_v;
    int rows = 0;
    int columns = 0;
    std::vector<Vec3> points;    ///< mm
    std::vector<double> weights; ///< positive; 1 everywhere for a polynomial surface

    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(j);
    }

    friend bool operator==(const BsplineNet&, const BsplineNet&) = default;
};

inline constexpr int max_bspline_degree = 25; ///< as that of Open CASCADE
inline constexpr int most_bspline_points = 1'000'000;

/// What is wrong with a net as that of a surface, as a sentence; empty if nothing is.
[[nodiscard]] std::string fault_of(const BsplineNet& net);

/// u and v changed for each other: the normal looks the other way.
[[nodiscard]] BsplineNet turned_over(const BsplineNet& net);

/// The different knots: where the spans begin and end, from 0 to 1.
[[nodiscard]] std::vector<double> span_ends(const std::vector<double>& knots);

class BsplineSurface final : public ParametricSurface {
public:
    /// Throws Error with `fault_of(net)` if there is one.
    explicit BsplineSurface(BsplineNet net);

    [[nodiscard]] const BsplineNet& net() const { return net_; }
    [[nodiscard]] bool rational() const { return rational_; }
    /// How many there are along u and v.
    [[nodiscard]] std::pair<int, int> spans() const;

    /// Outside of [0,1] the polynomials of the first and last span go on. At a knot the derivatives are those
    /// of the span behind it, at 1 of the last.
    [[nodiscard]] Vec3 position(double u, double v) const override;
    [[nodiscard]] SurfaceDerivatives derivatives(double u, double v) const override;
    /// At a side of the parameters that is one point in space the normal is the limit of those beside it.
    [[nodiscard]] SurfacePoint point(double u, double v) const override;
    [[nodiscard]] const Box3& control_box() const override { return box_; }
    [[nodiscard]] double smallest_tangent() const override { return smallest_tangent_; }
    /// One for each span, row by row.
    [[nodiscard]] std::vector<SurfacePiece> pieces() const override;
    [[nodiscard]] std::shared_ptr<const ParametricSurface> shared() const override;

    friend bool operator==(const BsplineSurface& a, const BsplineSurface& b) { return a.net_ == b.net_; }

private:
    BsplineNet net_;
    std::vector<Eigen::Vector4d> homogeneous_;
    bool rational_ = false;
    Box3 box_;
    double smallest_tangent_ = 0.0;
};

} // namespace millwright::geometry
