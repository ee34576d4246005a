#include "core/simulation/simulation.h"

#include "core/simulation/simulator.h"

#include <utility>

namespace millwright::simulation {

Simulation simulate(const SimulationInput& input, const Progress& progress) {
    constexpr double filled = 0.05, cut = 0.95;
    Simulator simulator(input, Rewind::none, progress.part(0.0, filled));
    simulator.advance_to(input.program.block_count(), progress.part(filled, cut));
    Simulation result = std::move(simulator).finish();
    progress.report(1.0);
    return result;
}

} // namespace millwright::simulation
