#include "core/grid/run_time_study.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/grid/jacobi_newton.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace millwright::grid {

namespace {

/// Puts the number of threads back.
class ThreadCount {
public:
    ThreadCount() : before_(thread_count()) {}
    ThreadCount(const ThreadCount&) = delete;
    ThreadCount& operator=(const ThreadCount&) = delete;
    ~ThreadCount() { set_thread_count(before_); }

private:
    int before_;
};

NodeArray unit_grid(int side) {
    NodeArray nodes(side, side);
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            nodes.at(i, j) = Vec2(i, j);
        }
    }
    return nodes;
}

EllipticSettings timed_settings(int iterations) {
    return {.functional = {.adaptation = 1.0, .orthogonality = 0.0},
            .tolerance = 0.0,
            .max_iterations = iterations};
}

struct TimedRun {
    NodeArray nodes;
    double processor = infinity;
    double wall = infinity;
};

TimedRun timed_run(int side, int threads, int iterations, const StudyClocks& clocks) {
    set_thread_count(threads);
    const WeightPtr weight = weight_w1_on(side);
    NodeArray start = unit_grid(side);
    const double wall = clocks.wall(), processor = clocks.processor();
    JacobiNewton solver(std::move(start), weight, timed_settings(iterations));
    (void)solve(solver);
    return {solver.nodes(), clocks.processor() - processor, clocks.wall() - wall};
}

/// One run of each number of threads that is not timed: threads start, and memory is mapped, in the first.
void run_untimed(const RunTimeSettings& settings, int side) {
    for (const int threads : settings.threads) {
        set_thread_count(threads);
        JacobiNewton solver(unit_grid(side), weight_w1_on(side), timed_settings(settings.iterations));
        (void)solve(solver);
    }
}

/// A processor that was idle is slow at first.
void warm_up(const RunTimeSettings& settings, const StudyClocks& clocks, const Progress& progress) {
    if (!(settings.warm_up > 0.0) || settings.sides.empty()) {
        return;
    }
    const double begin = clocks.wall();
    while (clocks.wall() - begin < settings.warm_up) {
        progress.check();
        run_untimed(settings, settings.sides.front());
    }
}

/// What this process and the whole machine have used from here on.
class Usage {
public:
    explicit Usage(const StudyClocks& clocks)
        : clocks_(clocks), wall_(clocks.wall()), processor_(clocks.processor()), machine_(clocks.machine()) {}

    [[nodiscard]] std::optional<double> other_cores() const {
        const std::optional<double> machine = clocks_.machine();
        const double wall = clocks_.wall() - wall_, own = clocks_.processor() - processor_;
        if (!machine || !machine_ || !(wall > 0.0)) {
            return std::nullopt;
        }
        return std::max(0.0, *machine - *machine_ - own) / wall;
    }

private:
    const StudyClocks& clocks_;
    double wall_, processor_;
    std::optional<double> machine_;
};

/// The parts of the same iterations, each by the processor time that it takes on one thread.
RunTimeProfile profile_of(int side, int iterations, const StudyClocks& clocks) {
    set_thread_count(1);
    const WeightPtr weight = weight_w1_on(side);
    const EllipticSettings settings = timed_settings(iterations);
    const EquationRules rules{settings.functional, settings.derivatives};
    RunTimeProfile profile{.side = side};
    double last = clocks.processor();
    const auto lap = [&](double& part) {
        const double now = clocks.processor();
        part += now - last;
        last = now;
    };
    NodeArray nodes = unit_grid(side);
    std::vector<NodeEquations> equations;
    const auto sweep = [&] {
        const std::vector<double> w = weight_at_nodes(*weight, nodes);
        lap(profile.weight);
        equations = all_equations(nodes, w, rules, std::move(equations));
        lap(profile.equations);
    };
    last = clocks.processor();
    sweep();
    double lowest = infinity;
    for (int n = 0; n < iterations; ++n) {
        (void)relax(nodes, equations, settings.boundary, settings.relaxation);
        lap(profile.update);
        sweep();
        lowest = std::min(lowest, residual_norm(equations));
        lap(profile.norm);
        lowest = std::min({lowest, min_cell_area(nodes), min_corner_jacobian(nodes)});
        lap(profile.checks);
    }
    expects(lowest > 0.0, "the grids of the study stay valid");
    return profile;
}

/// Of as many as the runs have.
RunTimeProfile fastest_profile(int side, const RunTimeSettings& settings, const StudyClocks& clocks) {
    RunTimeProfile fastest = profile_of(side, settings.iterations, clocks);
    for (int n = 1; n < settings.repeats; ++n) {
        const RunTimeProfile other = profile_of(side, settings.iterations, clocks);
        fastest = other.sum() < fastest.sum() ? other : fastest;
    }
    return fastest;
}

} // namespace

RunTimeStudy
run_time_study(const RunTimeSettings& settings, const StudyClocks& clocks, const Progress& progress) {
    expects(!settings.threads.empty() && settings.iterations > 0 && settings.repeats > 0,
            "a run-time study has at least one run");
    const ThreadCount put_back;
    RunTimeStudy study;
    progress.check();
    warm_up(settings, clocks, progress);
    const Usage usage(clocks);
    double one_thread_processor = 0.0, one_thread_wall = 0.0;
    const auto sides = std::ssize(settings.sides);
    for (std::ptrdiff_t n = 0; n < sides; ++n) {
        const int side = settings.sides[static_cast<std::size_t>(n)];
        std::vector<TimedRun> best(settings.threads.size());
        run_untimed(settings, side);
        for (int k = 0; k < settings.repeats; ++k) {
            progress.check();
            progress.report((static_cast<double>(n) + static_cast<double>(k) / settings.repeats) /
                                static_cast<double>(sides),
                            "Timing " + std::to_string(side) + " x " + std::to_string(side) + " nodes");
            for (std::size_t t = 0; t < best.size(); ++t) { // in turns, so that a busy moment meets all
                TimedRun run = timed_run(side, settings.threads[t], settings.iterations, clocks);
                if (settings.threads[t] == 1) {
                    one_thread_processor += run.processor;
                    one_thread_wall += run.wall;
                }
                if (run.wall < best[t].wall) {
                    best[t] = std::move(run);
                }
            }
        }
        for (std::size_t t = 0; t < best.size(); ++t) {
            study.runs.push_back({.side = side,
                                  .threads = settings.threads[t],
                                  .processor = best[t].processor,
                                  .wall = best[t].wall,
                                  .speed_up = best.front().wall / best[t].wall,
                                  .same_nodes = best[t].nodes == best.front().nodes});
        }
        study.profiles.push_back(fastest_profile(side, settings, clocks));
    }
    study.one_thread_share = one_thread_wall > 0.0 ? one_thread_processor / one_thread_wall : 1.0;
    study.other_cores = usage.other_cores();
    return study;
}

} // namespace millwright::grid
