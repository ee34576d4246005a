#include "core/plan/strategy_path.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/plan/grids.h"
#include "core/plan/internal/failure.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/setting_tables.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace millwright::plan {

bool follows_nodes(project::StrategyInput strategy) {
    return strategy == project::StrategyInput::zigzag || strategy == project::StrategyInput::spiral;
}

project::GridMethod program_grid(const project::Project& project) {
    return follows_nodes(project.toolpath.strategy) ? project.grid.method : project::GridMethod::uniform;
}

bool has_own_path(const project::Project& project) {
    const project::StrategyInput strategy = project.toolpath.strategy;
    return strategy != project::StrategyInput::zigzag && strategy != project::StrategyInput::iso_parametric;
}

toolpath::StrategySettings strategy_settings(const project::Project& project) {
    using toolpath::StrategyKind;
    toolpath::StrategySettings settings;
    switch (project.toolpath.strategy) {
    case project::StrategyInput::zigzag:
    case project::StrategyInput::iso_parametric:
        break;
    case project::StrategyInput::spiral:
        settings.kind = StrategyKind::spiral;
        break;
    case project::StrategyInput::constant_scallop:
        settings.kind = StrategyKind::constant_scallop;
        settings.scallop = project.tool.scallop_mm;
        break;
    case project::StrategyInput::fewest_points:
        settings.kind = StrategyKind::fewest_points;
        settings.tolerance = project.toolpath.tolerance_mm;
        break;
    }
    return settings;
}

std::string strategy_text(const project::Project& project) {
    const project::StrategyInput strategy = project.toolpath.strategy;
    const std::string_view label = project::row_of(project::strategies(), strategy).label;
    if (strategy == project::StrategyInput::constant_scallop) {
        return fmt::format("{}, {} mm", label, shortest(project.tool.scallop_mm));
    }
    if (strategy == project::StrategyInput::fewest_points) {
        return fmt::format("{}, {} mm", label, shortest(project.toolpath.tolerance_mm));
    }
    return std::string(label);
}

namespace {

/// "5.441 / 0.212 mm at most / on average, axis 48.5 deg, rounds up to 36.65 mm apart".
std::string figures_text(const Evaluation& path, bool turns) {
    return fmt::format("max. {} mm, mean {} mm{}, rounds up to {} mm apart",
                       fixed(path.closest.max, 3),
                       fixed(path.closest.mean, 3),
                       turns ? fmt::format(", axis {} deg", fixed(to_degrees(path.closest.axis_max), 1)) : "",
                       fixed(path.track_gap.value_or(0.0), 2));
}

std::string
kept_note(const project::Project& project, const Evaluation& over, const Evaluation& even, bool turns) {
    return fmt::format("The spiral crosses the tracks that the grid \"{}\" was made for and would be worse "
                       "over it ({}) than over the uniform grid ({}), so the uniform grid is kept.",
                       row_of(project.grid.method).label,
                       figures_text(over, turns),
                       figures_text(even, turns));
}

std::string not_made_note(const project::Project& project, const Diagnostic& reason) {
    return fmt::format("The spiral cannot be generated over the grid \"{}\" ({}); the uniform grid is kept.",
                       row_of(project.grid.method).label,
                       reason.message);
}

/// Whether a spiral's path is better than that over the uniform grid, and does not leave more between its
/// rounds.
bool serves_better(const Evaluation& over, const Evaluation& even, const kinematics::MachineModel& machine) {
    constexpr double much = 1.1; // what the cutter leaves between two rounds grows with the square
    const bool apart = over.track_gap.value_or(0.0) > much * even.track_gap.value_or(0.0);
    return !apart && !is_worse(over, even, machine);
}

} // namespace

Evaluation path_evaluation(const project::Project& project,
                           const CuttingSetup& cutting_setup,
                           const Evaluation& base,
                           const Evaluation& uniform,
                           toolpath::MoveSampling sampling,
                           const Progress& progress) {
    expects(has_own_path(project), "a zigzag over a grid is evaluated with its grid");
    const toolpath::StrategySettings settings = strategy_settings(project);
    if (!follows_nodes(project.toolpath.strategy) || keeps_grid(base, uniform)) {
        return evaluate(cutting_setup, base.outcome, settings, sampling, progress);
    }
    std::optional<Evaluation> over, even;
    const auto over_failed = failure_of(
        [&] { over = evaluate(cutting_setup, base.outcome, settings, sampling, progress.part(0.0, 0.5)); });
    const auto even_failed = failure_of([&] {
        even = evaluate(cutting_setup, uniform.outcome, settings, sampling, progress.part(0.5, 1.0));
    });
    if (over_failed && even_failed) {
        throw Error(*over_failed);
    }
    if (even_failed || (over && serves_better(*over, *even, cutting_setup.machine))) {
        return *std::move(over);
    }
    even->outcome.status = grid::OptimiserStatus::no_gain;
    even->outcome.note = over ? kept_note(project, *over, *even, !cutting_setup.machine.rotary_axes().empty())
                              : not_made_note(project, *over_failed);
    return *std::move(even);
}

} // namespace millwright::plan
