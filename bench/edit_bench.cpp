// What a person waits for while dragging a control point of a 20 x 20 project: surface, path and error at
// once, the optimised grid soon after.
#include "core/plan/pipeline.h"
#include "core/project/assets.h"
#include "core/project/project_file.h"

#include <benchmark/benchmark.h>

#include <atomic>

namespace millwright::project {
namespace {

plan::Folders folders() {
    return {assets_folder() / "projects", assets_folder()};
}

Project sample(int index) {
    constexpr std::array names{"dome", "two-bell", "sine"};
    return read_project(folders().project /
                        (std::string(names.at(static_cast<std::size_t>(index))) + ".json"));
}

/// Moves a control point a little further each time.
void edit(Project& project) {
    project.surface.patches[0].point(1, 1).z() += 0.01;
}

void surface_path_and_error(benchmark::State& state) {
    Project project = sample(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        edit(project);
        const plan::CuttingSetup cutting_setup = plan::cutting_setup_of(project, folders());
        benchmark::DoNotOptimize(plan::evaluate(
            cutting_setup, plan::uniform_outcome(project.grid), plan::live_sampling, Progress()));
    }
}

void optimised_grid(benchmark::State& state, plan::Effort effort) {
    Project project = sample(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        edit(project);
        const plan::CuttingSetup cutting_setup = plan::cutting_setup_of(project, folders());
        const plan::Evaluation uniform = plan::evaluate(
            cutting_setup, plan::uniform_outcome(project.grid), plan::sampling_of(effort), Progress());
        benchmark::DoNotOptimize(plan::improved_evaluation(
            {GridMethod::tracks, project.grid, cutting_setup, effort}, uniform, Progress()));
    }
}

/// From the request to a publication that `fits`, through the pipeline's thread.
template <class Fits> void through_the_pipeline(benchmark::State& state, Fits fits) {
    std::atomic<int> woken{0};
    plan::Pipeline pipeline(folders(), [&] {
        ++woken;
        woken.notify_all();
    });
    Project project = sample(static_cast<int>(state.range(0)));
    pipeline.request(project);
    pipeline.wait_idle();
    for (auto _ : state) {
        edit(project);
        pipeline.request(project);
        while (true) {
            const int before = woken;
            const auto plan = pipeline.latest();
            if (plan->project == project && fits(*plan)) {
                break;
            }
            woken.wait(before);
        }
    }
}

void first_publication(benchmark::State& state) {
    through_the_pipeline(state, [](const plan::PublishedPlan&) { return true; });
}

void quick_program(benchmark::State& state) {
    through_the_pipeline(state, [](const plan::PublishedPlan& plan) { return plan.plan.program != nullptr; });
}

void exact_plan(benchmark::State& state) {
    through_the_pipeline(state, [](const plan::PublishedPlan& plan) { return plan.exact; });
}

BENCHMARK(surface_path_and_error)->DenseRange(0, 2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(optimised_grid, live, plan::Effort::live)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(optimised_grid, full, plan::Effort::full)
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(first_publication)->DenseRange(0, 2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(quick_program)->DenseRange(0, 2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(exact_plan)->DenseRange(0, 2)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
} // namespace millwright::project
