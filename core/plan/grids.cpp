#include "core/plan/grids.h"

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/project/grid_methods/grid_method_row.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace millwright::plan {

namespace {

double megabytes(std::size_t bytes) {
    constexpr double bytes_per_megabyte = 1e6;
    return std::ceil(static_cast<double>(bytes) / bytes_per_megabyte);
}

} // namespace

std::string memory_sentence(project::GridMethod method, const project::GridInput& input) {
    const project::GridMethodRow& row = row_of(method);
    return row.memory == nullptr ? std::string()
                                 : fmt::format("The {} of {} x {} nodes needs up to {:.0f} MB",
                                               row.grid_name,
                                               input.nu,
                                               input.nv,
                                               megabytes(row.memory(input)));
}

std::optional<Diagnostic> memory_fault(project::GridMethod method,
                                       const project::GridInput& input,
                                       const std::optional<std::size_t>& free) {
    const auto memory = row_of(method).memory;
    if (memory == nullptr || !free || memory(input) <= *free / 2) {
        return std::nullopt;
    }
    return Diagnostic{{},
                      fmt::format("{}, more than half of the {:.0f} MB of free memory",
                                  memory_sentence(method, input),
                                  megabytes(*free)),
                      "use fewer nodes or another solver, or allow it: grid/elliptic/any_memory, "
                      "--any-memory, \"Allow high memory\" in the Grid workspace"};
}

void expect_memory(project::GridMethod method, const project::GridInput& input) {
    if (auto fault = memory_fault(method, input, free_memory()); fault && !input.elliptic.any_memory) {
        throw Error(*std::move(fault));
    }
}

std::unique_ptr<grid::GridOptimiser> make_optimiser(project::GridMethod method,
                                                    const project::GridInput& input,
                                                    const toolpath::KinematicError& error,
                                                    Effort effort,
                                                    const std::optional<grid::Grid>& given) {
    expects(row_of(method).optimiser != nullptr, "the uniform grid is not optimised");
    expect_memory(method, input);
    grid::Grid start = given ? *given : grid::Grid::uniform(input.nu, input.nv);
    expects(start.nu() == input.nu && start.nv() == input.nv, "a start grid has nu x nv nodes");
    return row_of(method).optimiser({input, error, std::move(start), effort});
}

GridOutcome uniform_outcome(const project::GridInput& input) {
    return {grid::Grid::uniform(input.nu, input.nv)};
}

GridOutcome improved_outcome(grid::GridOptimiser& optimiser, const Progress& progress) {
    const grid::OptimiserState state = grid::run(optimiser, progress);
    progress.report(1.0);
    return {state.best,
            state.status,
            state.round,
            state.iteration,
            state.norm,
            state.start,
            state.of_best,
            state.note,
            state.warning,
            state.stages,
            state.norms};
}

} // namespace millwright::plan
