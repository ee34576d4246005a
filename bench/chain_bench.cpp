// What the whole chain brings and costs, beside what a prototype of it brought: largest and mean error of a
// move inside the tracks against the surface curve, mm; largest axis deviation, deg. A ratio is ours over the
// prototype's, at most 1 where it is reached; CPU is the processor time of all threads.
#include "core/base/units.h"
#include "core/geometry/presets.h"
#include "core/grid/chain_optimiser.h"
#include "core/kinematics/machine_file.h"
#include "core/project/assets.h"
#include "core/studies/fewest_points_study.h"
#include "core/toolpath/kinematic_error.h"
#include "tests/support/inner_tracks.h"

#include <benchmark/benchmark.h>

#include <array>
#include <map>
#include <string>

namespace millwright {
namespace {

struct Figures {
    double max, mean;
};
using Prototype = std::map<std::int64_t, Figures>; // by the nodes of a track

kinematics::MachineModel machine(const std::string& id) {
    return kinematics::read_machine(project::assets_folder() / "machines" / (id + ".json"));
}

geometry::BezierPatch patch(const std::string& preset) {
    return geometry::surface_preset(preset).make().patch(geometry::PatchId{0});
}

void tell(benchmark::State& state, const grid::OptimiserState& found, const Figures& prototype) {
    state.counters["uniform_max"] = found.start.max;
    state.counters["uniform_mean"] = found.start.mean;
    state.counters["chain_max"] = found.of_best.max;
    state.counters["chain_mean"] = found.of_best.mean;
    state.counters["uniform_axis"] = to_degrees(found.start.axis_max);
    state.counters["chain_axis"] = to_degrees(found.of_best.axis_max);
    state.counters["prototype_max"] = prototype.max;
    state.counters["prototype_mean"] = prototype.mean;
    state.counters["ratio_max"] = found.of_best.max / prototype.max;
    state.counters["ratio_mean"] = found.of_best.mean / prototype.mean;
}

void run_chain(benchmark::State& state,
               const toolpath::KinematicError& error,
               const grid::Grid& start,
               const Prototype& prototype) {
    for (auto _ : state) {
        grid::ChainOptimiser chain(error, start, grid::TrackDirection::along_u, {});
        tell(state, run(chain, {}), prototype.at(state.range(0)));
    }
}

void two_bells(benchmark::State& state) {
    run_chain(state,
              {patch("two-bell"), machine("ac-table"), false},
              test::inner_tracks(static_cast<int>(state.range(0))),
              {{15, {1.01, 0.441}},
               {20, {0.548, 0.269}},
               {30, {0.349, 0.140}},
               {40, {0.179, 0.079}},
               {60, {0.117, 0.041}}});
}
BENCHMARK(two_bells)
    ->Arg(15)
    ->Arg(20)
    ->Arg(30)
    ->Arg(40)
    ->Arg(60)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kSecond);

/// As many tracks as nodes, over the whole surface, on the thesis's machine.
void dome_on(benchmark::State& state, const kinematics::MachineModel& table, const Prototype& prototype) {
    const auto n = static_cast<int>(state.range(0));
    run_chain(state, {patch("dome"), table, false}, grid::Grid::uniform(n, n), prototype);
}

void dome(benchmark::State& state) {
    dome_on(state,
            machine("rotary-tilt-listing"),
            {{10, {1.21, 0.640}}, {20, {0.434, 0.203}}, {40, {0.202, 0.0574}}});
}
BENCHMARK(dome)->Arg(10)->Arg(20)->Arg(40)->Iterations(1)->MeasureProcessCPUTime()->Unit(benchmark::kSecond);

/// With the part where the mean error of a uniform grid is least.
void dome_in_its_best_set_up(benchmark::State& state) {
    const Vec3 best_set_up(-45.0, -44.0, 220.0);
    dome_on(state,
            machine("rotary-tilt-listing").with_workpiece_offset(best_set_up),
            {{20, {0.190, 0.130}}, {40, {0.094, 0.0353}}});
}
BENCHMARK(dome_in_its_best_set_up)
    ->Arg(20)
    ->Arg(40)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kSecond);

/// The other way round: points of eight tracks on the two bells for a largest error, in micrometres.
void points_for_an_error(benchmark::State& state) {
    const std::map<std::int64_t, double> prototype{{500, 138.0}, {200, 234.0}, {100, 334.0}, {50, 466.0}};
    const std::array tolerance{1e-3 * static_cast<double>(state.range(0))};
    const plan::Folders folders{{}, project::assets_folder()};
    for (auto _ : state) {
        const auto row = studies::fewest_points({}, tolerance, folders, Progress()).front();
        state.counters["uniform"] = row.uniform.value_or(0);
        state.counters["fewest"] = row.fewest.value_or(0);
        state.counters["prototype"] = prototype.at(state.range(0));
        state.counters["ratio"] = row.fewest.value_or(0) / prototype.at(state.range(0));
    }
}
BENCHMARK(points_for_an_error)
    ->Arg(500)
    ->Arg(200)
    ->Arg(100)
    ->Arg(50)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kSecond);

} // namespace
} // namespace millwright
