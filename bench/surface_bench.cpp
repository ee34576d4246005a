// What a surface costs in bulk: a point of a bicubic patch with its derivatives and normal, and the error map
// of a million moves, with what it reports on the way.
#include "core/geometry/presets.h"
#include "core/kinematics/machine_file.h"
#include "core/project/assets.h"
#include "core/toolpath/error_field.h"
#include "core/toolpath/sequenced_path.h"
#include "core/toolpath/zigzag.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <vector>

namespace millwright {
namespace {

geometry::BezierPatch dome() {
    return geometry::surface_preset("dome").make().patch(geometry::PatchId{0});
}

void point_with_derivatives_and_normal(benchmark::State& state) {
    const geometry::BezierPatch patch = dome();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> parameter(0.0, 1.0);
    std::vector<Vec2> places(4096);
    std::ranges::generate(places, [&] { return Vec2(parameter(random), parameter(random)); });
    for (auto _ : state) {
        for (const Vec2& at : places) {
            const geometry::SurfaceDerivatives all = patch.derivatives(at.x(), at.y());
            benchmark::DoNotOptimize(all);
            benchmark::DoNotOptimize(patch.unit_normal(all));
        }
    }
    state.counters["a_point"] =
        benchmark::Counter(static_cast<double>(places.size()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(point_with_derivatives_and_normal);

/// By so many samples a move: while a person drags there is one, in a report there are 40.
void error_map_of_a_million_moves(benchmark::State& state) {
    const geometry::BezierPatch patch = dome();
    const kinematics::MachineModel machine =
        kinematics::read_machine(project::assets_folder() / "machines/ac-table.json");
    const grid::Grid grid = grid::Grid::uniform(1000, 1000);
    const toolpath::SequencedPath made = toolpath::sequenced(
        patch, machine, toolpath::zigzag(patch, grid, grid::TrackDirection::along_u, false), {}, {});
    std::atomic<int> reports = 0;
    const Progress progress([&](const Progress::Report&) { ++reports; }, {});
    for (auto _ : state) {
        const auto samples = static_cast<int>(state.range(0));
        benchmark::DoNotOptimize(
            toolpath::error_field(patch, machine, made.toolpath, made.axes, samples, progress).moves.size());
    }
    state.counters["moves"] = static_cast<double>(made.toolpath.points.size() - 1);
    state.counters["reports"] = reports.load();
}
BENCHMARK(error_map_of_a_million_moves)
    ->Arg(1)
    ->Arg(8)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

} // namespace
} // namespace millwright
