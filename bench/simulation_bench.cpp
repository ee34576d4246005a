// Removal along the path of a public benchmark: a block of 200 x 100 x 20 mm, rows of 1 mm segments 2 mm
// apart, levels of 1.5 mm, a ball end of 6 mm whose axis swings by 15 degrees. planar: the axis swings in the
// plane of the row; twisted: sideways, too.
//     build/release/bench/simulation_bench --benchmark_counters_tabular=true
// Counters: segments, seconds on the clock, MB of the field at the end, mm3 removed.
#include "core/base/units.h"
#include "core/simulation/removal.h"
#include "core/toolpath/cutter.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

namespace millwright::simulation {
namespace {

constexpr double length = 200.0, width = 100.0, height = 20.0;

Vec3 swung(int segment, bool twisted) {
    constexpr int period = 40;
    const double phase = 2.0 * pi * segment / period;
    const double ahead = std::tan(from_degrees(15.0) * std::sin(phase));
    const double aside = twisted ? std::tan(from_degrees(15.0) * std::sin(0.7 * phase + 1.0)) : 0.0;
    return Vec3(ahead, aside, 1.0).normalized();
}

std::vector<geometry::ToolPose> bench_path(std::size_t segments, bool twisted) {
    std::vector<geometry::ToolPose> poses;
    int n = 0;
    for (double z = -1.5; poses.size() <= segments; z -= 1.5) {
        bool back = false;
        for (double y = 0.0; y <= width && poses.size() <= segments; y += 2.0, back = !back) {
            for (int x = 0; x <= static_cast<int>(length) && poses.size() <= segments; ++x, ++n) {
                poses.push_back({Vec3(back ? length - x : x, y, z), swung(n, twisted)});
            }
        }
    }
    return poses;
}

void cut_bench(benchmark::State& state, bool twisted) {
    const auto segments = static_cast<std::size_t>(state.range(1));
    const std::vector<geometry::ToolPose> poses = bench_path(segments, twisted);
    const toolpath::Profile ball =
        *toolpath::body_of({.kind = toolpath::CutterKind::ball, .diameter = 6.0, .length = 23.0});
    const CuttingBody cutter(ball);
    for (auto _ : state) {
        DexelField field(BoxStock{{0.0, 0.0, -height}, {length, width, 0.0}},
                         1e-3 * static_cast<double>(state.range(0)),
                         1'000'000'000,
                         Progress());
        std::vector<CutStep> steps;
        for (std::size_t n = 1; n < poses.size(); ++n) {
            divide(cutter, poses[n - 1], poses[n], static_cast<std::int32_t>(n), false, steps);
        }
        Removal removal(field);
        removal.remove(steps, Progress());
        state.counters["steps"] = static_cast<double>(steps.size());
        state.counters["MB"] = 1e-6 * static_cast<double>(field.bytes());
        state.counters["mm3"] = length * width * height - field.volume();
    }
    state.counters["segments"] = static_cast<double>(segments);
}

void planar(benchmark::State& state) {
    cut_bench(state, false);
}
void twisted(benchmark::State& state) {
    cut_bench(state, true);
}

BENCHMARK(planar)
    ->ArgNames({"um", "segments"})
    ->Args({200, 5000})
    ->Args({200, 104'880})
    ->Args({100, 104'880})
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK(twisted)
    ->ArgNames({"um", "segments"})
    ->Args({200, 104'880})
    ->Args({100, 104'880})
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

} // namespace
} // namespace millwright::simulation
