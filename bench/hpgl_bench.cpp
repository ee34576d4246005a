// How fast plot files are read, beside hp2xx on the same file in the same run (processor time of both, where
// hp2xx is installed), and how fast strokes are ordered.
#include "bench/processor_time.h"
#include "core/base/files.h"
#include "core/hpgl/reader.h"
#include "core/plot/decode.h"
#include "core/plot/ordering.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <random>
#include <string>

namespace millwright::plot {
namespace {

/// A plot of so many commands, a fifth of them lifting the pen, gone when the benchmark is over.
class PlotFile {
public:
    explicit PlotFile(int commands)
        : file_(std::filesystem::temp_directory_path() / fmt::format("hpgl_bench_{}.plt", getpid())) {
        std::mt19937 random(7475);
        std::uniform_int_distribution<int> place(0, 16000);
        std::string text = "IN;SP1;";
        for (int n = 2; n < commands; ++n) {
            fmt::format_to(
                std::back_inserter(text), "{}{},{};", n % 5 == 0 ? "PU" : "PD", place(random), place(random));
        }
        write_file(file_, text);
    }
    PlotFile(const PlotFile&) = delete;
    PlotFile& operator=(const PlotFile&) = delete;
    ~PlotFile() { std::filesystem::remove(file_); }

    [[nodiscard]] const std::filesystem::path& path() const { return file_; }

private:
    std::filesystem::path file_;
};

void beside_hp2xx(benchmark::State& state) {
    constexpr int count = 400'000;
    const PlotFile file(count);
    const std::string svg = file.path().string() + ".svg";
    const std::string command =
        fmt::format("hp2xx -q -t -msvg -f{} {} 2>/dev/null", svg, file.path().string());
    double ours = 0.0;
    double theirs = 0.0;
    for (auto _ : state) {
        const double self = processor_time(RUSAGE_SELF);
        benchmark::DoNotOptimize(hpgl::read_hpgl_file(file.path()));
        ours += processor_time(RUSAGE_SELF) - self;
        const double children = processor_time(RUSAGE_CHILDREN);
        if (std::system(command.c_str()) != 0) { // NOLINT(bugprone-command-processor,cert-env33-c)
            state.SkipWithError("hp2xx is not installed (Debian package hp2xx)");
            break;
        }
        theirs += processor_time(RUSAGE_CHILDREN) - children;
    }
    std::filesystem::remove(svg);
    state.SetItemsProcessed(state.iterations() * count);
    state.counters["ours_ms"] = 1e3 * ours / static_cast<double>(state.iterations());
    state.counters["hp2xx_ms"] = 1e3 * theirs / static_cast<double>(state.iterations());
    state.counters["times_as_fast"] = theirs / ours;
}
BENCHMARK(beside_hp2xx)->Unit(benchmark::kMillisecond);

/// Reading and the points of a table at once: what `millwright plot decode` does before it writes.
void decoding(benchmark::State& state) {
    constexpr int count = 400'000;
    const PlotFile file(count);
    DecodeSettings settings;
    settings.velocity = 1000.0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(decode(hpgl::read_hpgl_file(file.path()).strokes, settings));
    }
    state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK(decoding)->Unit(benchmark::kMillisecond);

void ordering(benchmark::State& state) {
    const int count = static_cast<int>(state.range(0));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(0.0, 500.0);
    Strokes strokes;
    for (int n = 0; n < count; ++n) {
        const Vec2 at(place(random), place(random));
        strokes.push_back({.pen = 1, .points = {at, at + Vec2(1.0, 1.0)}});
    }
    double air = 0.0;
    for (auto _ : state) {
        air = air_length(ordered(strokes), Vec2::Zero(), Vec2::Zero());
    }
    state.counters["air_m"] = air / 1000.0;
    state.counters["file_air_m"] = air_length(strokes, Vec2::Zero(), Vec2::Zero()) / 1000.0;
    state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK(ordering)->Unit(benchmark::kMillisecond)->Arg(1'000)->Arg(20'000)->Arg(100'000);

} // namespace
} // namespace millwright::plot
