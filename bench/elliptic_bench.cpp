// The thesis's iteration against multigrid, to the same norm on the same grids in one run, and how the time
// of multigrid grows with the nodes. The weight is the thesis's circle W1, as wide on every grid as on 25
// x 25.
#include "core/base/parallel.h"
#include "core/grid/jacobi_newton.h"
#include "core/grid/multigrid.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace millwright::grid {
namespace {

class ScaledRing final : public Weight {
public:
    explicit ScaledRing(int n) : scale_(24.0 / (n - 1)) {}

    void values(std::span<const Vec2> at, std::span<double> w) const override {
        for (std::size_t k = 0; k < at.size(); ++k) {
            const Vec2 p = scale_ * at[k] - Vec2(10.0, 10.0);
            w[k] = std::exp(-std::abs(25.0 - p.squaredNorm())) + 0.01;
        }
    }
    void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const override {
        for (std::size_t k = 0; k < at.size(); ++k) {
            const Vec2 p = scale_ * at[k] - Vec2(10.0, 10.0);
            const double inside = 25.0 - p.squaredNorm();
            gradient[k] = (inside < 0.0 ? -2.0 : 2.0) * scale_ * std::exp(-std::abs(inside)) * p;
        }
    }

private:
    double scale_;
};

NodeArray unit_spaced(int n) {
    NodeArray array(n, n);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            array.at(i, j) = Vec2(i, j);
        }
    }
    return array;
}

template <class Solver> void to_norm(benchmark::State& state, double norm) {
    const int n = static_cast<int>(state.range(0));
    const auto weight = std::make_shared<ScaledRing>(n);
    const EllipticSettings settings{.functional = {.adaptation = 1.0, .orthogonality = 0.0},
                                    .tolerance = norm,
                                    .max_iterations = 1000000};
    for (auto _ : state) {
        Solver solver(unit_spaced(n), weight, settings);
        if (solve(solver) != SolverStatus::converged) {
            state.SkipWithError("not converged");
        }
        state.counters["iterations"] = solver.iterations();
        state.counters["norm"] = solver.norm();
        state.counters["MB"] = static_cast<double>(Solver::memory_bytes(n, n)) / 1e6;
    }
    state.SetComplexityN(static_cast<std::int64_t>(n) * n);
}

void reference(benchmark::State& state) {
    to_norm<JacobiNewton>(state, 1e-3);
}
BENCHMARK(reference)
    ->Arg(50)
    ->Arg(150)
    ->Arg(257)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

void multigrid(benchmark::State& state) {
    to_norm<Multigrid>(state, 1e-3);
}
BENCHMARK(multigrid)->Arg(50)->Arg(150)->Arg(257)->Unit(benchmark::kMillisecond)->UseRealTime();

void multigrid_growth(benchmark::State& state) {
    to_norm<Multigrid>(state, 1e-4);
}
BENCHMARK(multigrid_growth)
    ->Arg(65)
    ->Arg(129)
    ->Arg(257)
    ->Arg(513)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Complexity(benchmark::oNLogN);

/// Tables 7-1 and 7-2 of the thesis: ten iterations on 2500 to 22500 nodes, processor time of all threads and
/// time on the wall, on one thread and on all, and what they are worth.
void thesis_ten_iterations(benchmark::State& state) {
    const int n = static_cast<int>(state.range(0));
    const EllipticSettings settings{
        .functional = {.adaptation = 1.0, .orthogonality = 0.0}, .tolerance = 0.0, .max_iterations = 10};
    const auto weight = std::make_shared<ScaledRing>(n);
    const auto run = [&](int threads) {
        set_thread_count(threads);
        JacobiNewton solver(unit_spaced(n), weight, settings);
        solve(solver);
        return solver.iterations();
    };
    const auto seconds = [&](int threads) {
        const auto before = std::chrono::steady_clock::now();
        (void)run(threads);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    };
    const auto threads = static_cast<int>(state.range(1));
    constexpr int tries = 9;
    double alone = seconds(1);
    double these = seconds(threads);
    for (int k = 1; k < tries; ++k) {
        alone = std::min(alone, seconds(1));
        these = std::min(these, seconds(threads));
    }
    int iterations = 0;
    for (auto _ : state) {
        iterations = run(threads);
    }
    state.counters["nodes"] = n * n;
    state.counters["threads"] = thread_count();
    state.counters["iterations"] = iterations;
    state.counters["speed_up"] = alone / these; // best of nine runs each
    set_thread_count(0);
}
BENCHMARK(thesis_ten_iterations)
    ->ArgsProduct({{50, 70, 100, 150}, {1, 0}})
    ->ArgNames({"side", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

} // namespace
} // namespace millwright::grid
