#include "core/plan/evaluation.h"

#include "core/geometry/outline_tree.h"
#include "core/plan/planned_time.h"
#include "core/toolpath/tool_poses.h"
#include "core/toolpath/trimmed_path.h"
#include "core/toolpath/turning_over.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace millwright::plan {

using toolpath::Distance;
using toolpath::MoveKind;

namespace {

/// The costs of a way know of no accelerations: of several the planner finds the fastest.
toolpath::SequencedPath
fastest(const CuttingSetup& cutting_setup, const toolpath::Toolpath& path, const Progress& progress) {
    using toolpath::SequencingGoal;
    constexpr std::array goals{SequencingGoal::time, SequencingGoal::travel, SequencingGoal::nearest};
    toolpath::SequencedPath best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < goals.size(); ++n) {
        const auto share = [&](double at) {
            return (static_cast<double>(n) + at) / static_cast<double>(goals.size());
        };
        toolpath::SequencingSettings settings = cutting_setup.sequencing;
        settings.goal = goals[n];
        toolpath::SequencedPath way = toolpath::sequenced(cutting_setup.patch,
                                                          cutting_setup.machine,
                                                          path,
                                                          settings,
                                                          progress.part(share(0.0), share(0.8)));
        const std::optional<double> time = planned_time(way.toolpath,
                                                        way.axes,
                                                        cutting_setup.machine,
                                                        cutting_setup.timing,
                                                        progress.part(share(0.8), share(1.0)));
        if (n == 0 || (time && *time < least)) {
            best = std::move(way);
            least = time.value_or(least);
        }
    }
    return best;
}

/// Before it is trimmed.
toolpath::Toolpath contacts_of(const CuttingSetup& cutting_setup,
                               const grid::Grid& grid,
                               const toolpath::StrategySettings& strategy,
                               const Progress& progress) {
    const geometry::OutlineTree outline(cutting_setup.trim);
    const toolpath::Covering all{cutting_setup.patch,
                                 cutting_setup.machine,
                                 cutting_setup.tool,
                                 grid,
                                 cutting_setup.direction,
                                 cutting_setup.flipped,
                                 cutting_setup.trim.everything() ? nullptr : &outline};
    return toolpath::make_strategy(strategy)->contacts(all, progress);
}

toolpath::SequencedPath path_of(const CuttingSetup& cutting_setup,
                                const grid::Grid& grid,
                                const toolpath::StrategySettings& strategy,
                                const Progress& progress) {
    constexpr double covering = 0.5; // share of the work
    toolpath::Toolpath contacts = contacts_of(cutting_setup, grid, strategy, progress.part(0.0, covering));
    toolpath::refuse_turning_over(cutting_setup.patch, cutting_setup.trim, grid, contacts);
    contacts = toolpath::trimmed(
        cutting_setup.patch, cutting_setup.trim, std::move(contacts), cutting_setup.flipped);
    toolpath::Toolpath path = toolpath::with_tool(
        cutting_setup.patch, cutting_setup.machine, cutting_setup.tool, std::move(contacts));
    const bool consistent = cutting_setup.angle_mode == kinematics::AngleMode::consistent;
    if (consistent && cutting_setup.sequencing.goal == toolpath::SequencingGoal::time) {
        return fastest(cutting_setup, path, progress.part(covering, 1.0));
    }
    if (consistent) {
        return toolpath::sequenced(cutting_setup.patch,
                                   cutting_setup.machine,
                                   std::move(path),
                                   cutting_setup.sequencing,
                                   progress.part(covering, 1.0));
    }
    toolpath::AxisPath axes =
        toolpath::sequence_by_formulas(cutting_setup.machine, path, cutting_setup.angle_mode);
    return {std::move(path), std::move(axes)};
}

grid::TrackDirection across(grid::TrackDirection direction) {
    return direction == grid::TrackDirection::along_v ? grid::TrackDirection::along_u
                                                      : grid::TrackDirection::along_v;
}

std::optional<double>
track_gap(const CuttingSetup& cutting_setup, const grid::Grid& grid, toolpath::StrategyKind strategy) {
    const toolpath::KinematicError model = cutting_setup.error_model();
    switch (strategy) {
    case toolpath::StrategyKind::zigzag:
        return model.track_gap(grid, cutting_setup.direction);
    case toolpath::StrategyKind::spiral: // two sides of each round go across
        return std::max(model.track_gap(grid, cutting_setup.direction),
                        model.track_gap(grid, across(cutting_setup.direction)));
    case toolpath::StrategyKind::fewest_points:
        return model.track_gap(grid::Grid::uniform(grid.nu(), grid.nv()), cutting_setup.direction);
    case toolpath::StrategyKind::constant_scallop:
        break;
    }
    return std::nullopt;
}

} // namespace

toolpath::KinematicError CuttingSetup::error_model() const {
    const bool consistent = angle_mode == kinematics::AngleMode::consistent;
    return {patch, machine, flipped, tool, consistent ? sequencing : toolpath::SequencingSettings{}};
}

Evaluation evaluate(const CuttingSetup& cutting_setup,
                    GridOutcome outcome,
                    toolpath::MoveSampling sampling,
                    const Progress& progress) {
    return evaluate(cutting_setup, std::move(outcome), {}, sampling, progress);
}

Evaluation evaluate(const CuttingSetup& cutting_setup,
                    GridOutcome outcome,
                    const toolpath::StrategySettings& strategy,
                    toolpath::MoveSampling sampling,
                    const Progress& progress) {
    progress.check();
    constexpr double sequencing = 0.3; // share of the work
    toolpath::SequencedPath path =
        path_of(cutting_setup, outcome.grid, strategy, progress.part(0.0, sequencing));
    toolpath::ErrorField field = toolpath::error_field(cutting_setup.patch,
                                                       cutting_setup.machine,
                                                       path.toolpath,
                                                       path.axes,
                                                       sampling,
                                                       progress.part(sequencing, 1.0));
    const grid::ErrorSummary closest = toolpath::summary(field, Distance::closest, MoveKind::track);
    const grid::ErrorSummary param = toolpath::summary(field, Distance::param, MoveKind::track);
    const grid::ErrorSummary cross = toolpath::summary(field, Distance::closest, MoveKind::cross);
    const std::optional<double> gap = track_gap(cutting_setup, outcome.grid, strategy.kind);
    const double length = toolpath::length(path.toolpath);
    return {std::move(outcome),
            std::move(path.toolpath),
            std::move(path.axes),
            std::move(field),
            closest,
            param,
            cross,
            gap,
            length,
            cutting_setup.sequencing.goal};
}

} // namespace millwright::plan
