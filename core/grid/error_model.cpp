#include "core/grid/error_model.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace millwright::grid {

namespace {

bool is_out_of_reach(const MoveError& move) {
    return !std::isfinite(move.tip) || !std::isfinite(move.axis);
}

/// The smallest value that at least 95 % of `tips` do not exceed.
double nearest_rank_95(std::vector<double> tips) {
    const std::ptrdiff_t rank = (std::ssize(tips) * 95 + 99) / 100;
    const auto wanted = tips.begin() + (rank - 1);
    std::ranges::nth_element(tips, wanted);
    return *wanted;
}

} // namespace

ErrorSummary out_of_reach() {
    return {infinity, infinity, infinity, infinity, infinity, infinity, infinity, infinity};
}

ErrorSummary ErrorModel::on_path(const Grid& grid, TrackDirection direction, const Progress& progress) const {
    return summary(measure(*this, grid, direction, fine, progress));
}

std::vector<MoveError> measure(const ErrorModel& model,
                               const Grid& grid,
                               TrackDirection direction,
                               Sampling sampling,
                               const Progress& progress) {
    const int tracks = grid.track_count(direction);
    const int moves = grid.nodes_per_track(direction) - 1;
    std::vector<MoveError> found(static_cast<std::size_t>(tracks) * static_cast<std::size_t>(moves));
    parallel_for(tracks, 1, [&](std::ptrdiff_t track) {
        progress.check();
        const int t = static_cast<int>(track);
        for (int k = 0; k < moves; ++k) {
            found[static_cast<std::size_t>(track * moves + k)] =
                model.move(grid.track_node(direction, t, k), grid.track_node(direction, t, k + 1), sampling);
        }
    });
    return found;
}

ErrorSummary summary(std::span<const MoveError> moves) {
    expects(!moves.empty(), "a summary of errors has at least one move");
    if (std::ranges::any_of(moves, is_out_of_reach)) {
        return out_of_reach();
    }
    const auto count = static_cast<double>(moves.size());
    ErrorSummary s;
    std::vector<double> tips;
    tips.reserve(moves.size());
    double length = 0.0;
    double squares = 0.0;
    for (const MoveError& move : moves) {
        tips.push_back(move.tip);
        s.max = std::max(s.max, move.tip);
        s.mean += move.tip / count;
        s.lmean += move.tip * move.length;
        squares += square(move.tip) / count;
        s.axis_max = std::max(s.axis_max, move.axis);
        s.axis_mean += move.axis / count;
        length += move.length;
    }
    s.lmean = length > 0.0 ? s.lmean / length : s.mean;
    s.rms = std::sqrt(squares);
    for (const double tip : tips) {
        s.variance += square(tip - s.mean) / count;
    }
    s.p95 = nearest_rank_95(std::move(tips));
    return s;
}

} // namespace millwright::grid
