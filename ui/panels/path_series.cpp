#include "ui/panels/path_series.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <algorithm>
#include <limits>

namespace millwright::panels {

ErrorOverPath error_over_path(const project::Evaluation& evaluation) {
    ErrorOverPath series;
    double length = 0.0;
    for (const toolpath::MoveDeviation& move : evaluation.field.moves) {
        series.at.push_back(length + 0.5 * move.length);
        const bool links = move.kind != toolpath::MoveKind::track;
        series.error.push_back(links ? std::numeric_limits<double>::quiet_NaN() : move.closest);
        length += move.length;
    }
    return series;
}

double length_before(const project::Evaluation& evaluation, int move, double fraction) {
    const auto& moves = evaluation.field.moves;
    double length = 0.0;
    for (int n = 0; n < move && n < static_cast<int>(moves.size()); ++n) {
        length += moves[static_cast<std::size_t>(n)].length;
    }
    const bool inside = move >= 0 && move < static_cast<int>(moves.size());
    return inside ? length + fraction * moves[static_cast<std::size_t>(move)].length : length;
}

TrajectorySeries series_over_way(const motion::Trajectory& trajectory,
                                 const gcode::Program& program,
                                 const project::Evaluation& evaluation,
                                 int count) {
    expects(count >= 2, "a series has two values or more");
    TrajectorySeries series;
    const double step = trajectory.part_length() / (count - 1);
    double before = trajectory.time_at_part_length(0.0);
    for (int n = 0; n < count; ++n) {
        const double time = trajectory.time_at_part_length(step * n);
        const gcode::Block& block = program.blocks[static_cast<std::size_t>(trajectory.block_at(time))];
        const auto move = static_cast<std::size_t>(std::max(0, block.path_point - 1));
        const bool cuts = block.role == gcode::MoveRole::cut && move < evaluation.field.moves.size();
        series.error.push_back(cuts ? evaluation.field.moves[move].closest : 0.0);
        const double elapsed = time - before;
        series.feed_mm_per_min.push_back(elapsed > 0.0 ? to_mm_per_min(step / elapsed) : 0.0);
        before = time;
    }
    return series;
}

} // namespace millwright::panels
