// The Bezier patch that is nearest to points at given parameters.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/bezier_patch.h"

#include <optional>
#include <span>
#include <vector>

namespace millwright::exchange {

struct Sample {
    Vec3 point = Vec3::Zero();
    Vec2 uv = Vec2::Zero();
    std::optional<int> side; ///< of the square that it stays on, as OutlineEdge counts them
};

/// How much a miss counts, by its direction: (S - p)' metric (S - p).
struct Weighted {
    Sample sample;
    Mat3 metric = Mat3::Identity();
};

/// The net that is nearest to the samples at their parameters.
class LeastSquares {
public:
    /// `smoothness`: what bending counts against distance, mm^2 against mm^2.
    LeastSquares(int degree_u, int degree_v, double smoothness);

    [[nodiscard]] geometry::BezierPatch solve(const std::vector<Weighted>& samples,
                                              const Progress& progress) const;

private:
    void add(Eigen::MatrixXd& normal, Eigen::VectorXd& right, std::span<const Weighted> samples) const;
    [[nodiscard]] Eigen::RowVectorXd row_at(const Vec2& uv) const;

    int rows_;
    int columns_;
    Eigen::MatrixXd bending_;
};

} // namespace millwright::exchange
