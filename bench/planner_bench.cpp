// How many blocks per second are planned: 5 axes, blocks of 1 mm along a curve on a machine with a table of
// two rotary axes, whole plans of 100,000 blocks; and how much time the whole look-ahead saves beside one of
// 16 blocks.
#include "core/base/units.h"
#include "core/gcode/interpreter.h"
#include "core/gcode_programs/machine_program.h"
#include "core/kinematics/machine_file.h"
#include "core/motion/planner.h"
#include "core/motion/time_estimate.h"
#include "core/project/assets.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

namespace millwright {
namespace {

kinematics::MachineModel five_axes(bool jerk) {
    kinematics::MachineDescription machine =
        kinematics::read_machine(project::assets_folder() / "machines/ac-table.json").description();
    for (auto* axes : {&machine.table, &machine.head}) {
        for (kinematics::MachineAxis& axis : *axes) {
            axis.max_jerk = jerk ? 20.0 * axis.max_acceleration : std::numeric_limits<double>::infinity();
        }
    }
    return kinematics::MachineModel(std::move(machine));
}

/// All five axes move all the time; some corners are sharp.
program::Program wave(const kinematics::MachineModel& machine, int blocks, program::PathMode mode) {
    program::Program program;
    program.machine = machine.name();
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        program.axes.push_back({axis.letter, axis.kind});
    }
    program.start = kinematics::AxisPositions::Zero(machine.axis_count());
    for (int n = 1; n <= blocks; ++n) {
        const int track = n / 200;
        const double along = n % 200;
        const double x = track % 2 == 0 ? along : 200.0 - along;
        program::Block& block = program.blocks.emplace_back();
        block.kind = program::BlockKind::feed;
        block.named = program::AxisSet::all(machine.axis_count());
        block.target = program.start;
        block.target << x - 100.0, 0.1 * (track % 1000), 5.0 * std::sin(0.05 * x),
            from_degrees(10.0 * std::sin(0.03 * x)), from_degrees(20.0 * std::cos(0.04 * x));
        block.duration = 1.0 / 50.0; // 3000 mm/min
        block.feed = 50.0;
        block.path = program::PathControl{mode, 0.02};
    }
    return program;
}

void plan(benchmark::State& state, program::PathMode mode, bool jerk, int look_ahead) {
    constexpr int blocks = 100'000;
    const kinematics::MachineModel machine = five_axes(jerk);
    const program::Program program = wave(machine, blocks, mode);
    motion::PlannerSettings settings;
    settings.look_ahead = look_ahead;
    double duration = 0.0;
    for (auto _ : state) {
        duration = motion::plan(program, machine, settings, {}).duration();
        benchmark::DoNotOptimize(duration);
    }
    state.SetItemsProcessed(state.iterations() * blocks);
    state.counters["duration_s"] = duration;
}
BENCHMARK_CAPTURE(plan, exact_path, program::PathMode::exact_path, false, 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, exact_path_jerk, program::PathMode::exact_path, true, 0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, rounded, program::PathMode::continuous, false, 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, rounded_jerk, program::PathMode::continuous, true, 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, rounded_jerk_16_blocks, program::PathMode::continuous, true, 16)
    ->Unit(benchmark::kMillisecond);

/// The duration alone, in flat memory.
void estimate(benchmark::State& state, program::PathMode mode, bool jerk) {
    constexpr int blocks = 100'000;
    const kinematics::MachineModel machine = five_axes(jerk);
    const program::Program program = wave(machine, blocks, mode);
    motion::FilterTime filter(machine, program.start);
    for (const program::Block& block : program.blocks) {
        filter.add(block);
    }
    double duration = 0.0;
    for (auto _ : state) {
        motion::TimeEstimate time(machine, {}, program.start, filter);
        for (const program::Block& block : program.blocks) {
            time.add(block);
        }
        duration = time.finish();
        benchmark::DoNotOptimize(duration);
    }
    state.SetItemsProcessed(state.iterations() * blocks);
    state.counters["duration_s"] = duration;
}
BENCHMARK_CAPTURE(estimate, exact_path, program::PathMode::exact_path, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(estimate, rounded_jerk, program::PathMode::continuous, true)->Unit(benchmark::kMillisecond);

/// What a machine with all of its axes does for a file; nothing if it cannot.
program::Program sample(const kinematics::MachineModel& machine, const std::filesystem::path& file) {
    gcode::MachineProgramBuilder builder(machine, file);
    gcode::ReaderSettings settings;
    settings.any_tool = true;
    gcode::Interpreter reader(file, settings, builder);
    reader.run();
    gcode::MachineProgram read = builder.take();
    return reader.errors().empty() && read.faults.empty() ? std::move(read.program) : program::Program{};
}

/// All sample programs, planned as a whole and with a look-ahead of 16 moves.
void samples(benchmark::State& state, bool jerk) {
    const kinematics::MachineModel machine = five_axes(jerk);
    std::vector<program::Program> programs;
    for (const auto& entry :
         std::filesystem::directory_iterator(project::assets_folder() / "samples/gcode")) {
        programs.push_back(sample(machine, entry.path()));
    }
    std::erase_if(programs, [](const program::Program& program) { return program.blocks.empty(); });
    motion::PlannerSettings sixteen;
    sixteen.look_ahead = 16;
    double whole = 0.0;
    double short_sighted = 0.0;
    double worst = 0.0;
    double best = 1.0;
    for (auto _ : state) {
        whole = short_sighted = worst = 0.0;
        for (const program::Program& program : programs) {
            const double ours = motion::plan(program, machine, {}, {}).duration();
            const double theirs = motion::plan(program, machine, sixteen, {}).duration();
            whole += ours;
            short_sighted += theirs;
            worst = std::max(worst, theirs > 0.0 ? ours / theirs : 0.0);
            best = std::min(best, theirs > 0.0 ? ours / theirs : 1.0);
        }
    }
    state.counters["programs"] = static_cast<double>(programs.size());
    state.counters["whole_s"] = whole;
    state.counters["16_blocks_s"] = short_sighted;
    state.counters["largest_ratio"] = worst;
    state.counters["smallest_ratio"] = best;
}
BENCHMARK_CAPTURE(samples, acceleration, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(samples, jerk, true)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace millwright
