// A Bezier patch S(u,v) = sum_ij w_ij P_ij B_i(u) B_j(v) / sum_ij w_ij B_i(u) B_j(v) on [0,1]^2.
// Source: Parasilmongkol 1997, ch. 2 eq. 13 (bicubic, all weights 1); rational form: Farin, Curves and
// Surfaces for CAGD, ch. 13.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/geometry/vectors.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace millwright::geometry {

/// Control points and weights, [rows x columns], row-major; the row index i belongs to u, the column to v.
struct ControlNet {
    int rows = 0;
    int columns = 0;
    std::vector<Vec3> points;    ///< mm
    std::vector<double> weights; ///< positive; 1 everywhere for a polynomial patch

    /// A net of zeros with weights 1.
    [[nodiscard]] static ControlNet sized(int rows, int columns);

    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(j);
    }
    [[nodiscard]] Vec3& point(int i, int j) { return points[index(i, j)]; }
    [[nodiscard]] const Vec3& point(int i, int j) const { return points[index(i, j)]; }
    [[nodiscard]] double& weight(int i, int j) { return weights[index(i, j)]; }
    [[nodiscard]] const double& weight(int i, int j) const { return weights[index(i, j)]; }

    friend bool operator==(const ControlNet&, const ControlNet&) = default;
};

/// What is wrong with a net as the net of a patch, as a sentence; empty if nothing is.
[[nodiscard]] std::string fault_of(const ControlNet& net);

inline constexpr int max_degree = 63; // fits the evaluation's buffers; far above any sensible design

class BezierPatch final : public ParametricSurface {
public:
    /// Throws Error with `fault_of(net)` if there is one.
    explicit BezierPatch(ControlNet net);

    [[nodiscard]] const ControlNet& net() const { return net_; }
    [[nodiscard]] int degree_u() const { return net_.rows - 1; }
    [[nodiscard]] int degree_v() const { return net_.columns - 1; }
    [[nodiscard]] bool rational() const { return rational_; }
    /// (w x, w y, w z, w) of the control points, as the net has them.
    [[nodiscard]] std::span<const Eigen::Vector4d> homogeneous() const { return homogeneous_; }
    /// The box of the control points.
    [[nodiscard]] const Box3& control_box() const override { return box_; }
    [[nodiscard]] double smallest_tangent() const override { return smallest_tangent_; }

    /// u and v may leave [0,1]: the polynomial goes on.
    [[nodiscard]] Vec3 position(double u, double v) const override;
    [[nodiscard]] SurfaceDerivatives derivatives(double u, double v) const override;
    [[nodiscard]] SurfacePoint point(double u, double v) const override;
    /// Itself alone.
    [[nodiscard]] std::vector<SurfacePiece> pieces() const override;
    [[nodiscard]] std::shared_ptr<const ParametricSurface> shared() const override;

    friend bool operator==(const BezierPatch& a, const BezierPatch& b) { return a.net_ == b.net_; }

private:
    ControlNet net_;
    std::vector<Eigen::Vector4d> homogeneous_;
    bool rational_ = false;
    Box3 box_;
    double smallest_tangent_ = 0.0;
};

/// A part of a surface as a patch, and the parameters of the surface at its two ends.
struct SurfacePiece {
    BezierPatch patch;
    Vec2 low = Vec2::Zero();
    Vec2 high = Vec2::Ones();
};

} // namespace millwright::geometry
