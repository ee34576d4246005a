// What it is like to open a long G-code program in the workbench: how long until its path can be turned, the
// longest frame while it loads, and the memory that a move takes. In memory, so no display is needed; where
// no graphics card is, Mesa's llvmpipe draws on the processor.
#include "bench/visitor.h"
#include "bench/written_file.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>

namespace millwright::panels {
namespace {

using bench::Clock;
using bench::processor_time;
using bench::seconds_since;
using bench::Visitor;

/// Finishing passes over a wavy surface, as a CAM program writes them.
std::string program_text(int lines) {
    constexpr int moves_per_pass = 1000;
    std::string text = "G21 G90 G94 G54\nM3 S12000\nG0 Z30\nG1 F1500\n";
    for (int n = 0; n < lines; ++n) {
        const int pass = n / moves_per_pass;
        const int along = pass % 2 == 0 ? n % moves_per_pass : moves_per_pass - 1 - n % moves_per_pass;
        const double x = 0.2 * along;
        const double y = 0.2 * (pass % moves_per_pass) + 0.0002 * (pass / moves_per_pass);
        fmt::format_to(std::back_inserter(text),
                       "X{:.4f} Y{:.4f} Z{:.4f}\n",
                       x,
                       y,
                       10.0 + 6.0 * std::sin(0.06 * x) * std::cos(0.05 * y));
    }
    return text + "M2\n";
}

/// Of text index, path in memory and on the graphics processor, and what is in force when.
double bytes_per_move(const plan::OpenedProgram& opened) {
    const auto moves = static_cast<double>(opened.path.point_count() - 1);
    const auto on_graphics = static_cast<double>(opened.path.point_count() * sizeof(render::PathVertex));
    return (static_cast<double>(opened.path.bytes() + opened.execution->bytes()) + on_graphics) / moves;
}

void open_program(benchmark::State& state) {
    const bench::WrittenFile file("passes.ngc", program_text(static_cast<int>(state.range(0))));
    for (auto _ : state) {
        Visitor visitor;
        const Clock::time_point start = Clock::now();
        visitor.open(file.path());
        double first = 0.0;
        double read = 0.0;
        int frames = 0;
        while (!visitor.opened()->finished) {
            visitor.turn();
            ++frames;
            if (!(first > 0.0) && !visitor.opened()->path.empty()) {
                visitor.turn(); // what was there when the frame began is in it for certain
                first = seconds_since(start);
            }
        }
        read = seconds_since(start);
        state.counters["first_s"] = first;
        state.counters["whole_s"] = read;
        state.counters["frames"] = frames;
        state.counters["longest_ms"] = 1e3 * visitor.longest();
        state.counters["longest_cpu_ms"] = 1e3 * visitor.longest_cpu();
        state.counters["bytes_per_move"] = bytes_per_move(*visitor.opened());
        const Clock::time_point turning = Clock::now();
        const double before = processor_time(CLOCK_PROCESS_CPUTIME_ID);
        constexpr int turns = 20;
        for (int n = 0; n < turns; ++n) {
            visitor.turn();
        }
        state.counters["turn_cpu_ms"] = 1e3 * (processor_time(CLOCK_PROCESS_CPUTIME_ID) - before) / turns;
        state.counters["turn_ms"] = 1e3 * seconds_since(turning) / turns;
    }
}

BENCHMARK(open_program)
    ->ArgName("lines")
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Arg(10'000'000)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

} // namespace
} // namespace millwright::panels
