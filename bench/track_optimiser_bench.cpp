// Time of one optimisation of n x n nodes of the dome on the thesis's machine: as kept, and as while editing.
#include "core/base/parallel.h"
#include "core/geometry/presets.h"
#include "core/grid/track_optimiser.h"
#include "core/kinematics/machine_file.h"
#include "core/project/assets.h"
#include "core/toolpath/kinematic_error.h"

#include <benchmark/benchmark.h>

namespace millwright {
namespace {

toolpath::KinematicError dome() {
    return {geometry::surface_preset("dome").make().patch(geometry::PatchId{0}),
            kinematics::read_machine(project::assets_folder() / "machines/rotary-tilt-listing.json"),
            false};
}

void optimise(benchmark::State& state, const grid::TrackSettings& settings) {
    const toolpath::KinematicError error = dome();
    const int n = static_cast<int>(state.range(0));
    for (auto _ : state) {
        grid::TrackOptimiser optimiser(
            error, grid::Grid::uniform(n, n), grid::TrackDirection::along_v, settings);
        benchmark::DoNotOptimize(run(optimiser, {}).of_best.mean);
    }
}

void optimise_to_keep(benchmark::State& state) {
    optimise(state, {});
}
BENCHMARK(optimise_to_keep)->Arg(10)->Arg(20)->Arg(40)->Unit(benchmark::kMillisecond)->UseRealTime();

void optimise_while_editing(benchmark::State& state) {
    optimise(state, grid::quick_track_settings());
}
BENCHMARK(optimise_while_editing)->Arg(10)->Arg(20)->Arg(40)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The cost of one move among the lattice's: the unit in which the optimiser's time is counted.
void one_move_of_a_lattice(benchmark::State& state) {
    const toolpath::KinematicError error = dome();
    std::vector<Vec2> nodes;
    for (int k = 0; k <= 160; ++k) {
        nodes.emplace_back(0.3, k / 160.0);
    }
    const auto lattice = error.lattice(nodes, grid::coarse);
    int k = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(lattice->between(k, k + 20));
        k = (k + 1) % 140;
    }
}
BENCHMARK(one_move_of_a_lattice);

void one_move(benchmark::State& state) {
    const toolpath::KinematicError error = dome();
    for (auto _ : state) {
        benchmark::DoNotOptimize(error.move({0.3, 0.4}, {0.3, 0.5}, {16, 16}));
    }
}
BENCHMARK(one_move);

} // namespace
} // namespace millwright
