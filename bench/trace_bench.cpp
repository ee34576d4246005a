// How fast pictures are traced, from file to SVG file, beside the potrace program on the same picture in the
// same run (processor time of both, where potrace is installed).
#include "bench/processor_time.h"
#include "core/base/files.h"
#include "core/plot/picture/picture.h"
#include "core/plot/picture/trace.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace millwright::plot {
namespace {

/// Blots of all sizes, as a PNG for us and a PGM for potrace; gone when the benchmark is over.
class PictureFiles {
public:
    explicit PictureFiles(int side) : folder_(std::filesystem::temp_directory_path()) {
        GrayImage image{side, side, {}};
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const double level = std::sin(0.11 * x) + std::sin(0.13 * y) +
                                     std::sin(0.05 * (x - 2.0 * y)) +
                                     0.4 * std::sin(0.9 * x) * std::sin(0.7 * y);
                image.pixels.push_back(level > 0.7 ? 0 : 255);
            }
        }
        write_file(file("png"), png_bytes(image));
        write_file(file("pgm"),
                   fmt::format("P5\n{0} {0}\n255\n", side) +
                       std::string(image.pixels.begin(), image.pixels.end()));
    }
    PictureFiles(const PictureFiles&) = delete;
    PictureFiles& operator=(const PictureFiles&) = delete;
    ~PictureFiles() {
        for (const char* ending : {"png", "pgm", "svg", "potrace.svg"}) {
            std::filesystem::remove(file(ending));
        }
    }

    [[nodiscard]] std::string file(const char* ending) const {
        return (folder_ / fmt::format("trace_bench_{}.{}", getpid(), ending)).string();
    }

private:
    std::filesystem::path folder_;
};

void beside_potrace(benchmark::State& state) {
    const PictureFiles files(static_cast<int>(state.range(0)));
    const std::string command =
        fmt::format("potrace -b svg -o {} {}", files.file("potrace.svg"), files.file("pgm"));
    double ours = 0.0;
    double theirs = 0.0;
    for (auto _ : state) {
        const double self = processor_time(RUSAGE_SELF);
        const Picture picture = read_picture_file(files.file("png")).picture;
        const auto paths = trace(picture);
        write_file(files.file("svg"), svg_text(paths, picture, 0.1));
        ours += processor_time(RUSAGE_SELF) - self;
        const double children = processor_time(RUSAGE_CHILDREN);
        if (std::system(command.c_str()) != 0) { // NOLINT(bugprone-command-processor,cert-env33-c)
            state.SkipWithError("potrace is not installed (Debian package potrace)");
            break;
        }
        theirs += processor_time(RUSAGE_CHILDREN) - children;
        state.counters["outlines"] = static_cast<double>(paths.size());
    }
    state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0));
    state.counters["ours_ms"] = 1e3 * ours / static_cast<double>(state.iterations());
    state.counters["potrace_ms"] = 1e3 * theirs / static_cast<double>(state.iterations());
    state.counters["times_as_long"] = ours / theirs;
}
BENCHMARK(beside_potrace)->Unit(benchmark::kMillisecond)->Arg(1000)->Arg(4000);

} // namespace
} // namespace millwright::plot
