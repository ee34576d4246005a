// What a simulation found, as JSON and in a few lines for people. docs/reference/simulation.md has the
// fields.
#pragma once

#include "app/simulated_work.h"
#include "core/simulation/cut_mesh.h"

#include <string>

namespace millwright::app {

struct SimulationCost {
    double seconds = 0.0; ///< on the clock
    int threads = 1;
};

[[nodiscard]] std::string simulation_report_text(const SimulatedWork& work,
                                                 const simulation::Simulation& found,
                                                 const simulation::CutMesh& mesh,
                                                 const SimulationCost& cost);

/// On standard output; warnings and findings on standard error.
void print_simulation(const SimulatedWork& work,
                      const simulation::Simulation& found,
                      const SimulationCost& cost);

/// Rapid moves in material: those that make the exit code 1.
[[nodiscard]] std::size_t rapid_count(const simulation::Simulation& found);

} // namespace millwright::app
