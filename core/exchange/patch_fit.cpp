#include "core/exchange/patch_fit.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/exchange/internal/seen_side.h"
#include "core/exchange/internal/square_map.h"
#include "core/geometry/closest_point.h"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace millwright::exchange {

namespace {

using geometry::BezierPatch;
using geometry::ControlNet;

struct Sample {
    Vec3 point = Vec3::Zero();
    Vec2 uv = Vec2::Zero();
    std::optional<int> side; ///< of the square that it stays on, as OutlineEdge counts them
};

/// A mix of three points of the mesh.
struct Spread {
    std::array<int, 3> corners{};
    Vec3 shares = Vec3::Zero(); ///< of the corners; their sum is 1

    template <typename Value> [[nodiscard]] Value of(const std::vector<Value>& values) const {
        Value sum = Value::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            sum += shares[static_cast<Eigen::Index>(k)] * values[static_cast<std::size_t>(corners[k])];
        }
        return sum;
    }
};

/// Equally many on equal areas: by steps of equal area along the triangles, inside each by the sequence R2
/// (Roberts 2018), which leaves no gaps. The same points for the same mesh.
std::vector<Spread> spread_over(const TriangleMesh& mesh, double area, int count) {
    constexpr double plastic = 1.32471795724474602596;
    const double step = area / count;
    std::vector<Spread> samples;
    samples.reserve(static_cast<std::size_t>(count));
    double passed = 0.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        passed += 0.5 * mesh.doubled_area(n).norm();
        while ((static_cast<double>(samples.size()) + 0.5) * step < passed && std::ssize(samples) < count) {
            const double k = static_cast<double>(samples.size()) + 1.0;
            double whole = 0.0;
            double s = std::modf(0.5 + k / plastic, &whole);
            double t = std::modf(0.5 + k / (plastic * plastic), &whole);
            if (s + t > 1.0) {
                s = 1.0 - s;
                t = 1.0 - t;
            }
            samples.push_back({mesh.triangles[n], {1.0 - s - t, s, t}});
        }
    }
    return samples;
}

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

/// How much a miss counts, by its direction: (S - p)' metric (S - p).
struct Weighted {
    Sample sample;
    Mat3 metric = Mat3::Identity();
};

/// The net that is nearest to the samples at their parameters.
class LeastSquares {
public:
    LeastSquares(int degree_u, int degree_v, double smoothness)
        : rows_(degree_u + 1), columns_(degree_v + 1), bending_(smoothness * bending(rows_, columns_)) {}

    [[nodiscard]] BezierPatch solve(const std::vector<Weighted>& samples, const Progress& progress) const {
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

private:
    /// Unknowns are all x, then all y, then all z of the net.
    void add(Eigen::MatrixXd& normal, Eigen::VectorXd& right, std::span<const Weighted> samples) const {
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

    [[nodiscard]] Eigen::RowVectorXd row_at(const Vec2& uv) const {
        const Eigen::VectorXd u = bernstein(rows_ - 1, uv.x());
        const Eigen::VectorXd v = bernstein(columns_ - 1, uv.y());
        Eigen::RowVectorXd row(rows_ * columns_);
        for (int i = 0; i < rows_; ++i) {
            row.segment(i * columns_, columns_) = u[i] * v.transpose();
        }
        return row;
    }

    int rows_;
    int columns_;
    Eigen::MatrixXd bending_;
};

/// Every direction alike.
std::vector<Weighted> by_distance(const std::vector<Sample>& samples) {
    std::vector<Weighted> result;
    for (const Sample& sample : samples) {
        result.push_back({sample, Mat3::Identity()});
    }
    return result;
}

/// Across the patch, and on its outline across that, too; along hardly, which holds the parameters in their
/// places.
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

/// Each parameter goes to the nearest point of the patch. The root mean square of the distances, mm.
double correct(std::vector<Sample>& samples, const BezierPatch& patch, const Progress& progress) {
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

Deviation deviation_of(const std::vector<Vec3>& points, const BezierPatch& patch, const Progress& progress) {
    const geometry::ClosestPointSearch search(patch);
    Deviation result;
    result.at_points.resize(points.size());
    parallel_for(std::ssize(points), 256, [&](std::ptrdiff_t n) {
        if (progress.cancelled()) {
            return;
        }
        const Vec3& point = points[static_cast<std::size_t>(n)];
        const geometry::ClosestPoint nearest = search.closest(point);
        const std::optional<Vec3> normal = patch.unit_normal(nearest.parameters.x(), nearest.parameters.y());
        const bool below = normal && normal->dot(point - nearest.position) < 0.0;
        result.at_points[static_cast<std::size_t>(n)] = below ? -nearest.distance : nearest.distance;
    });
    progress.check();
    double squares = 0.0;
    for (const double distance : result.at_points) {
        result.max = std::max(result.max, std::abs(distance));
        result.mean += std::abs(distance);
        squares += distance * distance;
    }
    const double count = static_cast<double>(points.size());
    result.mean /= count;
    result.rms = std::sqrt(squares / count);
    return result;
}

void check(const FitSettings& settings) {
    const auto fits = [](int degree) { return degree >= 1 && degree <= max_fit_degree; };
    expects(fits(settings.degree_u) && fits(settings.degree_v), "a degree that can be fitted");
    expects(settings.points >= 100 && settings.rounds >= 1, "points and rounds enough for a fit");
    expects(!settings.along || std::abs(settings.along->norm() - 1.0) < 1e-9, "a unit direction");
}

/// Points on the triangles and on the outline, where the square has them.
std::vector<Sample> samples_on(const SquareMap& map, const SeenSide& side, int count) {
    constexpr int points_an_edge_on_average = 4;
    std::vector<Sample> samples;
    for (const Spread& spread : spread_over(side.mesh, side.area, count)) {
        samples.push_back({spread.of(side.mesh.points), spread.of(map.places), std::nullopt});
    }
    const int each =
        std::clamp<int>(count / (points_an_edge_on_average * static_cast<int>(map.outline.size())), 1, 20);
    for (const OutlineEdge& edge : map.outline) {
        for (int k = 0; k < each; ++k) {
            const double share = (k + 0.5) / each;
            const Spread spread{{edge.from, edge.to, edge.to}, {1.0 - share, share, 0.0}};
            // The last corner of a side has its place on the next side.
            samples.push_back(
                {spread.of(side.mesh.points), kept_on(edge.side, spread.of(map.places)), edge.side});
        }
    }
    return samples;
}

std::vector<Sample> samples_in(const Rectangle& rectangle, const SeenSide& side, int count) {
    std::vector<Sample> samples;
    for (const Spread& spread : spread_over(side.mesh, side.area, count)) {
        const Vec3 point = spread.of(side.mesh.points);
        samples.push_back({point, rectangle.place_of(point).cwiseMax(0.0).cwiseMin(1.0), std::nullopt});
    }
    return samples;
}

struct Approach {
    BezierPatch patch;
    int rounds = 0;
};

/// Least squares and corrected parameters in turn, as long as each round brings a hundredth.
Approach
approach(const LeastSquares& squares, std::vector<Sample> samples, int rounds, const Progress& progress) {
    constexpr double worth_going_on = 0.99; // of the distance of the round before
    Approach best{squares.solve(by_distance(samples), progress), 1};
    double rms = correct(samples, best.patch, progress);
    for (; best.rounds < rounds; ++best.rounds) {
        progress.report(static_cast<double>(best.rounds) / rounds, "fitting the patch");
        BezierPatch next = squares.solve(by_tangents(samples, best.patch), progress);
        const double smaller = correct(samples, next, progress);
        if (!(smaller < rms)) {
            break;
        }
        const bool enough = smaller > worth_going_on * rms;
        best.patch = std::move(next);
        rms = smaller;
        if (enough) {
            break;
        }
    }
    return best;
}

/// Bending against distance, mm^2 against mm^2: where the mesh is everywhere it alone decides, empty corners
/// of a rectangle have to be held.
constexpr double everywhere_filled = 1e-13;
constexpr double partly_empty = 1e-8;

} // namespace

MeshFit fit_patch(const TriangleMesh& mesh, const FitSettings& settings, const Progress& progress) {
    check(settings);
    const Vec3 along = settings.along.value_or(mean_direction(mesh));
    SeenSide side = seen_side(mesh, along);
    if (side.mesh.triangles.empty()) {
        throw Error(fmt::format(
            "no triangle of the mesh looks along ({:.3g}, {:.3g}, {:.3g})", along.x(), along.y(), along.z()));
    }
    const std::optional<Rectangle> rectangle = least_rectangle(side.mesh.points, along);
    if (!rectangle) {
        throw Error("the points of the mesh lie in a line");
    }
    const std::optional<SquareMap> square = square_map(side.mesh, *rectangle);
    progress.report(0.1, "fitting the patch");
    const LeastSquares squares(
        settings.degree_u, settings.degree_v, square ? everywhere_filled : partly_empty);
    Approach fit = approach(squares,
                            square ? samples_on(*square, side, settings.points)
                                   : samples_in(*rectangle, side, settings.points),
                            settings.rounds,
                            progress.part(0.1, 0.7));
    progress.report(0.7, "measuring the deviation");
    Deviation deviation = deviation_of(side.mesh.points, fit.patch, progress);
    return {std::move(fit.patch),
            std::move(side.mesh),
            std::move(side.left_out),
            side.left_out_area,
            along,
            square.has_value(),
            std::move(deviation),
            fit.rounds};
}

} // namespace millwright::exchange
