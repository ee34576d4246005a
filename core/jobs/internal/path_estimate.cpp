#include "core/jobs/internal/path_estimate.h"

#include <algorithm>
#include <utility>

namespace millwright::jobs::internal {

namespace {

constexpr double on_path_within = 0.5;         // mm: chords of arcs, rounded reports
constexpr std::size_t most_moves_ahead = 5000; // that a controller can have, with short moves

double distance_to_move(const Vec3& at, const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const double length = way.squaredNorm();
    const double part = length > 0.0 ? std::clamp((at - from).dot(way) / length, 0.0, 1.0) : 0.0;
    return (at - from - part * way).norm();
}

} // namespace

PathEstimate::PathEstimate(std::vector<Survey::PathPoint> path, const Vec3& start)
    : path_(std::move(path)), start_(start) {}

int PathEstimate::line_at(const Vec3& at, int first, int last) {
    while (next_ < path_.size() && path_[next_].line < first) {
        ++next_;
    }
    const std::size_t end = std::min(path_.size(), next_ + most_moves_ahead);
    for (std::size_t n = next_; n < end && path_[n].line <= last; ++n) {
        const Vec3& from = n == 0 ? start_ : path_[n - 1].at;
        if (distance_to_move(at, from, path_[n].at) <= on_path_within) {
            next_ = n;
            line_ = path_[n].line;
            break;
        }
    }
    line_ = std::max(line_, first);
    return line_;
}

} // namespace millwright::jobs::internal
