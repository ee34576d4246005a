// `millwright gcode pulses`: step and direction pulses of a program, and how uneven a timer makes them.
#pragma once

#include "core/motion/trajectory.h"
#include "core/program/program.h"

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// What the options --steps, --timer, --min-interval and --jitter-limit say.
struct PulseOptions {
    std::vector<std::string> steps; ///< as X=250: steps per mm, or per degree of a rotary axis
    double timer_hz = 1e6;
    std::int64_t min_interval = 2; ///< ticks
    double jitter_limit_us = 0.0;  ///< 0: none
};

void add_pulse_options(CLI::App& command, PulseOptions& options);

/// Prints the report of every axis; 1 if the timer does not keep up with one of them. Throws Error for steps
/// that make no sense. `file` is the program's.
[[nodiscard]] int report_pulses(const motion::Trajectory& trajectory,
                                const program::Program& program,
                                const PulseOptions& options,
                                const std::string& file,
                                bool json);

} // namespace millwright::app
