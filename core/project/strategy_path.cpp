#include "core/project/strategy_path.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/project/settings.h"

#include <fmt/format.h>

namespace millwright::project {

bool follows_nodes(StrategyInput strategy) {
    return strategy == StrategyInput::zigzag || strategy == StrategyInput::spiral;
}

GridMethod program_grid(const Project& project) {
    return follows_nodes(project.toolpath.strategy) ? project.grid.method : GridMethod::uniform;
}

bool has_own_path(const Project& project) {
    const StrategyInput strategy = project.toolpath.strategy;
    return strategy != StrategyInput::zigzag && strategy != StrategyInput::iso_parametric;
}

toolpath::StrategySettings strategy_settings(const Project& project) {
    using toolpath::StrategyKind;
    toolpath::StrategySettings settings;
    switch (project.toolpath.strategy) {
    case StrategyInput::zigzag:
    case StrategyInput::iso_parametric:
        break;
    case StrategyInput::spiral:
        settings.kind = StrategyKind::spiral;
        break;
    case StrategyInput::constant_scallop:
        settings.kind = StrategyKind::constant_scallop;
        settings.scallop = project.tool.scallop_mm;
        break;
    case StrategyInput::fewest_points:
        settings.kind = StrategyKind::fewest_points;
        settings.tolerance = project.toolpath.tolerance_mm;
        break;
    }
    return settings;
}

std::string strategy_text(const Project& project) {
    const StrategyInput strategy = project.toolpath.strategy;
    const std::string_view label = row_of(strategies(), strategy).label;
    if (strategy == StrategyInput::constant_scallop) {
        return fmt::format("{}, {} mm", label, shortest(project.tool.scallop_mm));
    }
    if (strategy == StrategyInput::fewest_points) {
        return fmt::format("{}, {} mm", label, shortest(project.toolpath.tolerance_mm));
    }
    return std::string(label);
}

Evaluation path_evaluation(const Project& project,
                           const Workpiece& workpiece,
                           const Evaluation& base,
                           toolpath::MoveSampling sampling,
                           const Progress& progress) {
    expects(has_own_path(project), "a zigzag over a grid is evaluated with its grid");
    return evaluate(workpiece, base.outcome, strategy_settings(project), sampling, progress);
}

} // namespace millwright::project
