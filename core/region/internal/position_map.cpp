#include "core/region/internal/position_map.h"

#include "core/base/error.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace millwright::region {

namespace {

constexpr int degree = 3;
constexpr int reach = degree; // coefficients on either side that share a span

struct Sample {
    Vec2 place;
    Vec3 point;
    double weight = 1.0;
};

/// Four cubic B-splines of a span of equal knots at `t` in [0,1], whose first and last knots are simple: the
/// control points beyond the square go with the others.
std::array<double, 4> basis(double t) {
    const double r = 1.0 - t;
    return {r * r * r / 6.0,
            (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (3.0 * r * r * r - 6.0 * r * r + 4.0) / 6.0,
            t * t * t / 6.0};
}

/// Normal equations; the matrix as its rows of (2 reach + 1)^2 neighbours.
class Fit {
public:
    Fit(int spans_s, int spans_t)
        : spans_{spans_s, spans_t}, rows_(spans_s + degree), columns_(spans_t + degree),
          entries_(static_cast<std::size_t>(rows_ * columns_ * stencil * stencil), 0.0),
          right_(Eigen::MatrixX3d::Zero(rows_ * columns_, 3)) {}

    void add(const Sample& sample) {
        const auto [i, s] = span(sample.place.x(), spans_[0]);
        const auto [j, t] = span(sample.place.y(), spans_[1]);
        const std::array<double, 4> along = basis(s), across = basis(t);
        for (int a = 0; a < 16; ++a) {
            const double own = weight(along, across, a);
            const int row = index(i + a / 4, j + a % 4);
            right_.row(row) += sample.weight * own * sample.point.transpose();
            for (int b = 0; b < 16; ++b) {
                entry(row, b / 4 - a / 4, b % 4 - a % 4) += sample.weight * own * weight(along, across, b);
            }
        }
    }

    /// Holds what few samples reach: second differences of the control points.
    void smooth(double weight) {
        constexpr std::array<double, 3> second{1.0, -2.0, 1.0};
        for (int i = 0; i < rows_; ++i) {
            for (int j = 0; j < columns_; ++j) {
                for (int axis = 0; axis < 2; ++axis) {
                    const int at = axis == 0 ? i : j, count = axis == 0 ? rows_ : columns_;
                    if (at < 1 || at + 1 >= count) {
                        continue;
                    }
                    for (int a = -1; a <= 1; ++a) {
                        for (int b = -1; b <= 1; ++b) {
                            const int row = axis == 0 ? index(i + a, j) : index(i, j + a);
                            entry(row, axis == 0 ? b - a : 0, axis == 0 ? 0 : b - a) +=
                                weight * second[static_cast<std::size_t>(a + 1)] *
                                second[static_cast<std::size_t>(b + 1)];
                        }
                    }
                }
            }
        }
    }

    [[nodiscard]] Eigen::MatrixX3d solve() const {
        std::vector<Eigen::Triplet<double>> triplets;
        for (int row = 0; row < rows_ * columns_; ++row) {
            for (int n = 0; n < stencil * stencil; ++n) {
                const double value =
                    entries_[static_cast<std::size_t>(row) * stencil * stencil + static_cast<std::size_t>(n)];
                const int i = row / columns_ + n / stencil - reach, j = row % columns_ + n % stencil - reach;
                if (i >= 0 && i < rows_ && j >= 0 && j < columns_ && std::abs(value) > 0.0) {
                    triplets.emplace_back(row, index(i, j), value);
                }
            }
        }
        Eigen::SparseMatrix<double> matrix(rows_ * columns_, rows_ * columns_);
        matrix.setFromTriplets(triplets.begin(), triplets.end());
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
        const bool factored = factors.info() == Eigen::Success;
        Eigen::MatrixX3d found(right_.rows(), 3);
        for (int axis = 0; factored && axis < 3; ++axis) {
            const Eigen::VectorXd of_axis = right_.col(axis);
            found.col(axis) = factors.solve(of_axis);
        }
        if (!factored || !found.allFinite()) {
            throw Error(
                "no smooth surface follows the faces: some are too narrow for their places in the square",
                {},
                "choose other corners, or fewer faces");
        }
        return found;
    }

    [[nodiscard]] geometry::BsplineNet net() const {
        const Eigen::MatrixX3d found = solve();
        geometry::BsplineNet net;
        net.degree_u = net.degree_v = degree;
        net.rows = rows_;
        net.columns = columns_;
        net.knots_u = clamped_knots(spans_[0]);
        net.knots_v = clamped_knots(spans_[1]);
        net.points.resize(static_cast<std::size_t>(rows_ * columns_));
        net.weights.assign(net.points.size(), 1.0);
        for (int n = 0; n < rows_ * columns_; ++n) {
            net.points[static_cast<std::size_t>(n)] = found.row(n).transpose();
        }
        for (int j = 0; j < columns_; ++j) {
            clamp_ends(net, j, columns_, rows_);
        }
        for (int i = 0; i < rows_; ++i) {
            clamp_ends(net, i * columns_, 1, columns_);
        }
        return net;
    }

private:
    static constexpr int stencil = 2 * reach + 1;

    static std::pair<int, double> span(double place, int spans) {
        const double at = std::clamp(place, 0.0, 1.0) * spans;
        const int n = std::min(static_cast<int>(at), spans - 1);
        return {n, at - n};
    }
    static double weight(const std::array<double, 4>& along, const std::array<double, 4>& across, int n) {
        return along[static_cast<std::size_t>(n / 4)] * across[static_cast<std::size_t>(n % 4)];
    }
    [[nodiscard]] int index(int i, int j) const { return i * columns_ + j; }
    double& entry(int row, int down, int right) {
        return entries_[static_cast<std::size_t>(row) * stencil * stencil +
                        static_cast<std::size_t>((down + reach) * stencil + right + reach)];
    }

    static std::vector<double> clamped_knots(int spans) {
        std::vector<double> knots(degree, 0.0);
        for (int n = 0; n <= spans; ++n) {
            knots.push_back(static_cast<double>(n) / spans);
        }
        knots.insert(knots.end(), degree, 1.0);
        return knots;
    }

    /// The control points of equal knots become those of knots that end the curve: `count` points from
    /// `first` on, `step` apart. By blossoms at the ends: (0,0,0), (0,0,1), (0,1,2) from (-2,-1,0), (-1,0,1),
    /// (0,1,2).
    static void clamp_ends(geometry::BsplineNet& net, int first, int step, int count) {
        const auto point = [&](int n) -> Vec3& {
            return net.points[static_cast<std::size_t>(first + n * step)];
        };
        const auto end = [](Vec3& a, Vec3& b, const Vec3& c) {
            const Vec3 on_end = (a + 4.0 * b + c) / 6.0;
            b = (2.0 * b + c) / 3.0;
            a = on_end;
        };
        end(point(0), point(1), point(2));
        end(point(count - 1), point(count - 2), point(count - 3));
    }

    std::array<int, 2> spans_;
    int rows_, columns_;
    std::vector<double> entries_;
    Eigen::MatrixX3d right_;
};

/// The points of the mesh, the middles of its triangles and of the edges of its boundary, on the exact faces.
std::vector<Sample>
samples_of(std::span<const ExactFace> faces, const FaceMesh& mesh, const Flattening& flat) {
    constexpr double on_boundary = 100.0; // so that the border is met where it is
    std::vector<double> weights(mesh.points.size(), 1.0);
    for (const int n : mesh.boundary) {
        weights[static_cast<std::size_t>(n)] = on_boundary;
    }
    std::vector<Sample> samples;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
        samples.push_back({flat.places[n], mesh.points[n], weights[n]});
    }
    for (const FaceTriangle& triangle : mesh.triangles) {
        const auto on_face = [&](const std::array<double, 3>& shares, double weight) {
            Vec2 uv = Vec2::Zero(), place = Vec2::Zero();
            for (std::size_t k = 0; k < 3; ++k) {
                uv += shares[k] * triangle.parameters[k];
                place += shares[k] * flat.places[static_cast<std::size_t>(triangle.corners[k])];
            }
            const auto& face = faces[static_cast<std::size_t>(triangle.face)].surface;
            samples.push_back({place, face.position(uv.x(), uv.y()), weight});
        };
        on_face({1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, 1.0);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto weight = [&](std::size_t n) {
                return weights[static_cast<std::size_t>(triangle.corners[n % 3])];
            };
            if (weight(k) > 1.0 && weight(k + 1) > 1.0) {
                std::array<double, 3> shares{};
                shares[k] = shares[(k + 1) % 3] = 0.5;
                on_face(shares, on_boundary);
            }
        }
    }
    return samples;
}

} // namespace

geometry::BsplineSurface
position_map(std::span<const ExactFace> faces, const FaceMesh& mesh, const Flattening& flat) {
    constexpr double points_per_span = 1.5, fewest = 4.0, most = 96.0, longest = 6.0;
    const Vec2 extent = extent_of(mesh, flat.places);
    const double side = std::sqrt(static_cast<double>(mesh.points.size()) / points_per_span);
    const double shape = std::sqrt(std::clamp(extent.x() / extent.y(), 1.0 / longest, longest));
    const auto spans = [&](double count) {
        return static_cast<int>(std::clamp(std::round(count), fewest, most));
    };
    Fit fit(spans(side * shape), spans(side / shape));
    for (const Sample& sample : samples_of(faces, mesh, flat)) {
        fit.add(sample);
    }
    constexpr double smoothing = 1e-6; // beside samples of weight 1
    fit.smooth(smoothing);
    return geometry::BsplineSurface(fit.net());
}

} // namespace millwright::region
