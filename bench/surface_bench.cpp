// What a surface costs in bulk: a point of a bicubic patch with its derivatives and normal, and the error map
// of a million moves, with what it reports on the way.
#include "core/geometry/presets.h"
#include "core/geometry/surface_point.h"
#include "core/kinematics/machine_file.h"
#include "core/project/assets.h"
#include "core/toolpath/error_field.h"
#include "core/toolpath/sequenced_path.h"
#include "core/toolpath/zigzag.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <random>
#include <vector>

namespace millwright {
namespace {

geometry::BezierPatch dome() {
    return geometry::surface_preset("dome").make().patch(geometry::PatchId{0});
}

std::vector<Vec2> many_places() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> parameter(0.0, 1.0);
    std::vector<Vec2> places(4096);
    std::ranges::generate(places, [&] { return Vec2(parameter(random), parameter(random)); });
    return places;
}

void tell_of_a_point(benchmark::State& state, std::size_t places) {
    state.counters["a_point"] =
        benchmark::Counter(static_cast<double>(places),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// First and second derivatives, and the normals of all of them afterwards.
void points_with_derivatives_and_normals(benchmark::State& state) {
    const geometry::BezierPatch patch = dome();
    const std::vector<Vec2> places = many_places();
    std::vector<geometry::SurfaceDerivatives> found(places.size());
    std::vector<std::optional<Vec3>> normals(places.size());
    for (auto _ : state) {
        std::ranges::transform(
            places, found.begin(), [&](const Vec2& at) { return patch.derivatives(at.x(), at.y()); });
        std::ranges::transform(found, normals.begin(), [&](const auto& at) { return patch.unit_normal(at); });
        benchmark::DoNotOptimize(found.data());
        benchmark::DoNotOptimize(normals.data());
        benchmark::ClobberMemory();
    }
    tell_of_a_point(state, places.size());
}
BENCHMARK(points_with_derivatives_and_normals);

/// What a search asks for: where the surface is and which way it faces.
void points_with_normals(benchmark::State& state) {
    const geometry::BezierPatch patch = dome();
    const std::vector<Vec2> places = many_places();
    for (auto _ : state) {
        for (const Vec2& at : places) {
            benchmark::DoNotOptimize(geometry::point_of(patch, at.x(), at.y()));
        }
    }
    tell_of_a_point(state, places.size());
}
BENCHMARK(points_with_normals);

/// Looked at once and eight times per move, as while a person drags, and until its error is known (0), as in
/// a report.
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
        const toolpath::MoveSampling sampling{static_cast<int>(state.range(0))};
        benchmark::DoNotOptimize(
            toolpath::error_field(patch, machine, made.toolpath, made.axes, sampling, progress).moves.size());
    }
    state.counters["moves"] = static_cast<double>(made.toolpath.points.size() - 1);
    state.counters["reports"] = reports.load();
}
BENCHMARK(error_map_of_a_million_moves)
    ->Arg(1)
    ->Arg(8)
    ->Arg(0)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

} // namespace
} // namespace millwright
