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

// Rounds of a fit: least squares, and the parameters of the points corrected in between.

struct FitRounds {
    geometry::BezierPatch patch;
    int rounds = 0;
    double rms = 0.0; ///< of the points that are fitted, mm
};

/// Every direction alike.
[[nodiscard]] std::vector<Weighted> by_distance(const std::vector<Sample>& samples);

/// Across the patch, and on its outline across that, too; along hardly, which holds the parameters in their
/// places.
[[nodiscard]] std::vector<Weighted> by_tangents(const std::vector<Sample>& samples,
                                                const geometry::BezierPatch& patch);

/// On that side of the square.
[[nodiscard]] Vec2 kept_on(int side, Vec2 uv);

/// Each parameter goes to the nearest point of the patch. The root mean square of the distances, mm. Throws
/// Cancelled.
[[nodiscard]] double correct_parameters(std::vector<Sample>& samples,
                                        const geometry::BezierPatch& patch,
                                        const Progress& progress);

} // namespace millwright::exchange
