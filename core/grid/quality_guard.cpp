#include "core/grid/quality_guard.h"

namespace millwright::grid {

namespace {

double
mean_of_moves(const ErrorModel& model, const Grid& grid, TrackDirection direction, const Progress& progress) {
    return summary(measure(model, grid, direction, fine, progress)).mean;
}

} // namespace

QualityGuard::QualityGuard(const ErrorModel& model,
                           const Grid& start,
                           TrackDirection direction,
                           const Progress& progress)
    : model_(model), direction_(direction), mean_of_moves_(mean_of_moves(model, start, direction, progress)),
      path_(model.on_path(start, direction, progress)) {}

std::optional<ErrorSummary> QualityGuard::kept_by(const Grid& grid, const Progress& progress) const {
    const ErrorSummary path = model_.on_path(grid, direction_, progress);
    const bool path_is_kept = path.mean <= path_.mean + negligible_mm &&
                              path.max <= path_.max + negligible_mm &&
                              path.axis_max <= path_.axis_max + negligible_rad;
    if (path_is_kept && mean_of_moves(model_, grid, direction_, progress) < mean_of_moves_) {
        return path;
    }
    return std::nullopt;
}

} // namespace millwright::grid
