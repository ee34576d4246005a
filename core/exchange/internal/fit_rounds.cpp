#include "core/exchange/internal/fit_rounds.h"

#include "core/base/parallel.h"
#include "core/geometry/closest_point.h"

#include <cmath>

namespace millwright::exchange {

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
