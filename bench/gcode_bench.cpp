// How fast programs are read: plain XYZ and XYZAC programs with full semantics, and the memory that a long
// program takes; and how fast they are printed as canonical commands, beside LinuxCNC's rs274, which prints
// the same of the same file in the same run (processor time of both, where rs274 is installed).
#include "bench/processor_time.h"
#include "core/base/files.h"
#include "core/gcode/canon_printer.h"
#include "core/gcode/interpreter.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>

namespace millwright {
namespace {

using gcode::CanonSink;

/// Uses what it gets, so that nothing of the work can be left out.
class Sum final : public CanonSink {
public:
    void move(const gcode::Move& move, const gcode::SourceLine&) override {
        for (std::size_t n = 0; n < gcode::axis_count; ++n) {
            sum_ += move.target[n];
        }
    }
    void curve(const gcode::Curve&, const gcode::SourceLine&) override {}
    void command(const gcode::Command&, const gcode::SourceLine&) override {}
    [[nodiscard]] double sum() const { return sum_; }

private:
    double sum_ = 0.0;
};

/// A program of so many feed moves, gone when the benchmark is over.
class ProgramFile {
public:
    ProgramFile(int lines, bool five_axes)
        : file_(std::filesystem::temp_directory_path() / fmt::format("gcode_bench_{}.ngc", getpid())) {
        std::mt19937 random(274);
        std::uniform_real_distribution<double> place(-100.0, 100.0);
        std::string text = "G21 G90 G94 F1000\nG1\n";
        for (int n = 0; n < lines; ++n) {
            fmt::format_to(std::back_inserter(text),
                           "X{:.4f} Y{:.4f} Z{:.4f}",
                           place(random),
                           place(random),
                           place(random));
            if (five_axes) {
                fmt::format_to(std::back_inserter(text), " A{:.4f} C{:.4f}", place(random), place(random));
            }
            text += '\n';
        }
        write_file(file_, text + "M2\n");
    }
    ProgramFile(const ProgramFile&) = delete;
    ProgramFile& operator=(const ProgramFile&) = delete;
    ~ProgramFile() { std::filesystem::remove(file_); }

    [[nodiscard]] const std::filesystem::path& path() const { return file_; }

private:
    std::filesystem::path file_;
};

double read_program(const std::filesystem::path& file) {
    Sum sum;
    gcode::Interpreter program(file, {}, sum);
    program.run();
    if (!program.errors().empty()) {
        throw std::runtime_error(to_text(program.errors().front()));
    }
    return sum.sum();
}

/// Its canonical commands, written to nowhere, as rs274 writes its own.
void print_program(const std::filesystem::path& file) {
    std::FILE* nowhere = std::fopen("/dev/null", "w");
    gcode::CanonPrinter printer(
        [nowhere](std::string_view text) { std::fwrite(text.data(), 1, text.size(), nowhere); });
    gcode::Interpreter program(file, {}, printer);
    program.run();
    printer.flush();
    std::fclose(nowhere);
    if (!program.errors().empty()) {
        throw std::runtime_error(to_text(program.errors().front()));
    }
}

/// First of all, since the peak of a process never falls; and the file is made by another one.
void memory_of_a_long_program(benchmark::State& state) {
    constexpr int count = 5'000'000;
    const auto file =
        std::filesystem::temp_directory_path() / fmt::format("gcode_bench_long_{}.ngc", getpid());
    const std::string make = fmt::format(
        "(echo 'G21 G90 F1000'; seq -f 'G1 X%.4f Y-12.3456 Z3.2109' 0.0001 0.0001 {} ; echo M2) > {}",
        count * 1e-4,
        file.string());
    if (std::system(make.c_str()) != 0) { // NOLINT(bugprone-command-processor,cert-env33-c)
        state.SkipWithError("the program cannot be written");
        return;
    }
    for (auto _ : state) {
        benchmark::DoNotOptimize(read_program(file));
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    state.SetItemsProcessed(state.iterations() * count);
    state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
    std::filesystem::remove(file);
}
BENCHMARK(memory_of_a_long_program)->Unit(benchmark::kMillisecond)->Iterations(1);

void lines(benchmark::State& state, bool five_axes) {
    constexpr int count = 1'000'000;
    const ProgramFile file(count, five_axes);
    for (auto _ : state) {
        benchmark::DoNotOptimize(read_program(file.path()));
    }
    state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK_CAPTURE(lines, xyz, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(lines, xyzac, true)->Unit(benchmark::kMillisecond);

void beside_rs274(benchmark::State& state, bool five_axes) {
    constexpr int count = 300'000;
    const ProgramFile file(count, five_axes);
    const std::string command = "rs274 -g " + file.path().string() + " /dev/null >/dev/null 2>&1";
    double ours = 0.0;
    double theirs = 0.0;
    for (auto _ : state) {
        const double self = processor_time(RUSAGE_SELF);
        print_program(file.path());
        ours += processor_time(RUSAGE_SELF) - self;
        const double children = processor_time(RUSAGE_CHILDREN);
        if (std::system(command.c_str()) != 0) { // NOLINT(bugprone-command-processor,cert-env33-c)
            state.SkipWithError("rs274 is not installed (Debian package linuxcnc-uspace)");
            break;
        }
        theirs += processor_time(RUSAGE_CHILDREN) - children;
    }
    const double done = static_cast<double>(state.iterations()) * count;
    state.counters["lines_per_s"] = done / ours;
    state.counters["rs274_lines_per_s"] = done / theirs;
    state.counters["times_rs274"] = theirs / ours;
}
BENCHMARK_CAPTURE(beside_rs274, xyz, false)->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK_CAPTURE(beside_rs274, xyzac, true)->Unit(benchmark::kMillisecond)->Iterations(3);

} // namespace
} // namespace millwright
