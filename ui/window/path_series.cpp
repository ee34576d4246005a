#include "ui/window/path_series.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/project/setting_tables.h"
#include "ui/toolpath_panels/compare_view.h"
#include "ui/window/view_panel.h"
#include "ui/workspaces/shown_grid.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace millwright::panels {

ErrorOverPath error_over_path(const plan::Evaluation& evaluation) {
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

namespace {

PlottedPath
named(const actions::FrameState& now, std::shared_ptr<const plan::Evaluation> path, std::string name) {
    const bool of_grid = std::ranges::any_of(project::every_grid_method, [&](project::GridMethod method) {
        return now.evaluation(method) == path;
    });
    name += of_grid && path->outcome.status == grid::OptimiserStatus::no_gain ? " (same as uniform)" : "";
    name += path == now.program_path() ? ", program path" : "";
    name += actions::is_so_far(*path) ? " (preliminary)" : "";
    return {std::move(path), std::move(name)};
}

/// What stands beside the path on screen, else the path over the uniform grid; null where there is neither.
std::optional<PlottedPath> compared_path(const actions::FrameState& now) {
    if (auto compared = path_to_compare(now)) {
        return named(now, std::move(compared->path), std::move(compared->name));
    }
    auto uniform = now.evaluation(project::GridMethod::uniform);
    std::string name(project::row_of(project::grid_methods(), project::GridMethod::uniform).label);
    return uniform ? std::optional(named(now, std::move(uniform), std::move(name))) : std::nullopt;
}

} // namespace

std::vector<PlottedPath> plotted_paths(const actions::FrameState& now) {
    const auto shown = now.shown();
    if (!shown || now.in_file() || shows_import(now) ||
        now.view_state.workspace == actions::Workspace::plot) {
        return {};
    }
    std::vector<PlottedPath> paths;
    if (auto other = compared_path(now); other && other->path != shown) {
        paths.push_back(*std::move(other));
    }
    paths.push_back(named(now, shown, now.shown_name()));
    return paths;
}

double length_before(const plan::Evaluation& evaluation, int move, double fraction) {
    const auto& moves = evaluation.field.moves;
    double length = 0.0;
    for (int n = 0; n < move && n < static_cast<int>(moves.size()); ++n) {
        length += moves[static_cast<std::size_t>(n)].length;
    }
    const bool inside = move >= 0 && move < static_cast<int>(moves.size());
    return inside ? length + fraction * moves[static_cast<std::size_t>(move)].length : length;
}

TrajectorySeries series_over_way(const motion::Trajectory& trajectory,
                                 const program::Program& program,
                                 const plan::Evaluation& evaluation,
                                 int count) {
    expects(count >= 2, "a series has two values or more");
    TrajectorySeries series;
    const double step = trajectory.part_length() / (count - 1);
    double before = trajectory.time_at_part_length(0.0);
    for (int n = 0; n < count; ++n) {
        const double time = trajectory.time_at_part_length(step * n);
        const program::Block& block = program.blocks[static_cast<std::size_t>(trajectory.block_at(time))];
        const auto move = static_cast<std::size_t>(std::max(0, block.path_point - 1));
        const bool cuts = block.role == program::MoveRole::cut && move < evaluation.field.moves.size();
        series.error.push_back(cuts ? evaluation.field.moves[move].closest : 0.0);
        const double elapsed = time - before;
        series.feed_mm_per_min.push_back(elapsed > 0.0 ? to_mm_per_min(step / elapsed) : 0.0);
        before = time;
    }
    return series;
}

} // namespace millwright::panels
