#include "app/command_line/option_values.h"
#include "app/command_line/output_transaction.h"
#include "app/command_line/watched_work.h"
#include "app/studies/study_command.h"
#include "core/base/counted.h"
#include "core/base/parallel.h"
#include "core/base/text.h"
#include "core/grid/run_time_study.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

using grid::RunTime;
using grid::RunTimeProfile;
using grid::RunTimeStudy;

constexpr double pays_from = 1.1;    // a speed-up below is lost in the noise
constexpr double undisturbed = 0.95; // of the wall time, which one thread computes on a quiet machine
constexpr double quiet_cores = 0.1;  // that other programs may use on a quiet machine
constexpr double warm_up_seconds = 0.3;
constexpr int thesis_iterations = 10; // of its table 7-2

struct RunTimeOptions {
    grid::RunTimeSettings settings;
    std::string out; ///< empty: no file
};

/// Of Linux: everything but idle in the first line of /proc/stat, which has hundredths of a second of all
/// cores (user, nice, system, idle, iowait, irq, softirq, steal).
std::optional<double> machine_seconds() {
    constexpr int columns = 8, idle = 3, waiting = 4;
    std::ifstream file("/proc/stat");
    std::string name;
    file >> name;
    double ticks = 0.0;
    for (int n = 0; n < columns; ++n) {
        double column = 0.0;
        file >> column;
        ticks += n == idle || n == waiting ? 0.0 : column;
    }
    const auto per_second = static_cast<double>(::sysconf(_SC_CLK_TCK));
    return file && name == "cpu" && per_second > 0.0 ? std::optional(ticks / per_second) : std::nullopt;
}

grid::StudyClocks system_clocks() {
    const auto wall = [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
    const auto processor = [] {
        timespec now{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    };
    return {wall, processor, machine_seconds};
}

std::string in_milliseconds(double seconds) {
    return fixed(1e3 * seconds, 3);
}

/// Table 7-1: one row of ours per size, with the thesis's time for as many iterations.
void print_sizes(const RunTimeStudy& study, int iterations) {
    fmt::print("\nTable 7-1: {} on {}. Thesis: Convex SPP-1600, one thread, weight W4, scaled to the same "
               "number of iterations\n",
               counted(iterations, "iteration"),
               counted(study.runs.front().threads, "thread"));
    fmt::print("{:>7} {:>13} {:>11} {:>14} {:>18} {:>14} {:>8}\n",
               "nodes",
               "processor ms",
               "wall ms",
               "ns per node",
               "thesis processor s",
               "thesis wall s",
               "ratio");
    for (const RunTime& run : study.runs) {
        if (run.threads != study.runs.front().threads) {
            continue;
        }
        const double per_node = 1e9 * run.processor / (1.0 * run.side * run.side * iterations);
        const auto* const thesis =
            std::ranges::find(grid::thesis_table_7_1, run.side, &grid::ThesisRunTime::side); // W4 comes first
        const bool known = thesis != grid::thesis_table_7_1.end();
        const double share = known ? static_cast<double>(iterations) / thesis->iterations : 0.0;
        fmt::print("{:>7} {:>13} {:>11} {:>14} {:>18} {:>14} {:>8}\n",
                   run.side * run.side,
                   in_milliseconds(run.processor),
                   in_milliseconds(run.wall),
                   fixed(per_node, 1),
                   known ? fixed(share * thesis->processor, 1) : "-",
                   known ? fixed(share * thesis->wall, 1) : "-",
                   known ? fmt::format("{:.0f}", share * thesis->processor / run.processor) : "-");
    }
}

std::string verdict(const RunTime& run, int first) {
    if (!run.same_nodes) {
        return "different nodes!";
    }
    return run.threads == first ? "" : run.speed_up < pays_from ? "no benefit" : "";
}

void print_threads(const RunTimeStudy& study) {
    const int first = study.runs.front().threads;
    fmt::print("\nTable 7-2: effect of threads\n");
    fmt::print(
        "{:>7} {:>8} {:>13} {:>11} {:>9}\n", "nodes", "threads", "processor ms", "wall ms", "speed-up");
    for (const RunTime& run : study.runs) {
        const std::string remark = verdict(run, first);
        fmt::print("{:>7} {:>8} {:>13} {:>11} {:>9}{}\n",
                   run.side * run.side,
                   run.threads,
                   in_milliseconds(run.processor),
                   in_milliseconds(run.wall),
                   fixed(run.speed_up, 2),
                   remark.empty() ? "" : "  " + remark);
    }
    for (const grid::ThesisCompilation& row : grid::thesis_table_7_2) {
        fmt::print("{:>7} {:>8} {:>13} {:>11} {:>9}\n",
                   row.option,
                   row.threads,
                   fmt::format("{:.0f} s", row.processor),
                   fmt::format("{:.0f} s", row.wall),
                   fixed(grid::thesis_table_7_2[2].wall / row.wall, 2));
    }
    fmt::print("-O0 to -O3: the thesis's compiler options, {} iterations, number of nodes not stated\n",
               thesis_iterations);
}

std::string in_percent(double share) {
    return fixed(100.0 * share, 1) + " %";
}

void print_profiles(const RunTimeStudy& study) {
    fmt::print("\nProfile: shares of the iterations, one thread\n");
    fmt::print(
        "{:>7} {:>9} {:>10} {:>9} {:>9} {:>9}\n", "nodes", "weight", "equations", "update", "norm", "checks");
    for (const RunTimeProfile& of : study.profiles) {
        const double sum = of.sum();
        fmt::print("{:>7} {:>9} {:>10} {:>9} {:>9} {:>9}\n",
                   of.side * of.side,
                   in_percent(of.weight / sum),
                   in_percent(of.equations / sum),
                   in_percent(of.update / sum),
                   in_percent(of.norm / sum),
                   in_percent(of.checks / sum));
    }
    const grid::ThesisProfile thesis;
    fmt::print("{:>7} {:>9} {:>10} {:>9} {:>9} {:>9}\n",
               "thesis",
               in_percent(thesis.weight),
               in_percent(thesis.equations),
               in_percent(thesis.update),
               in_percent(thesis.norm),
               "none");
}

/// What other programs took meanwhile; empty on a quiet machine.
std::string disturbance(const RunTimeStudy& study) {
    if (study.other_cores && *study.other_cores > quiet_cores) {
        return fmt::format("other programs used {} of {}",
                           fixed(*study.other_cores, 1),
                           counted(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN)), "core"));
    }
    return study.one_thread_share < undisturbed
               ? fmt::format("one thread got {} of a core", in_percent(study.one_thread_share))
               : std::string();
}

std::string run_time_csv(const RunTimeStudy& study, int iterations) {
    std::string text = "nodes,threads,iterations,processor_s,wall_s,speed_up,same_nodes\n";
    for (const RunTime& run : study.runs) {
        text += fmt::format("{},{},{},{:.9f},{:.9f},{:.4f},{}\n",
                            run.side * run.side,
                            run.threads,
                            iterations,
                            run.processor,
                            run.wall,
                            run.speed_up,
                            run.same_nodes ? 1 : 0);
    }
    return text;
}

std::string run_time_profile_csv(const RunTimeStudy& study) {
    std::string text = "nodes,weight_s,equations_s,update_s,norm_s,checks_s\n";
    for (const RunTimeProfile& of : study.profiles) {
        text += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n",
                            of.side * of.side,
                            of.weight,
                            of.equations,
                            of.update,
                            of.norm,
                            of.checks);
    }
    return text;
}

int run_time(const RunTimeOptions& options) {
    const Interrupt interrupt;
    grid::RunTimeSettings settings = options.settings;
    settings.warm_up = warm_up_seconds;
    if (settings.threads.empty()) {
        for (int n = 1; n <= thread_count(); ++n) {
            settings.threads.push_back(n);
        }
    }
    std::optional<OutputFolder> folder;
    if (!options.out.empty()) {
        folder.emplace(options.out);
    }
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, interrupt.token());
    const RunTimeStudy study = grid::run_time_study(settings, system_clocks(), progress);
    printer.finish();
    fmt::print(
        "The thesis's iteration: W1 as wide as on 25 x 25 nodes, LV 1, WW 0.81; {}, fastest of {} after a "
        "warm-up\n",
        counted(settings.iterations, "iteration"),
        counted(settings.repeats, "run"));
    print_sizes(study, settings.iterations);
    print_threads(study);
    print_profiles(study);
    if (const std::string busy = disturbance(study); !busy.empty()) {
        fmt::print("\nThe computer was busy: {}. The speed-ups are unreliable; repeat this when nothing else "
                   "is running.\n",
                   busy);
    }
    if (!options.out.empty()) {
        write_outputs(options.out,
                      {{{"run-time.csv", run_time_csv(study, settings.iterations)},
                        {"run-time-profile.csv", run_time_profile_csv(study)}}});
    }
    const bool same = std::ranges::all_of(study.runs, &RunTime::same_nodes);
    return same ? 0 : 1;
}

} // namespace

void add_study_run_time_command(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<RunTimeOptions>();
    options->settings.threads.clear();
    constexpr int most_nodes_per_side = 1000, most_threads_timed = 1024, most_runs = 1000;
    CLI::App& command = *group.add_subcommand("run-time",
                                              "Measure the run time of the adaptation, by nodes and threads, "
                                              "and compare it with the thesis's tables 7-1 and 7-2");
    command.add_option("--side", options->settings.sides, "Nodes per side")
        ->delimiter(',')
        ->check(CLI::Range(3, most_nodes_per_side))
        ->capture_default_str();
    command
        .add_option(
            "--threads",
            options->settings.threads,
            "Numbers of threads; the first is the reference for the others (default: 1 to one per core)")
        ->delimiter(',')
        ->check(CLI::Range(1, most_threads_timed));
    command.add_option("--iterations", options->settings.iterations, "Iterations per run")
        ->check(CLI::Range(1, most_runs))
        ->capture_default_str();
    command.add_option("--repeats", options->settings.repeats, "Runs per case; the fastest counts")
        ->check(CLI::Range(1, most_runs))
        ->capture_default_str();
    command.add_option("--out", options->out, "Folder for run-time.csv and run-time-profile.csv")
        ->type_name("DIR");
    command.callback([&chosen, options] { chosen = [options] { return run_time(*options); }; });
}

} // namespace millwright::app
