#include "core/jobs/internal/path_estimate.h"

#include <algorithm>
#include <utility>

namespace millwright::jobs::internal {

namespace {

constexpr double on_path_within = 0.5;         // mm: chords of arcs, rounded reports
constexpr std::size_t most_moves_ahead = 5000; // that a controller can have, with short moves

/// Of the point of a move that is nearest to `at`, 0 to 1.
double nearest_part(const Vec3& at, const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const double length = way.squaredNorm();
    return length > 0.0 ? std::clamp((at - from).dot(way) / length, 0.0, 1.0) : 0.0;
}

} // namespace

PathEstimate::PathEstimate(std::vector<ProgramCheck::MoveEnd> path, const Vec3& start)
    : path_(std::move(path)), start_(start) {}

double PathEstimate::length_of(std::size_t move) const {
    return (path_[move].at - begin_of(move)).norm();
}

/// A line may have many moves: the pieces of an arc, a canned cycle.
double PathEstimate::fraction_of_line(std::size_t move, double part) const {
    const int line = path_[move].line;
    double done = part * length_of(move);
    double whole = length_of(move);
    for (std::size_t n = move; n > 0 && path_[n - 1].line == line; --n) {
        done += length_of(n - 1);
        whole += length_of(n - 1);
    }
    for (std::size_t n = move + 1; n < path_.size() && path_[n].line == line; ++n) {
        whole += length_of(n);
    }
    return whole > 0.0 ? done / whole : 0.0;
}

PathPlace PathEstimate::place_at(const Vec3& at, int first, int last) {
    while (next_ < path_.size() && path_[next_].line < first) {
        ++next_;
    }
    const std::size_t end = std::min(path_.size(), next_ + most_moves_ahead);
    for (std::size_t n = next_; n < end && path_[n].line <= last; ++n) {
        const Vec3& from = begin_of(n);
        const double part = nearest_part(at, from, path_[n].at);
        if ((at - from - part * (path_[n].at - from)).norm() <= on_path_within) {
            const PathPlace found{path_[n].line, fraction_of_line(n, part)};
            const bool is_behind =
                found.line == place_.line && found.fraction < place_.fraction && n == next_;
            place_ = is_behind ? place_ : found;
            next_ = n;
            break;
        }
    }
    if (place_.line < first) {
        place_ = {first, 0.0};
    }
    return place_;
}

} // namespace millwright::jobs::internal
