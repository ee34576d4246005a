#include "core/plan/internal/grid_stages.h"

#include "core/plan/skipped_comparisons.h"
#include "core/plan/strategy_path.h"
#include "core/project/grid_methods/grid_method_row.h"

#include <algorithm>
#include <utility>

namespace millwright::plan {

namespace {

using project::GridMethod;

/// The grid of the surface before, on the surface now: it follows a drag at
/// once and is made anew afterwards.
bool carry_over(GridMethod method, const StageWork& work) {
    const project::GridInput& input = work.project().grid;
    const auto& old = work.earlier[index_of(method)];
    const bool fits = old && old->outcome.grid.nu() == input.nu && old->outcome.grid.nv() == input.nv &&
                      old->toolpath.direction == input.direction;
    if (!fits) {
        return false;
    }
    GridOutcome outcome = old->outcome;
    outcome.warning.clear();
    outcome.note = "The grid from before the last change, shown until the new one is ready.";
    Evaluation found =
        evaluate(work.cutting_setup(), std::move(outcome), sampling_of(work.quality, input), work.progress);
    work.plan.grid(method).evaluation = shared(std::move(found), work.quality);
    return true;
}

bool measure_uniform(const StageWork& work) {
    const project::GridInput& input = work.project().grid;
    work.plan.grid(GridMethod::uniform).evaluation = shared(
        evaluate(
            work.cutting_setup(), uniform_outcome(input), sampling_of(work.quality, input), work.progress),
        work.quality);
    return true;
}

/// `live`: it is made anew for a person who drags, too.
bool improve(GridMethod method, bool live, const StageWork& work) {
    if (work.quality == Quality::carried || (work.quality == Quality::coarse && !live)) {
        return carry_over(method, work);
    }
    const Effort effort = work.quality == Quality::exact ? Effort::full : Effort::live;
    work.plan.grid(method).evaluation =
        shared(improved_evaluation({method, work.project().grid, work.cutting_setup(), effort},
                                   *work.plan.grid(GridMethod::uniform).evaluation,
                                   work.progress),
               work.quality);
    return true;
}

} // namespace

bool is_quick(const project::GridInput& input) {
    constexpr int most_nodes = 2500;
    return input.nu * input.nv <= most_nodes;
}

bool same_nodes(const project::GridInput& a, const project::GridInput& b) {
    return a.nu == b.nu && a.nv == b.nv;
}

toolpath::MoveSampling sampling_of(Quality quality, const project::GridInput& input) {
    constexpr int moves_with_all = 1600, most = live_sampling.times;
    return quality == Quality::exact
               ? report_sampling
               : toolpath::MoveSampling{std::clamp(most * moves_with_all / (input.nu * input.nv), 1, most)};
}

std::shared_ptr<const Evaluation> shared(Evaluation found, Quality quality) {
    if (quality != Quality::exact) {
        found.outcome.status = grid::OptimiserStatus::running;
    }
    return std::make_shared<const Evaluation>(std::move(found));
}

Stage grid_stage(GridMethod method, const project::Project& project, const Scope& scope) {
    const bool of_program = method == program_grid(project);
    const bool is_uniform = method == GridMethod::uniform;
    const bool compared = row_of(method).compared;
    Stage stage{.key = grid_key(method), .title = row_of(method).title, .share = row_of(method).share};
    stage.asked = of_program || is_uniform ||
                  (scope.compared.grids && compared && !is_comparison_skipped(project, method));
    stage.reads = {{StageKind::cutting_setup}};
    stage.same = [method](const Source& then, const Source& now) {
        return same_nodes(then.project.grid, now.project.grid) &&
               row_of(method).same_settings(then.project.grid, now.project.grid);
    };
    stage.make = [](const StageWork& work) { return measure_uniform(work); };
    stage.clear = [method](Plan& plan) { plan.grid(method).evaluation = nullptr; };
    stage.graded = true;
    stage.stays = true;
    if (is_uniform) {
        stage.qualities = {Quality::coarse, Quality::exact};
        stage.shown_early = Quality::coarse;
    } else {
        const bool live = of_program && row_of(method).follows_drag && is_quick(project.grid);
        stage.reads.push_back(grid_key(GridMethod::uniform));
        stage.make = [method, live](const StageWork& work) { return improve(method, live, work); };
        if (!of_program) { // after the uniform grid: the program's comes first
            stage.qualities = {Quality::coarse, Quality::exact};
        } else if (live) {
            stage.qualities = {Quality::carried, Quality::coarse, Quality::exact};
        } else {
            stage.qualities = {Quality::carried, Quality::exact};
        }
        stage.shown_early = of_program ? std::optional(Quality::carried) : std::nullopt;
        stage.fault_of = of_program ? std::nullopt : std::optional(method);
    }
    return stage;
}

} // namespace millwright::plan
