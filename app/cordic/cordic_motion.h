// Behind the CORDIC processor, on the command line: its records in time, and as step pulses.
#pragma once

#include "core/cordic/processor.h"
#include "core/cordic_machine/cordic_program.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

inline constexpr double usual_jerk = 10'000.0; // mm/s3

/// What the options --profile, --jerk, --steps, --timer, --min-interval and --pulses say.
struct CordicMotionOptions {
    std::string profile;        ///< trapezoid, s-curve; empty: no motion is asked for
    std::optional<double> jerk; ///< mm/s3, of the S-curve; else usual_jerk
    double steps_per_mm = 200.0;
    double timer_hz = 1e6;
    std::int64_t min_interval = 2; ///< ticks
    std::string pulses;            ///< file; empty: none
    std::string servo;             ///< set-points of a servo controller
    double servo_period = 1e-3;    ///< s
};

void add_cordic_motion_options(CLI::App& command, CordicMotionOptions& options);

/// Of one axis.
struct AxisPulses {
    char letter = 'X';
    std::int64_t pulses = 0, reversals = 0, late = 0;
    double max_frequency = 0.0;                ///< planned, Hz
    double given_frequency = 0.0;              ///< by the timer, Hz
    double max_jitter = 0.0, rms_jitter = 0.0; ///< s
    double end_error_steps = 0.0;
};

struct CordicMotionReport {
    double seconds = 0.0;                           ///< of the planned motion
    double max_speed = 0.0, max_acceleration = 0.0; ///< along the path, sampled, mm/s and mm/s2
    std::vector<AxisPulses> axes;
    std::vector<std::string> remarks; ///< sentences
};

/// Plans the motion of the records, writes its pulses and servo set-points to the files that were asked
/// for. Nothing if no motion was asked for. It accelerates as the records say, and by `most_acceleration`
/// mm/s2 at most. Throws Error.
[[nodiscard]] std::optional<CordicMotionReport> move_along(const cordic::Processor& processor,
                                                           const cordic_machine::CordicProgram& made,
                                                           const CordicMotionOptions& options,
                                                           double most_acceleration,
                                                           const std::string& file);

void print(const CordicMotionReport& report);
[[nodiscard]] nlohmann::ordered_json json_of(const CordicMotionReport& report);

} // namespace millwright::app
