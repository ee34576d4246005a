// What a simulation found, as JSON and in a few lines for people. docs/reference/simulation.md has the
// fields.
#pragma once

#include "app/simulation/simulated_work.h"
#include "core/simulation/collision.h"
#include "core/simulation/cut_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

/// What is left against the part.
struct ComparedPart {
    std::vector<simulation::Deviation> deviations; ///< one per point of the part
    simulation::ComparisonSummary summary;
    double tolerance = 0.0; ///< mm
};

struct SimulationCost {
    double seconds = 0.0; ///< on the clock
    int threads = 1;
};

[[nodiscard]] std::string simulation_report_text(const SimulatedWork& work,
                                                 const simulation::Simulation& found,
                                                 const simulation::CutMesh& mesh,
                                                 const std::optional<ComparedPart>& compared,
                                                 const simulation::CollisionReport& collisions,
                                                 double clearance,
                                                 const SimulationCost& cost);

/// On standard output; warnings and findings on standard error.
void print_simulation(const SimulatedWork& work,
                      const simulation::Simulation& found,
                      const std::optional<ComparedPart>& compared,
                      const simulation::CollisionReport& collisions,
                      const SimulationCost& cost);

/// Rapid moves in material.
[[nodiscard]] std::size_t rapid_count(const simulation::Simulation& found);

} // namespace millwright::app
