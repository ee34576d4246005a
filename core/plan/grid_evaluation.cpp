// A grid made by a method and measured on the finished part, never worse than the uniform one.
#include "core/plan/grids.h"
#include "core/plan/internal/worse_metrics.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace millwright::plan {

namespace {

Evaluation evaluated_grid(const GridMaking& by, const Progress& progress) {
    const toolpath::KinematicError error = by.cutting_setup.error_model();
    const auto optimiser = make_optimiser(by.method, by.input, error, by.effort);
    constexpr double measuring = 0.9; // share of the improvement
    GridOutcome outcome = improved_outcome(*optimiser, progress.part(0.0, measuring));
    return evaluate(
        by.cutting_setup, std::move(outcome), sampling_of(by.effort), progress.part(measuring, 1.0));
}

std::string refusal(const Evaluation& found, const Evaluation& uniform, bool turns) {
    const std::string larger = worse_metrics(found.closest, uniform.closest, turns);
    return larger.empty() ? std::string("No grid better than the uniform grid was found, so it is kept.")
                          : fmt::format("The uniform grid is kept: over the whole path the new grid would "
                                        "have larger errors ({}).",
                                        larger);
}

} // namespace

Evaluation evaluation_by(const GridMaking& by, const Evaluation& uniform, const Progress& progress) {
    Evaluation found = evaluated_grid(by, progress);
    if (!is_worse(found, uniform, by.cutting_setup.machine)) {
        return found;
    }
    Evaluation kept = uniform;
    kept.outcome = {uniform.outcome.grid,
                    grid::OptimiserStatus::no_gain,
                    found.outcome.rounds,
                    found.outcome.iterations,
                    found.outcome.norm,
                    found.outcome.start_by_curve,
                    found.outcome.start_by_curve,
                    refusal(found, uniform, !by.cutting_setup.machine.rotary_axes().empty()),
                    found.outcome.warning,
                    found.outcome.stages,
                    found.outcome.norms};
    return kept;
}

bool keeps_grid(const Evaluation& found, const Evaluation& start) {
    return found.outcome.grid == start.outcome.grid;
}

bool is_worse(const Evaluation& found, const Evaluation& start, const kinematics::MachineModel& machine) {
    constexpr double rounding = 1e-9; // of figures that are sums over many moves
    const bool turns = !machine.rotary_axes().empty();
    return !(found.closest.mean <= start.closest.mean * (1.0 + rounding)) ||
           !(found.closest.max <= start.closest.max * (1.0 + rounding)) ||
           (turns && !(found.closest.axis_max <= start.closest.axis_max * (1.0 + rounding)));
}

} // namespace millwright::plan
