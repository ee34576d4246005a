// What `millwright simulate` simulates: a project's program or a G-code file, with machine, tools and stock.
#pragma once

#include "core/base/progress.h"
#include "core/gcode/reader_settings.h"
#include "core/kinematics/machine_model.h"
#include "core/plan/part_surface.h"
#include "core/program/program.h"
#include "core/simulation/collision_bodies.h"
#include "core/simulation/simulation.h"

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace millwright::app {

struct SimulateOptions {
    std::string file;
    std::string machine; ///< of a G-code file; empty: not given
    std::string stock;   ///< empty: by the part, of a project
    std::vector<std::string> tools;
    std::vector<double> origin;
    std::string dialect;                  ///< of a G-code file; empty: "linuxcnc"
    std::vector<std::string> subroutines; ///< folders
    bool block_delete = false;
    std::optional<double> resolution; ///< mm; nullopt: by the size of the stock
    double memory_mb = 1000.0;
    std::string part;       ///< a mesh to compare with; empty: of a project the machined face
    double tolerance = 0.1; ///< of the comparison, mm
    std::vector<std::string> fixtures;
    std::vector<std::string> flutes; ///< [N=]LENGTH
    double clearance = 1.0;          ///< nearer bodies are near misses, mm
    std::string out;
};

struct SimulatedWork {
    std::filesystem::path file;         ///< as it was named
    std::filesystem::path program_file; ///< whose lines the blocks have: of a project the one that is written
    std::string program_text;           ///< of a project: to be written there
    kinematics::MachineModel machine;
    program::Program program; ///< blocks know their lines
    std::vector<simulation::ToolUse> tools;
    std::vector<std::string> tool_texts; ///< one per tool, as it was given
    simulation::Stock stock;
    std::string stock_text;
    std::vector<std::string> warnings;       ///< a sentence each
    std::optional<plan::PartSurface> part{}; ///< what is left is compared with
    std::filesystem::path machine_file{};
    std::vector<simulation::CollisionBody> bodies{}; ///< of machine, fixtures, part and stock
};

/// The files that the options name.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const SimulateOptions& options);

/// Throws Error with the first thing that is wrong, UsageError for options that do not fit the file;
/// Cancelled.
[[nodiscard]] SimulatedWork simulated_work(const SimulateOptions& options, const std::stop_token& stop);

} // namespace millwright::app
