// The promise that no grid is handed out that is worse than the one it started from.
#pragma once

#include "core/base/progress.h"
#include "core/grid/error_model.h"

#include <optional>

namespace millwright::grid {

// Above the start's figures, and still no worse: what rounding makes of moves that are in both grids.
inline constexpr double negligible_mm =
    1e-6; ///< a nanometre: rounding on a part of a metre is a tenth of that
inline constexpr double negligible_rad = 1e-8; ///< a nanometre at 100 mm

/// What the start is worth: its path as it is run (ErrorModel::on_path), and each of its moves individually.
/// Judged finely.
class QualityGuard {
public:
    /// `model` must outlive this. Throws Cancelled.
    QualityGuard(const ErrorModel& model,
                 const Grid& start,
                 TrackDirection direction,
                 const Progress& progress);

    /// The figures of the path over `grid` if its mean, max and largest axis deviation are not above the
    /// start's (by what is not negligible) and its moves have a lower mean; else nothing. Throws Cancelled.
    [[nodiscard]] std::optional<ErrorSummary> kept_by(const Grid& grid, const Progress& progress) const;

private:
    const ErrorModel& model_;
    TrackDirection direction_;
    double mean_of_moves_;
    ErrorSummary path_;
};

} // namespace millwright::grid
