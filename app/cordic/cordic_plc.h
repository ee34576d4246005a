// What millwright cordic run adds where a machine's logic is given: the processor at work beside it.
#pragma once

#include "core/cordic_control/supervised_run.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <span>
#include <string>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

struct CordicPlcOptions {
    std::string logic;  ///< instruction list; empty: there is none
    std::string inputs; ///< when they change; empty: never
    double scan_ms = 1.0;
    int records_ahead = 4;
    double most_seconds = 3600.0;
};

void add_cordic_plc_options(CLI::App& command, CordicPlcOptions& options);

/// Runs `processor`, whose program `file` it is, with the logic. Throws Error, after printing what else is
/// wrong, for what does not assemble.
[[nodiscard]] cordic::SupervisedRun run_with_logic(cordic::Processor& processor,
                                                   std::span<const cordic::CodeLine> lines,
                                                   const std::filesystem::path& file,
                                                   const CordicPlcOptions& options,
                                                   double clock_hz);

void print(const cordic::SupervisedRun& run);
[[nodiscard]] nlohmann::ordered_json json_of(const cordic::SupervisedRun& run);

} // namespace millwright::app
