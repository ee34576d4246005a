// The thesis's iteration against multigrid, to the same norm on the same grids in one run, and how the time
// of multigrid grows with the nodes. The weight is the thesis's circle W1, as wide on every grid as on 25
// x 25. The thesis's tables of time: `millwright study run-time`.
#include "core/grid/jacobi_newton.h"
#include "core/grid/multigrid.h"

#include <benchmark/benchmark.h>

#include <cstdint>

namespace millwright::grid {
namespace {

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
    const WeightPtr weight = weight_w1_on(n);
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

} // namespace
} // namespace millwright::grid
