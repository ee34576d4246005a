// Motion programs of a PMAC without one: what the card would refuse, line by line, and what its motors would
// do, by the emulated card in time of its own.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/jobs/job.h"
#include "core/pmac/driver/pmac_settings.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac {

/// A line of a motion program without its comment.
struct MotionLine {
    int number = 0; ///< in the text, from 1
    std::string text;
};

/// Lines that the card would be sent; ';' begins a comment. Throws Error with the place of a character that
/// is no text.
[[nodiscard]] std::vector<MotionLine> motion_lines(std::string_view text, const std::filesystem::path& named);

/// What the card would refuse, in the order of the lines; empty if it takes all of them.
[[nodiscard]] std::vector<Diagnostic> motion_program_faults(std::string_view text,
                                                            const std::filesystem::path& named);

/// A job of a motion program, each of its lines a block, comments left out. Throws Error with the first
/// fault.
[[nodiscard]] jobs::Job motion_program_job(std::string_view text, const std::filesystem::path& named);

struct MotionRecord {
    double time = 0.0;             ///< s since the start
    std::vector<double> degrees{}; ///< of each axis of the settings, as commanded
};

struct MotionSimulation {
    std::vector<MotionRecord> records; ///< every `step`, and the end
    double duration = 0.0;             ///< s of the card's time
    std::vector<Diagnostic> faults; ///< lines that were refused, or how the run broke off; then the records
                                    ///< are what came before
    std::optional<Diagnostic> beyond_limits{}; ///< when which axis leaves its limits; a fault, too
};

struct MotionSimulationSettings {
    PmacSettings card;
    std::vector<double> start_deg{}; ///< of each axis; empty: 0
    double step = 0.02;              ///< s between two records, > 0
    double longest = 1800.0;         ///< s of the card's time after which a program counts as endless
};

/// Runs it on an emulated card with the factory's protections, until an axis leaves its limits. What it
/// throws is Canceled alone, and what motion_lines() throws.
[[nodiscard]] MotionSimulation simulate_motion_program(std::string_view text,
                                                       const std::filesystem::path& named,
                                                       const MotionSimulationSettings& settings,
                                                       const Progress& progress);

} // namespace millwright::pmac
