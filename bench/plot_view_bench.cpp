// What it is like to have a large plot open in the workbench: how long until it is drawn, the longest frame
// while it is derived, and what a frame costs while the view is panned and zoomed.
#include "bench/visitor.h"
#include "bench/written_file.h"
#include "ui/workspaces/plot_workspace.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <iterator>
#include <random>
#include <string>

namespace millwright::panels {
namespace {

using bench::Clock;
using bench::processor_time;
using bench::seconds_since;
using bench::Visitor;

/// Short strokes all over a sheet, of six pens.
std::string strokes_text(int strokes) {
    std::mt19937 random(7475);
    std::uniform_int_distribution<int> place(0, 16'000);
    std::uniform_int_distribution<int> way(-200, 200);
    std::string text = "IN;";
    constexpr int pens = 6;
    for (int n = 0; n < strokes; ++n) {
        if (n % (strokes / pens + 1) == 0) {
            fmt::format_to(std::back_inserter(text), "SP{};", 1 + n / (strokes / pens + 1));
        }
        const int x = place(random);
        const int y = place(random);
        fmt::format_to(std::back_inserter(text), "PU{},{};PD{},{};", x, y, x + way(random), y + way(random));
    }
    return text;
}

/// Of the window's thread and of the whole program, ms a frame; and the longest of the thread.
struct FrameCost {
    double thread = 0.0, program = 0.0, longest = 0.0;
};

template <class Next> FrameCost cost_of(Visitor& visitor, const Next& next) {
    constexpr int frames = 30;
    visitor.forget_longest();
    const double thread = processor_time(CLOCK_THREAD_CPUTIME_ID);
    const double program = processor_time(CLOCK_PROCESS_CPUTIME_ID);
    for (int n = 0; n < frames; ++n) {
        visitor.draw(next(visitor.camera(), n));
    }
    return {1e3 * (processor_time(CLOCK_THREAD_CPUTIME_ID) - thread) / frames,
            1e3 * (processor_time(CLOCK_PROCESS_CPUTIME_ID) - program) / frames,
            1e3 * visitor.longest_cpu()};
}

void open_plot(benchmark::State& state) {
    const bench::WrittenFile file("strokes.plt", strokes_text(static_cast<int>(state.range(0))));
    for (auto _ : state) {
        Visitor visitor;
        const Clock::time_point start = Clock::now();
        visitor.open(file.path());
        const auto made = [&] { return visitor.app().plot().latest(); };
        double first = 0.0;
        while (!made() || !made()->finished) {
            visitor.turn();
            if (!(first > 0.0) && made() && made()->path) {
                visitor.turn(); // what was there when the frame began is in it for certain
                first = seconds_since(start);
            }
        }
        if (made()->failure) {
            state.SkipWithError(made()->failure->message.c_str());
            break;
        }
        state.counters["first_s"] = first;
        state.counters["whole_s"] = seconds_since(start);
        state.counters["opening_cpu_ms"] = 1e3 * visitor.longest_cpu();
        visitor.app().run("plot.flat");
        visitor.turn();
        const FrameCost pan = cost_of(visitor, [](const render::Camera& camera, int n) {
            return camera.panned({n % 2 == 0 ? 6.0 : -5.0, 2.0}, bench::window);
        });
        const FrameCost zoom = cost_of(visitor, [](const render::Camera& camera, int n) {
            return camera.zoomed(n < 20 ? 0.9 : 1.2, {640.0, 400.0}, bench::window);
        });
        state.counters["pan_cpu_ms"] = pan.thread;
        state.counters["pan_longest_ms"] = pan.longest;
        state.counters["pan_program_ms"] = pan.program;
        state.counters["zoom_cpu_ms"] = zoom.thread;
        state.counters["zoom_longest_ms"] = zoom.longest;
        state.counters["zoom_program_ms"] = zoom.program;
    }
}
BENCHMARK(open_plot)->Unit(benchmark::kMillisecond)->Arg(100'000)->Arg(1'000'000)->Iterations(1);

} // namespace
} // namespace millwright::panels
