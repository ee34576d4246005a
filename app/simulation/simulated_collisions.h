// Collisions of a simulated program: the bodies of its machine, its fixtures and its part, and what was
// found.
#pragma once

#include "app/simulation/simulated_work.h"
#include "core/simulation/collision.h"
#include "core/simulation/simulation.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::app {

/// Where a fixture lies.
struct FixtureText {
    std::filesystem::path file;
    Vec3 shift = Vec3::Zero(); ///< mm
};
/// FILE[@X,Y,Z]. Throws Error for anything else.
[[nodiscard]] FixtureText parse_fixture(const std::string& text);

/// The part of a mesh file. Throws Error, Cancelled.
void add_part(const std::filesystem::path& file, SimulatedWork& work, const Progress& progress);

/// The bodies of the machine as the window draws them, and the fixtures. Throws Error with the file for an
/// open fixture, one that looks inwards, and one that lies in the table.
void take_bodies(const SimulateOptions& options, SimulatedWork& work, const Progress& progress);

/// `input` is what was simulated, with what was `found`. Throws Cancelled.
[[nodiscard]] simulation::CollisionReport collisions_of(const SimulatedWork& work,
                                                        const SimulateOptions& options,
                                                        const simulation::SimulationInput& input,
                                                        const simulation::Simulation& found,
                                                        const Progress& progress);

/// Whether anything collides: contacts, shank and holder in the stock, axes beyond their limits.
[[nodiscard]] bool collides(const simulation::CollisionReport& report, const simulation::Simulation& found);

/// The member "collisions" of a report. docs/reference/simulation.md has the fields.
[[nodiscard]] nlohmann::ordered_json collisions_json(const SimulatedWork& work,
                                                     const simulation::CollisionReport& report,
                                                     const simulation::Simulation& found,
                                                     double clearance);

/// What collides on standard error, the first of each kind with its line; the rest on standard output.
void print_collisions(const SimulatedWork& work,
                      const simulation::CollisionReport& report,
                      const simulation::Simulation& found);

} // namespace millwright::app
