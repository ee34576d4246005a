#include "core/exchange/cloud_fit.h"

#include "core/base/error.h"
#include "core/exchange/internal/fit_deviation.h"
#include "core/exchange/internal/least_squares.h"
#include "core/exchange/internal/visible_side.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::exchange {

namespace {

using geometry::BezierPatch;

Box3 box_around(const std::vector<Vec3>& points) {
    Box3 box;
    for (const Vec3& point : points) {
        box.extend(point);
    }
    return box;
}

/// Across the plane that is nearest to the points: towards +z; where that is upright +y, then +x.
Vec3 across(const std::vector<Vec3>& points) {
    Vec3 middle = Vec3::Zero();
    for (const Vec3& point : points) {
        middle += point / static_cast<double>(points.size());
    }
    Mat3 spread = Mat3::Zero();
    for (const Vec3& point : points) {
        spread += (point - middle) * (point - middle).transpose();
    }
    const Vec3 normal = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().col(0);
    constexpr double upright = 1e-6; // cosine
    for (const int axis : {2, 1, 0}) {
        if (std::abs(normal[axis]) > upright) {
            return normal[axis] > 0.0 ? normal : Vec3(-normal);
        }
    }
    return normal;
}

/// As many of the points as are fitted, from the first to the last of the file.
std::vector<Vec3> thinned_out(const std::vector<Vec3>& points, std::size_t most) {
    if (points.size() <= most) {
        return points;
    }
    std::vector<Vec3> result;
    for (std::size_t n = 0; n < most; ++n) {
        result.push_back(points[n * (points.size() - 1) / (most - 1)]);
    }
    return result;
}

bool folds(const BezierPatch& patch, const Vec3& along) {
    constexpr int steps = 32;
    for (int n = 0; n < (steps + 1) * (steps + 1); ++n) {
        const auto normal = patch.unit_normal(static_cast<double>(n / (steps + 1)) / steps,
                                              static_cast<double>(n % (steps + 1)) / steps);
        if (!normal || !(normal->dot(along) > 0.0)) {
            return true;
        }
    }
    return false;
}

/// Least squares and corrected parameters in turn, as long as each round brings a hundredth.
FitRounds fair_rounds(const LeastSquares& squares,
                      std::vector<Sample> samples,
                      const FitSettings& settings,
                      const Progress& progress) {
    constexpr double worth_going_on = 0.99;
    FitRounds best{squares.solve(by_distance(samples), progress), 1};
    best.rms = correct_parameters(samples, best.patch, progress);
    while (best.rounds < settings.rounds) {
        BezierPatch next = squares.solve(by_tangents(samples, best.patch), progress);
        const double smaller = correct_parameters(samples, next, progress);
        if (!(smaller < best.rms) || folds(next, *settings.along)) {
            break;
        }
        const bool enough = smaller > worth_going_on * best.rms;
        best = {std::move(next), best.rounds + 1, smaller};
        if (enough) {
            break;
        }
    }
    return best;
}

} // namespace

int cloud_degree(std::size_t points) {
    constexpr int most = 5;
    int degree = 1;
    while (degree < most && std::cmp_less_equal((degree + 2) * (degree + 2), points)) {
        ++degree;
    }
    return degree;
}

bool stays_near(const BezierPatch& patch, const std::vector<Vec3>& points, double room) {
    Box3 box = box_around(points);
    const Vec3 enlarged = Vec3::Constant(room * box.diagonal().norm());
    box.min() -= enlarged;
    box.max() += enlarged;
    return box.contains(patch.control_box());
}

MeshFit fit_cloud(const std::vector<Vec3>& points, const FitSettings& given, const Progress& progress) {
    constexpr std::size_t fewest = 4;
    if (points.size() < fewest) {
        throw Error(fmt::format(
            "{} distinct points are too few for a surface, at least {} are needed", points.size(), fewest));
    }
    FitSettings settings = given;
    settings.along = given.along.value_or(across(points));
    const auto rectangle = least_rectangle(points, *settings.along);
    if (!rectangle) {
        throw Error("the points lie on a line");
    }
    std::vector<Sample> samples;
    for (const Vec3& point : thinned_out(points, static_cast<std::size_t>(settings.points))) {
        samples.push_back({point, rectangle->place_of(point).cwiseMax(0.0).cwiseMin(1.0), std::nullopt});
    }
    // The patch is a rectangle seen along its normal: where the points leave its corners empty, as those of a
    // twisted part do, it reaches beyond them.
    constexpr double near = 0.1, far = 0.4; // of their diagonal
    constexpr double least_weight = 1e-10, most_weight = 1.0;
    std::vector<std::pair<double, double>> tries; // weight of the fairness, room
    for (const double room : {near, far}) {
        for (double weight = least_weight; weight <= most_weight; weight *= 10.0) {
            tries.emplace_back(weight, room);
        }
    }
    for (const auto& [weight, room] : tries) {
        progress.report(0.1, "fitting the patch");
        const LeastSquares squares(settings.degree_u, settings.degree_v, weight);
        FitRounds fit = fair_rounds(squares, samples, settings, progress);
        if (!stays_near(fit.patch, points, room) || folds(fit.patch, *settings.along)) {
            continue;
        }
        progress.report(0.7, "measuring the deviation");
        Deviation deviation = deviation_of_points(points, fit.patch, progress);
        return {std::move(fit.patch),
                {},
                {points, {}},
                {},
                0.0,
                *settings.along,
                false,
                0,
                {},
                std::move(deviation),
                fit.rounds};
    }
    throw Error("no smooth patch was found near the points: seen from one side, they fold over themselves",
                {},
                "choose another side, or measure the part in several pieces");
}

} // namespace millwright::exchange
