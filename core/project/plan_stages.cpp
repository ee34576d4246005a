#include "core/project/internal/plan_stages.h"

#include "core/base/error.h"
#include "core/project/assets.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace millwright::project {

namespace {

namespace fs = std::filesystem;

constexpr std::array improved_methods{GridMethod::elliptic, GridMethod::tracks};

bool same_place(const Project& a, const Project& b) {
    return a.surface == b.surface && a.machine == b.machine && a.grid.direction == b.grid.direction;
}

bool same_nodes(const GridInput& a, const GridInput& b) {
    return a.nu == b.nu && a.nv == b.nv;
}

bool same_settings(GridMethod method, const GridInput& a, const GridInput& b) {
    return method == GridMethod::uniform ||
           (method == GridMethod::elliptic ? a.elliptic == b.elliptic : a.tracks == b.tracks);
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

void PlanStages::hold(GridMethod method, Evaluation evaluation, bool exact) {
    held(method) = {std::make_shared<const Evaluation>(std::move(evaluation)), exact};
    plan_.evaluation(method) = held(method).evaluation;
}

/// Throws what is wrong with the project, keeping what the new one has in common with the last.
void PlanStages::begin(const Project& project, const Folders& folders) {
    const Plan last = std::exchange(plan_, {});
    const auto last_held = std::exchange(held_, {});
    const std::optional<Source> source = std::exchange(source_, std::nullopt);
    for (std::size_t n = 0; n < last_held.size(); ++n) {
        if (last_held[n].evaluation) {
            before_[n] = last_held[n];
        }
    }
    plan_.surface = source && last.surface && source->project.surface.patches == project.surface.patches
                        ? last.surface
                        : std::make_shared<const geometry::Surface>(surface_of(project.surface));
    const auto faults = faults_of(project);
    if (!faults.empty()) {
        throw Error(faults.front());
    }
    source_ = Source{project, folders, machine_written(project, folders)};
    const bool same_workpiece = source && same_place(source->project, project) &&
                                source->folders == folders &&
                                source->machine_written == source_->machine_written && last.workpiece;
    plan_.workpiece =
        same_workpiece ? last.workpiece : std::make_shared<const Workpiece>(workpiece_of(project, folders));
    if (!same_workpiece || !same_nodes(source->project.grid, project.grid)) {
        return;
    }
    for (const GridMethod method : {GridMethod::uniform, GridMethod::elliptic, GridMethod::tracks}) {
        const Held& old = last_held[static_cast<std::size_t>(method)];
        if (old.exact && same_settings(method, source->project.grid, project.grid)) {
            held(method) = old;
            plan_.evaluation(method) = old.evaluation;
        }
    }
    const bool same_program =
        source->project.program == project.program && source->project.name == project.name;
    if (same_program && program_of_ && program_of_ == held(project.grid.method).evaluation) {
        plan_.program = last.program;
        plan_.program_notes = last.program_notes;
        plan_.listing = last.listing;
        plan_.trajectory = last.trajectory;
        plan_.estimated_time(project.grid.method) = last.estimated_time(project.grid.method);
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
        publish(plan_, error.diagnostic(), false);
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
    hold(method, evaluate(*plan_.workpiece, std::move(outcome), coarse_samples(input()), progress), false);
}

void PlanStages::measure_uniform(int samples, const Progress& progress) {
    if (exactly(GridMethod::uniform) || (held(GridMethod::uniform).evaluation && samples < report_samples)) {
        return;
    }
    progress.report(0.0, title_of_making(GridMethod::uniform));
    hold(GridMethod::uniform,
         evaluate(*plan_.workpiece, uniform_outcome(input()), samples, progress),
         samples >= report_samples);
}

void PlanStages::improve(GridMethod method, Effort effort, const Progress& progress) {
    if (exactly(method)) {
        return;
    }
    progress.report(0.0, title_of_making(method));
    hold(method,
         improved_evaluation(method, input(), *plan_.workpiece, *plan_.uniform, effort, progress),
         effort == Effort::full);
}

void PlanStages::add_program_of_chosen(const Progress& progress) {
    const auto& chosen = plan_.evaluation(input().method);
    if (!chosen || (plan_.program && program_of_ == chosen)) {
        return;
    }
    add_program(plan_, source_->project, progress);
    program_of_ = chosen;
}

void PlanStages::coarse(const Publish& publish, const Progress& progress) {
    const GridMethod chosen = input().method;
    if (chosen != GridMethod::uniform) {
        carry_over(chosen, progress.part(0.0, 0.1));
    }
    if (!plan_.evaluation(chosen)) {
        measure_uniform(coarse_samples(input()), progress.part(0.1, 0.2));
    }
    publish(plan_, std::nullopt, false);
    measure_uniform(coarse_samples(input()), progress.part(0.2, 0.3));
    plan_.singular_points = toolpath::singular_points(plan_.workpiece->patch, plan_.workpiece->machine);
    for (const GridMethod method : improved_methods) {
        carry_over(method, progress.part(0.3, 0.4));
    }
    publish(plan_, std::nullopt, false);
    if (chosen == GridMethod::tracks && quick_enough(input())) {
        improve(chosen, Effort::live, progress.part(0.4, 0.9));
    }
    if (quick_enough(input())) {
        add_program_of_chosen(progress.part(0.9, 1.0));
    }
    publish(plan_, std::nullopt, false);
}

void PlanStages::exact(const Publish& publish, const Progress& progress) {
    const GridMethod chosen = input().method;
    measure_uniform(report_samples, progress.part(0.0, 0.1));
    if (chosen != GridMethod::uniform) {
        improve(chosen, Effort::full, progress.part(0.1, 0.5));
    }
    add_program_of_chosen(progress.part(0.5, 0.6));
    publish(plan_, std::nullopt, false);
    for (const GridMethod method : improved_methods) {
        improve(method, Effort::full, progress.part(method == GridMethod::elliptic ? 0.6 : 0.8, 1.0));
    }
    add_estimated_times(plan_, source_->project, progress);
    publish(plan_, std::nullopt, true);
}

} // namespace millwright::project
