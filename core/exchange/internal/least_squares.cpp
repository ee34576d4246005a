#include "core/exchange/internal/least_squares.h"

#include "core/base/parallel.h"
#include "core/geometry/closest_point.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace millwright::exchange {

using geometry::BezierPatch;
using geometry::ControlNet;

namespace {

/// B_0^n(t) ... B_n^n(t).
Eigen::VectorXd bernstein(int degree, double t) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(degree + 1);
    values[0] = 1.0;
    for (int n = 1; n <= degree; ++n) {
        for (int i = n; i > 0; --i) {
            values[i] = (1.0 - t) * values[i] + t * values[i - 1];
        }
        values[0] *= 1.0 - t;
    }
    return values;
}

/// Sum of the squares of all second differences of a net, as a matrix over its points.
Eigen::MatrixXd bending(int rows, int columns) {
    const int count = rows * columns;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
    const auto add = [&](std::initializer_list<std::pair<int, double>> difference) {
        for (const auto& [a, wa] : difference) {
            for (const auto& [b, wb] : difference) {
                matrix(a, b) += wa * wb;
            }
        }
    };
    const auto at = [&](int i, int j) { return i * columns + j; };
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            if (i > 0 && i + 1 < rows) {
                add({{at(i - 1, j), 1.0}, {at(i, j), -2.0}, {at(i + 1, j), 1.0}});
            }
            if (j > 0 && j + 1 < columns) {
                add({{at(i, j - 1), 1.0}, {at(i, j), -2.0}, {at(i, j + 1), 1.0}});
            }
            if (i + 1 < rows && j + 1 < columns) {
                add({{at(i, j), 1.0}, {at(i + 1, j), -1.0}, {at(i, j + 1), -1.0}, {at(i + 1, j + 1), 1.0}});
            }
        }
    }
    return matrix;
}

} // namespace

LeastSquares::LeastSquares(int degree_u, int degree_v, double smoothness)
    : rows_(degree_u + 1), columns_(degree_v + 1), bending_(smoothness * bending(rows_, columns_)) {}

BezierPatch LeastSquares::solve(const std::vector<Weighted>& samples, const Progress& progress) const {
    constexpr std::size_t block = 500;
    const int count = rows_ * columns_;
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(3 * count);
    for (std::size_t first = 0; first < samples.size(); first += block) {
        progress.check();
        add(normal, right, std::span(samples).subspan(first, std::min(block, samples.size() - first)));
    }
    const double share = 1.0 / static_cast<double>(samples.size());
    normal *= share;
    for (int axis = 0; axis < 3; ++axis) {
        normal.block(axis * count, axis * count, count, count) += bending_;
    }
    const Eigen::VectorXd net = normal.ldlt().solve(share * right);
    ControlNet result = ControlNet::sized(rows_, columns_);
    for (int n = 0; n < count; ++n) {
        result.points[static_cast<std::size_t>(n)] = {net[n], net[count + n], net[2 * count + n]};
    }
    return BezierPatch(std::move(result));
}

/// Unknowns are all x, then all y, then all z of the net.
void LeastSquares::add(Eigen::MatrixXd& normal,
                       Eigen::VectorXd& right,
                       std::span<const Weighted> samples) const {
    const int count = rows_ * columns_;
    const Eigen::Index size = std::ssize(samples);
    Eigen::MatrixXd basis(size, count);
    for (Eigen::Index k = 0; k < size; ++k) {
        basis.row(k) = row_at(samples[static_cast<std::size_t>(k)].sample.uv);
    }
    Eigen::VectorXd weights(size);
    Eigen::VectorXd pulls(size);
    for (int a = 0; a < 3; ++a) {
        for (int c = 0; c < 3; ++c) {
            for (Eigen::Index k = 0; k < size; ++k) {
                weights[k] = samples[static_cast<std::size_t>(k)].metric(a, c);
            }
            normal.block(a * count, c * count, count, count).noalias() +=
                basis.transpose() * weights.asDiagonal() * basis;
        }
        for (Eigen::Index k = 0; k < size; ++k) {
            const Weighted& at = samples[static_cast<std::size_t>(k)];
            pulls[k] = at.metric.row(a).dot(at.sample.point);
        }
        right.segment(a * count, count) += basis.transpose() * pulls;
    }
}

Eigen::RowVectorXd LeastSquares::row_at(const Vec2& uv) const {
    const Eigen::VectorXd u = bernstein(rows_ - 1, uv.x());
    const Eigen::VectorXd v = bernstein(columns_ - 1, uv.y());
    Eigen::RowVectorXd row(rows_ * columns_);
    for (int i = 0; i < rows_; ++i) {
        row.segment(i * columns_, columns_) = u[i] * v.transpose();
    }
    return row;
}

using geometry::BezierPatch;

std::vector<Weighted> by_distance(const std::vector<Sample>& samples) {
    std::vector<Weighted> result;
    for (const Sample& sample : samples) {
        result.push_back({sample, Mat3::Identity()});
    }
    return result;
}

std::vector<Weighted> by_tangents(const std::vector<Sample>& samples, const BezierPatch& patch) {
    constexpr double along = 1e-3;
    std::vector<Weighted> result;
    for (const Sample& sample : samples) {
        const auto at = patch.derivatives(sample.uv.x(), sample.uv.y());
        const auto normal = patch.unit_normal(at);
        Mat3 metric = Mat3::Identity();
        if (sample.side) {
            const Vec3 way = (*sample.side % 2 == 0 ? at.du : at.dv).normalized();
            metric -= (1.0 - along) * way * way.transpose();
        } else if (normal) {
            metric = *normal * normal->transpose() + along * Mat3::Identity();
        }
        result.push_back({sample, metric});
    }
    return result;
}

Vec2 kept_on(int side, Vec2 uv) {
    uv[side % 2 == 0 ? 1 : 0] = side == 1 || side == 2 ? 1.0 : 0.0;
    return uv;
}

double correct_parameters(std::vector<Sample>& samples, const BezierPatch& patch, const Progress& progress) {
    std::vector<double> squares(samples.size());
    parallel_for(std::ssize(samples), 256, [&](std::ptrdiff_t n) {
        if (progress.cancelled()) {
            return;
        }
        Sample& sample = samples[static_cast<std::size_t>(n)];
        const geometry::ClosestPoint nearest = geometry::closest_point_near(patch, sample.point, sample.uv);
        sample.uv = sample.side ? kept_on(*sample.side, nearest.parameters) : nearest.parameters;
        squares[static_cast<std::size_t>(n)] = nearest.distance * nearest.distance;
    });
    progress.check();
    double sum = 0.0;
    for (const double square : squares) {
        sum += square;
    }
    return std::sqrt(sum / static_cast<double>(samples.size()));
}

} // namespace millwright::exchange
