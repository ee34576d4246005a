#include "core/plan/internal/plan_stages.h"

#include "core/base/error.h"
#include "core/plan/cut_study.h"
#include "core/plan/internal/failure.h"
#include "core/plan/left_out.h"
#include "core/plan/strategy_path.h"
#include "core/project/assets.h"
#include "core/project/surface.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace millwright::plan {

namespace {

namespace fs = std::filesystem;
using project::GridMethod;

/// Whether both tools make the same path; by what the cut is judged may differ, and what the program calls
/// them.
bool same_cut(project::ToolInput a, const project::ToolInput& b) {
    a.scallop_mm = b.scallop_mm;
    a.gouge_limit_mm = b.gouge_limit_mm;
    a.number = b.number;
    return a == b;
}

bool same_place(const project::Project& a, const project::Project& b) {
    return a.surface == b.surface && a.machine == b.machine && same_cut(a.tool, b.tool) &&
           a.grid.direction == b.grid.direction && sequencing_settings(a) == sequencing_settings(b) &&
           timing(a) == timing(b);
}

bool same_nodes(const project::GridInput& a, const project::GridInput& b) {
    return a.nu == b.nu && a.nv == b.nv;
}

/// For the harmonic map, which has no LV, no LO and its own solver.
bool same_metric(project::EllipticInput a, const project::EllipticInput& b) {
    a.solver = b.solver;
    a.adaptation = b.adaptation;
    a.orthogonality = b.orthogonality;
    return a == b;
}

bool same_settings(GridMethod method, const project::GridInput& a, const project::GridInput& b) {
    switch (method) {
    case GridMethod::uniform:
        return true;
    case GridMethod::redistribution:
        return a.redistribution == b.redistribution;
    case GridMethod::elliptic:
        return a.elliptic == b.elliptic;
    case GridMethod::harmonic:
        return same_metric(a.elliptic, b.elliptic);
    case GridMethod::tracks:
        return a.tracks == b.tracks;
    case GridMethod::chain:
        return a.tracks == b.tracks && a.chain == b.chain;
    }
    return false;
}

fs::file_time_type machine_written(const project::Project& project, const Folders& folders) {
    std::error_code failure;
    return fs::last_write_time(project::machine_path(project, folders.project, folders.assets), failure);
}

/// Fewer samples where there are many moves, so that a drag stays a drag.
toolpath::MoveSampling coarse_sampling(const project::GridInput& input) {
    constexpr int moves_with_all = 1600, most = live_sampling.times;
    return {std::clamp(most * moves_with_all / (input.nu * input.nv), 1, most)};
}

/// What the exact stage replaces bears the status of a running work, by which people are told.
std::shared_ptr<const Evaluation> shared(Evaluation found, bool exact) {
    if (!exact) {
        found.outcome.status = grid::ImproverStatus::running;
    }
    return std::make_shared<const Evaluation>(std::move(found));
}

/// Larger grids take longer than a person who drags waits for.
bool quick_enough(const project::GridInput& input) {
    constexpr int most_nodes = 2500;
    return input.nu * input.nv <= most_nodes;
}

} // namespace

void PlanStages::hold(GridMethod method, Held found) {
    now_.plan.grid(method).evaluation = found.evaluation;
    now_.plan.grid(method).estimated_time.reset();
    now_.plan.grid(method).cut = nullptr;
    if (method == program_grid(project())) {
        drop_program();
    }
    now_.held[static_cast<std::size_t>(method)] = std::move(found);
}

void PlanStages::hold(HeldPath found) {
    now_.plan.path = found.evaluation;
    now_.plan.path_time.reset();
    drop_program();
    now_.path = std::move(found);
}

/// One of another path must not be taken for this one's.
void PlanStages::drop_program() {
    now_.program_of = nullptr;
    now_.plan.program = nullptr;
    now_.plan.listing = nullptr;
    now_.plan.trajectory = nullptr;
    now_.plan.cut = nullptr;
}

/// Throws what is wrong with the project; the surface is there then if it can be.
void PlanStages::begin(const project::Project& project, const Folders& folders) {
    const State last = std::exchange(now_, {});
    for (std::size_t n = 0; n < last.held.size(); ++n) {
        if (last.held[n].evaluation) {
            before_[n] = last.held[n];
        }
    }
    const bool same_surface =
        last.source && last.plan.surface && last.source->project.surface.patches == project.surface.patches;
    now_.plan.surface = same_surface
                            ? last.plan.surface
                            : std::make_shared<const geometry::Surface>(project::surface_of(project.surface));
    const bool same_trims =
        last.source && last.plan.trims && last.source->project.surface.trims == project.surface.trims;
    now_.plan.trims = same_trims ? last.plan.trims
                                 : std::make_shared<const std::vector<geometry::Trim>>(project.surface.trims);
    if (const auto faults = project::faults_of(project); !faults.empty()) {
        throw Error(faults.front());
    }
    now_.source = Source{project, folders, machine_written(project, folders)};
    const bool same_workpiece = last.plan.workpiece && same_place(last.source->project, project) &&
                                last.source->folders == folders &&
                                last.source->machine_written == now_.source->machine_written;
    if (same_workpiece) {
        now_.plan.workpiece = last.plan.workpiece;
        keep_grids(last);
        keep_path(last);
        keep_weight(last);
        keep_program(last);
    } else {
        now_.plan.workpiece = std::make_shared<const Workpiece>(workpiece_of(project, folders));
    }
}

void PlanStages::keep_grids(const State& last) {
    const project::GridInput& then = last.source->project.grid;
    for (const GridMethod method : project::every_grid_method) {
        const Held& old = last.held[static_cast<std::size_t>(method)];
        if (old.exact && same_nodes(then, input()) && same_settings(method, then, input())) {
            hold(method, old);
            if (last.source->project.tool == project().tool &&
                last.source->project.program == project().program) {
                now_.plan.grid(method).cut = last.plan.grid(method).cut;
            }
        }
    }
}

void PlanStages::keep_path(const State& last) {
    const project::Project& then = last.source->project;
    const bool same = has_own_path(project()) && strategy_settings(then) == strategy_settings(project());
    const bool same_over = follows_nodes(project().toolpath.strategy)
                               ? last.path.over == held(program_grid(project())).evaluation
                               : same_nodes(then.grid, input());
    if (same && same_over && last.path.exact) {
        hold(last.path);
    }
}

void PlanStages::keep_weight(const State& last) {
    const project::GridInput& then = last.source->project.grid;
    const project::EllipticInput& before = then.elliptic;
    const project::EllipticInput& now = input().elliptic;
    const bool same = before.weight == now.weight && before.expression == now.expression &&
                      before.mix == now.mix && before.painted == now.painted && before.region == now.region;
    if (same && same_nodes(then, input())) {
        now_.plan.weight = last.plan.weight;
    }
}

void PlanStages::keep_program(const State& last) {
    const project::Project& then = last.source->project;
    const bool same = then.program == project().program && then.name == project().name &&
                      then.tool.number == project().tool.number && then.toolpath == project().toolpath &&
                      program_grid(then) == program_grid(project());
    if (same && last.program_of && last.program_of == now_.plan.program_path(project())) {
        now_.program_of = last.program_of;
        now_.plan.program = last.plan.program;
        now_.plan.program_notes = last.plan.program_notes;
        now_.plan.listing = last.plan.listing;
        now_.plan.trajectory = last.plan.trajectory;
        now_.plan.program_time(project()) = last.plan.trajectory->duration();
        now_.plan.cut = then.tool == project().tool ? last.plan.cut : nullptr;
    }
}

void PlanStages::derive(const project::Project& project,
                        const Folders& folders,
                        const Publish& publish,
                        const Progress& progress) {
    try {
        begin(project, folders);
        coarse(publish, progress.part(0.0, 0.2));
        exact(publish, progress.part(0.2, 1.0));
    } catch (const Error& error) {
        publish(now_.plan, error.diagnostic(), false);
    }
}

/// The grid of the surface before, on the surface now: it follows a drag at once and is made anew afterwards.
void PlanStages::carry_over(GridMethod method, const Progress& progress) {
    const auto& old = before_[static_cast<std::size_t>(method)].evaluation;
    const bool fits = old && old->outcome.grid.nu() == input().nu && old->outcome.grid.nv() == input().nv &&
                      old->toolpath.direction == input().direction;
    if (!fits || held(method).evaluation) {
        return;
    }
    GridOutcome outcome = old->outcome;
    outcome.warning.clear();
    outcome.note = "The grid from before the last change, until the new one is there.";
    Evaluation found = evaluate(workpiece(), std::move(outcome), coarse_sampling(input()), progress);
    hold(method, {shared(std::move(found), false), false});
}

void PlanStages::measure_uniform(toolpath::MoveSampling sampling, const Progress& progress) {
    const Held& there = held(GridMethod::uniform);
    const bool exact = sampling == report_sampling;
    if (there.exact || (there.evaluation && !exact)) {
        return;
    }
    progress.report(0.0, title_of_making(GridMethod::uniform));
    Evaluation found = evaluate(workpiece(), uniform_outcome(input()), sampling, progress);
    hold(GridMethod::uniform, {shared(std::move(found), exact), exact});
}

void PlanStages::improve(GridMethod method, Effort effort, const Progress& progress) {
    if (held(method).exact) {
        return;
    }
    progress.report(0.0, title_of_making(method));
    Evaluation found = improved_evaluation(
        {method, input(), workpiece(), effort}, *now_.plan.grid(GridMethod::uniform).evaluation, progress);
    const bool exact = effort == Effort::full;
    hold(method, {shared(std::move(found), exact), exact});
}

void PlanStages::add_weight(const Progress& progress) {
    if (!now_.plan.weight) {
        now_.plan.weight = std::make_shared<const WeightMap>(weight_map(input(), workpiece(), progress));
    }
}

/// A strategy that makes its own points waits for the exact stage: it takes longer than a person who drags.
void PlanStages::add_path(toolpath::MoveSampling sampling, const Progress& progress) {
    if (!has_own_path(project())) {
        return;
    }
    const bool exact = sampling == report_sampling;
    const bool on_nodes = follows_nodes(project().toolpath.strategy);
    const auto& over = held(program_grid(project())).evaluation;
    const bool current = now_.path.evaluation && (!on_nodes || now_.path.over == over);
    if (!over || (!exact && !on_nodes) || (current && (now_.path.exact || !exact))) {
        return;
    }
    progress.report(0.0, title_of_path);
    Evaluation found = path_evaluation(
        project(), workpiece(), *over, *now_.plan.grid(GridMethod::uniform).evaluation, sampling, progress);
    hold({shared(std::move(found), exact), over, exact});
}

void PlanStages::add_program_of_chosen(const Progress& progress) {
    const auto& chosen = now_.plan.program_path(project());
    if (chosen && now_.program_of != chosen) {
        add_program(now_.plan, project(), progress);
        now_.program_of = chosen;
    }
}

void PlanStages::coarse(const Publish& publish, const Progress& progress) {
    const GridMethod chosen = program_grid(project());
    if (chosen != GridMethod::uniform) {
        carry_over(chosen, progress.part(0.0, 0.1));
    }
    if (!now_.plan.grid(chosen).evaluation) {
        measure_uniform(coarse_sampling(input()), progress.part(0.1, 0.2));
    }
    publish(now_.plan, std::nullopt, false);
    measure_uniform(coarse_sampling(input()), progress.part(0.2, 0.3));
    now_.plan.singular_points = toolpath::singular_points(workpiece().patch, workpiece().machine);
    for (const GridMethod method : project::compared_methods) {
        if (!is_left_out(project(), method)) {
            carry_over(method, progress.part(0.3, 0.4));
        }
    }
    publish(now_.plan, std::nullopt, false);
    if (chosen == GridMethod::tracks && quick_enough(input())) {
        improve(chosen, Effort::live, progress.part(0.4, 0.9));
    }
    if (quick_enough(input())) {
        add_path(coarse_sampling(input()), progress.part(0.85, 0.9));
        add_program_of_chosen(progress.part(0.9, 1.0));
        try {
            add_weight(progress.part(1.0, 1.0));
        } catch (
            const Error&) { // the exact stage, which makes the program first, comes to it again and tells
        }
    }
    publish(now_.plan, std::nullopt, false);
}

/// The grids that stand beside the program's: what is wrong with one of them is its own, and told with it.
void PlanStages::compare(const Progress& progress) {
    static_assert(std::ranges::count(project::compared_methods, GridMethod::elliptic) == 1);
    const double share = 1.0 / static_cast<double>(project::compared_methods.size());
    double from = 0.0;
    for (const GridMethod method : project::compared_methods) {
        const Progress part = progress.part(from, from + share);
        from += share;
        now_.plan.grid(method).failure = failure_of([&] {
            if (method == GridMethod::elliptic) {
                add_weight(part.part(0.0, 0.0));
            }
            if (!is_left_out(project(), method)) {
                improve(method, Effort::full, part);
            }
        });
        const bool none = now_.plan.grid(method).failure || is_left_out(project(), method);
        if (none && !held(method).exact) {
            hold(method, {}); // one that was carried over must not be taken for this project's
        }
    }
}

void PlanStages::exact(const Publish& publish, const Progress& progress) {
    const GridMethod chosen = program_grid(project());
    measure_uniform(report_sampling, progress.part(0.0, 0.1));
    const double made = chosen == GridMethod::chain ? 0.75 : 0.45; // of the whole
    const auto rest = [&](double from, double to) {
        return progress.part(made + (1.0 - made) * from, made + (1.0 - made) * to);
    };
    if (chosen != GridMethod::uniform) {
        improve(chosen, Effort::full, progress.part(0.1, made));
    }
    add_path(report_sampling, rest(0.0, 0.1));
    add_program_of_chosen(rest(0.1, 0.2));
    publish(now_.plan, std::nullopt, false);
    if (now_.plan.program && !now_.plan.cut) {
        add_cut_study(now_.plan, project(), rest(0.2, 0.3));
        publish(now_.plan, std::nullopt, false);
    }
    compare(rest(0.3, 0.9));
    add_estimated_times(now_.plan, project(), rest(0.9, 0.91));
    add_unsequenced(now_.plan, project(), rest(0.91, 0.92));
    add_compared_cuts(now_.plan, project(), rest(0.92, 0.99));
    const auto fault = std::ranges::find_if(
        now_.plan.grids, [](const GridResult& result) { return result.failure.has_value(); });
    const bool all_there = fault == now_.plan.grids.end();
    publish(now_.plan, all_there ? std::nullopt : fault->failure, all_there);
}

} // namespace millwright::plan
