#include "core/project/internal/plan_stages.h"

#include "core/base/error.h"
#include "core/project/assets.h"
#include "core/project/cut_study.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace millwright::project {

namespace {

namespace fs = std::filesystem;

/// Made whether they were chosen or not.
constexpr std::array compared_methods{GridMethod::elliptic, GridMethod::tracks};

/// Whether both tools make the same path; by what the cut is judged may differ.
bool same_cut(ToolInput a, const ToolInput& b) {
    a.scallop_mm = b.scallop_mm;
    a.gouge_limit_mm = b.gouge_limit_mm;
    return a == b;
}

bool same_place(const Project& a, const Project& b) {
    return a.surface == b.surface && a.machine == b.machine && same_cut(a.tool, b.tool) &&
           a.grid.direction == b.grid.direction && sequencing_settings(a) == sequencing_settings(b);
}

bool same_nodes(const GridInput& a, const GridInput& b) {
    return a.nu == b.nu && a.nv == b.nv;
}

bool same_settings(GridMethod method, const GridInput& a, const GridInput& b) {
    switch (method) {
    case GridMethod::uniform:
        return true;
    case GridMethod::elliptic:
        return a.elliptic == b.elliptic;
    case GridMethod::tracks:
        return a.tracks == b.tracks;
    case GridMethod::chain:
        return a.tracks == b.tracks && a.chain == b.chain;
    }
    return false;
}

fs::file_time_type machine_written(const Project& project, const Folders& folders) {
    std::error_code failure;
    return fs::last_write_time(machine_path(project, folders.project, folders.assets), failure);
}

/// Fewer samples where there are many moves, so that a drag stays a drag.
int coarse_samples(const GridInput& input) {
    constexpr int moves_with_all = 1600;
    return std::clamp(live_samples * moves_with_all / (input.nu * input.nv), 1, live_samples);
}

/// Larger grids take longer than a person who drags waits for.
bool quick_enough(const GridInput& input) {
    constexpr int most_nodes = 2500;
    return input.nu * input.nv <= most_nodes;
}

} // namespace

void PlanStages::hold(GridMethod method, Held found) {
    now_.plan.evaluation(method) = found.evaluation;
    now_.plan.estimated_time(method).reset();
    if (method == input().method) { // a program of another grid must not be taken for this one's
        now_.program_of = nullptr;
        now_.plan.program = nullptr;
        now_.plan.listing = nullptr;
        now_.plan.trajectory = nullptr;
        now_.plan.cut = nullptr;
    }
    now_.held[static_cast<std::size_t>(method)] = std::move(found);
}

/// Throws what is wrong with the project; the surface is there then if it can be.
void PlanStages::begin(const Project& project, const Folders& folders) {
    const State last = std::exchange(now_, {});
    for (std::size_t n = 0; n < last.held.size(); ++n) {
        if (last.held[n].evaluation) {
            before_[n] = last.held[n];
        }
    }
    const bool same_surface =
        last.source && last.plan.surface && last.source->project.surface.patches == project.surface.patches;
    now_.plan.surface = same_surface ? last.plan.surface
                                     : std::make_shared<const geometry::Surface>(surface_of(project.surface));
    if (const auto faults = faults_of(project); !faults.empty()) {
        throw Error(faults.front());
    }
    now_.source = Source{project, folders, machine_written(project, folders)};
    const bool same_workpiece = last.plan.workpiece && same_place(last.source->project, project) &&
                                last.source->folders == folders &&
                                last.source->machine_written == now_.source->machine_written;
    if (same_workpiece) {
        now_.plan.workpiece = last.plan.workpiece;
        keep_grids(last);
        keep_weight(last);
        keep_program(last);
    } else {
        now_.plan.workpiece = std::make_shared<const Workpiece>(workpiece_of(project, folders));
    }
}

void PlanStages::keep_grids(const State& last) {
    const GridInput& then = last.source->project.grid;
    for (const GridMethod method : every_grid_method) {
        const Held& old = last.held[static_cast<std::size_t>(method)];
        if (old.exact && same_nodes(then, input()) && same_settings(method, then, input())) {
            hold(method, old);
        }
    }
}

void PlanStages::keep_weight(const State& last) {
    const GridInput& then = last.source->project.grid;
    const EllipticInput& before = then.elliptic;
    const EllipticInput& now = input().elliptic;
    const bool same = before.weight == now.weight && before.expression == now.expression &&
                      before.mix == now.mix && before.painted == now.painted;
    if (same && same_nodes(then, input())) {
        now_.plan.weight = last.plan.weight;
    }
}

void PlanStages::keep_program(const State& last) {
    const Project& then = last.source->project;
    const bool same = then.program == project().program && then.name == project().name &&
                      then.grid.method == input().method;
    if (same && last.program_of && last.program_of == held(input().method).evaluation) {
        now_.program_of = last.program_of;
        now_.plan.program = last.plan.program;
        now_.plan.program_notes = last.plan.program_notes;
        now_.plan.listing = last.plan.listing;
        now_.plan.trajectory = last.plan.trajectory;
        now_.plan.estimated_time(input().method) = last.plan.estimated_time(input().method);
        now_.plan.cut = then.tool == project().tool ? last.plan.cut : nullptr;
    }
}

void PlanStages::derive(const Project& project,
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
    outcome.status = grid::ImproverStatus::running;
    outcome.note = "The grid from before the last change, until the new one is there.";
    Evaluation found = evaluate(workpiece(), std::move(outcome), coarse_samples(input()), progress);
    hold(method, {std::make_shared<const Evaluation>(std::move(found)), false});
}

void PlanStages::measure_uniform(int samples, const Progress& progress) {
    const Held& there = held(GridMethod::uniform);
    const bool exact = samples >= report_samples;
    if (there.exact || (there.evaluation && !exact)) {
        return;
    }
    progress.report(0.0, title_of_making(GridMethod::uniform));
    Evaluation found = evaluate(workpiece(), uniform_outcome(input()), samples, progress);
    hold(GridMethod::uniform, {std::make_shared<const Evaluation>(std::move(found)), exact});
}

void PlanStages::improve(GridMethod method, Effort effort, const Progress& progress) {
    if (held(method).exact) {
        return;
    }
    progress.report(0.0, title_of_making(method));
    Evaluation found =
        improved_evaluation(method, input(), workpiece(), *now_.plan.uniform, effort, progress);
    hold(method, {std::make_shared<const Evaluation>(std::move(found)), effort == Effort::full});
}

void PlanStages::add_weight(const Progress& progress) {
    if (!now_.plan.weight) {
        now_.plan.weight = std::make_shared<const WeightMap>(weight_map(input(), workpiece(), progress));
    }
}

void PlanStages::add_program_of_chosen(const Progress& progress) {
    const auto& chosen = held(input().method).evaluation;
    if (chosen && now_.program_of != chosen) {
        add_program(now_.plan, project(), progress);
        now_.program_of = chosen;
    }
}

void PlanStages::coarse(const Publish& publish, const Progress& progress) {
    const GridMethod chosen = input().method;
    if (chosen != GridMethod::uniform) {
        carry_over(chosen, progress.part(0.0, 0.1));
    }
    if (!now_.plan.evaluation(chosen)) {
        measure_uniform(coarse_samples(input()), progress.part(0.1, 0.2));
    }
    publish(now_.plan, std::nullopt, false);
    measure_uniform(coarse_samples(input()), progress.part(0.2, 0.3));
    now_.plan.singular_points = toolpath::singular_points(workpiece().patch, workpiece().machine);
    if (quick_enough(input())) {
        add_weight(progress.part(0.3, 0.3));
    }
    for (const GridMethod method : compared_methods) {
        carry_over(method, progress.part(0.3, 0.4));
    }
    publish(now_.plan, std::nullopt, false);
    if (chosen == GridMethod::tracks && quick_enough(input())) {
        improve(chosen, Effort::live, progress.part(0.4, 0.9));
    }
    if (quick_enough(input())) {
        add_program_of_chosen(progress.part(0.9, 1.0));
    }
    publish(now_.plan, std::nullopt, false);
}

void PlanStages::exact(const Publish& publish, const Progress& progress) {
    const GridMethod chosen = input().method;
    measure_uniform(report_samples, progress.part(0.0, 0.08));
    add_weight(progress.part(0.08, 0.1));
    if (chosen != GridMethod::uniform) {
        improve(chosen, Effort::full, progress.part(0.1, 0.5));
    }
    add_program_of_chosen(progress.part(0.5, 0.55));
    publish(now_.plan, std::nullopt, false);
    if (now_.plan.program && !now_.plan.cut) {
        add_cut_study(now_.plan, project(), progress.part(0.55, 0.6));
        publish(now_.plan, std::nullopt, false);
    }
    for (const GridMethod method : compared_methods) {
        improve(method, Effort::full, progress.part(method == GridMethod::elliptic ? 0.6 : 0.8, 1.0));
    }
    add_estimated_times(now_.plan, project(), progress);
    publish(now_.plan, std::nullopt, true);
}

} // namespace millwright::project
