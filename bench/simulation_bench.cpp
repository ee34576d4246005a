// Removal along the path of a public benchmark: a block of 200 x 100 x 20 mm, rows of 1 mm segments 2 mm
// apart, levels of 1.5 mm, a ball end of 6 mm whose axis swings by 15 degrees. planar: the axis swings in the
// plane of the row; twisted: sideways, too.
// relief: a million moves of a ball of 1 mm over a plate of 100 mm, on a machine with three axes, and then to
// 20 lines anywhere in it, forwards and back.
//     build/release/bench/simulation_bench --benchmark_counters_tabular=true
// Counters: segments, MB of the field at the end, mm3 removed; of relief MB of the keyframes and processor
// time of the slowest way to a line, s. Time is that of the clock, CPU that of all threads.
#include "bench/processor_time.h"
#include "core/base/units.h"
#include "core/kinematics/machine_file.h"
#include "core/simulation/removal.h"
#include "core/simulation/simulator.h"
#include "core/toolpath/cutter.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
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

/// Rows `pitch` mm apart of points `pitch` mm apart, a million for 0.1 mm.
program::Program relief_program(const kinematics::MachineModel& machine, double pitch) {
    program::Program made;
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        made.axes.push_back({axis.letter, axis.kind});
    }
    const int side = static_cast<int>(std::lround(100.0 / pitch));
    for (int row = 0; row < side; ++row) {
        for (int n = 0; n < side; ++n) {
            const double x = pitch * (row % 2 == 0 ? n : side - 1 - n), y = pitch * row;
            const double z =
                -1.5 + std::sin(0.31 * x) * std::cos(0.23 * y) + 0.3 * std::sin(2.1 * x + 0.9 * y);
            program::Block block;
            block.kind = program::BlockKind::feed;
            block.target = kinematics::AxisPositions::Zero(machine.axis_count());
            block.target[machine.axis_index('X')] = x;
            block.target[machine.axis_index('Y')] = y;
            block.target[machine.axis_index('Z')] = z;
            for (const char letter : {'X', 'Y', 'Z'}) {
                block.named.insert(machine.axis_index(letter));
            }
            block.source_line = made.block_count() + 1;
            made.blocks.push_back(std::move(block));
        }
    }
    made.start = made.blocks.front().target;
    return made;
}

void relief(benchmark::State& state) {
    const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/router-xyz.json");
    const program::Program program = relief_program(machine, 1e-3 * static_cast<double>(state.range(0)));
    const SimulationInput input{
        .program = program,
        .machine = machine,
        .tools = {{0,
                   1,
                   *toolpath::body_of({.kind = toolpath::CutterKind::ball, .diameter = 1.0, .length = 5.0})}},
        .stock = BoxStock{{0.0, 0.0, -10.0}, {100.0, 100.0, 0.0}},
        .resolution = 0.1,
        .most_bytes = 1'000'000'000};
    for (auto _ : state) {
        Simulator simulator(input, Rewind::by_keyframes, Progress());
        simulator.advance_to(program.block_count(), Progress());
        state.PauseTiming();
        std::mt19937 random(1);
        double slowest = 0.0;
        for (int n = 0; n < 20; ++n) {
            const double before = processor_time(RUSAGE_SELF);
            const auto lines = static_cast<std::uint32_t>(program.block_count());
            simulator.advance_to_line(static_cast<int>(random() % lines), Progress());
            slowest = std::max(slowest, processor_time(RUSAGE_SELF) - before);
        }
        state.counters["to_a_line"] = slowest;
        state.counters["keyframes_MB"] = 1e-6 * static_cast<double>(simulator.keyframe_bytes());
        state.counters["MB"] = 1e-6 * static_cast<double>(simulator.field().bytes());
        state.ResumeTiming();
    }
    state.counters["segments"] = program.block_count();
}

BENCHMARK(planar)
    ->ArgNames({"um", "segments"})
    ->Args({200, 5000})
    ->Args({200, 104'880})
    ->Args({100, 104'880})
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1);
BENCHMARK(twisted)
    ->ArgNames({"um", "segments"})
    ->Args({200, 104'880})
    ->Args({100, 104'880})
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1);
BENCHMARK(relief)
    ->ArgName("um")
    ->Arg(100)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1);

} // namespace
} // namespace millwright::simulation
