#include "app/cordic/cordic_motion.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/cordic_machine/cordic_motion.h"
#include "core/motion/planner.h"
#include "core/motion/step_pulses.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

namespace millwright::app {

namespace {

/// The largest speed and acceleration along the path, at even times.
void sample(const motion::Trajectory& trajectory, CordicMotionReport& report) {
    constexpr int samples = 20'000;
    for (int n = 0; n <= samples; ++n) {
        const motion::Sample at = trajectory.at(trajectory.duration() * n / samples);
        report.max_speed = std::max(report.max_speed, at.velocity.norm());
        report.max_acceleration = std::max(report.max_acceleration, at.acceleration.norm());
    }
}

/// Rows of text that go to their file as they come: a job has gigabytes of them.
class Rows {
public:
    explicit Rows(const std::string& file) : file_(file) {}

    template <class... Values> void add(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
        if (text_.size() >= at_once) {
            flush();
        }
    }
    /// There is no file before this.
    void close() {
        flush();
        file_.close();
    }

private:
    static constexpr std::size_t at_once = 1U << 20U; // bytes
    FileWriter file_;
    std::string text_;

    void flush() {
        file_.write(text_);
        text_.clear();
    }
};

/// Pulses that come later and later lead the axes beside their path.
void refuse_overrun(const std::vector<motion::StepJitter>& axes,
                    const program::Program& program,
                    const CordicMotionOptions& options,
                    const std::string& file) {
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const motion::StepJitter& axis = axes[n];
        if (axis.overrun_block < 0) {
            continue;
        }
        const int line = program.blocks[static_cast<std::size_t>(axis.overrun_block)].source_line;
        throw Error(
            Diagnostic{{file, line, 0, -1},
                       fmt::format("the timer cannot generate the pulses of {}: {:.6g} per second are "
                                   "needed, {:.6g} are possible, and the last ones would be {:.3g} s late",
                                   gcode::axis_letters[n],
                                   axis.max_frequency,
                                   options.timer_hz / static_cast<double>(options.min_interval),
                                   axis.max_jitter),
                       "use a faster --timer, a shorter --min-interval, fewer --steps or a lower feed rate"});
    }
}

std::vector<AxisPulses> pulses_of(const motion::Trajectory& trajectory,
                                  const program::Program& program,
                                  const CordicMotionOptions& options,
                                  const std::string& file) {
    motion::StepSettings settings;
    settings.steps_per_unit.assign(program.axes.size(), options.steps_per_mm);
    settings.timer_frequency = options.timer_hz;
    settings.min_interval = options.min_interval;
    std::optional<Rows> rows;
    if (!options.pulses.empty()) {
        rows.emplace(options.pulses).add("tick,axis,direction,position\n");
    }
    const auto write = [&](std::span<const motion::StepPulse> pulses) {
        for (const motion::StepPulse& pulse : pulses) {
            rows->add("{},{},{},{}\n",
                      pulse.tick,
                      gcode::axis_letters[static_cast<std::size_t>(pulse.axis)],
                      pulse.direction,
                      pulse.position);
        }
    };
    const auto pass_over = [](std::span<const motion::StepPulse>) {};
    const auto found =
        motion::step_pulses(trajectory, settings, rows ? motion::StepSink(write) : pass_over, Progress());
    refuse_overrun(found, program, options, file);
    if (rows) {
        rows->close();
    }
    std::vector<AxisPulses> axes;
    for (std::size_t n = 0; n < found.size(); ++n) {
        const motion::StepJitter& axis = found[n];
        axes.push_back({gcode::axis_letters[n],
                        axis.pulses,
                        axis.reversals,
                        axis.late,
                        axis.max_frequency,
                        axis.given_frequency,
                        axis.max_jitter,
                        axis.rms_jitter,
                        axis.end_error_steps});
    }
    return axes;
}

/// Position, velocity and acceleration of each axis in every period, the end included.
void write_servo(const motion::Trajectory& trajectory, const CordicMotionOptions& options, int axis_count) {
    Rows rows(options.servo);
    rows.add("time");
    for (const char* what : {"", "v", "a"}) {
        for (int axis = 0; axis < axis_count; ++axis) {
            rows.add(",{}{}", what, gcode::axis_letters[static_cast<std::size_t>(axis)]);
        }
    }
    const auto periods = static_cast<std::int64_t>(std::ceil(trajectory.duration() / options.servo_period));
    for (std::int64_t n = 0; n <= periods; ++n) {
        const double time = std::min(static_cast<double>(n) * options.servo_period, trajectory.duration());
        const motion::Sample at = trajectory.at(time);
        rows.add("\n{:.9g}", time);
        for (const kinematics::AxisPositions* values : {&at.position, &at.velocity, &at.acceleration}) {
            for (int axis = 0; axis < axis_count; ++axis) {
                rows.add(",{:.9g}", (*values)[axis]);
            }
        }
    }
    rows.add("\n");
    rows.close();
}

} // namespace

void add_cordic_motion_options(CLI::App& command, CordicMotionOptions& options) {
    CLI::Option* const profile =
        command
            .add_option("--profile",
                        options.profile,
                        "Plan a motion through the set-points with this profile and measure its step pulses")
            ->check(CLI::IsMember({"trapezoid", "s-curve"}));
    command.add_option("--jerk", options.jerk, "Jerk of the S-curve, mm/s3")
        ->check(CLI::Range(1e-3, 1e9))
        ->needs(profile)
        ->default_str(fmt::format("{}", usual_jerk));
    command.add_option("--steps", options.steps_per_mm, "Steps per mm of each axis")
        ->check(CLI::Range(1e-3, 1e6))
        ->needs(profile)
        ->capture_default_str();
    command.add_option("--timer", options.timer_hz, "Frequency of the pulse timer, Hz")
        ->check(CLI::Range(1.0, 1e10))
        ->needs(profile)
        ->capture_default_str();
    command.add_option("--min-interval", options.min_interval, "Minimum ticks between two pulses of an axis")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000}))
        ->needs(profile)
        ->capture_default_str();
    command.add_option("--pulses", options.pulses, "Write the pulses (CSV)")->type_name("FILE");
    CLI::Option* const servo =
        command.add_option("--servo", options.servo, "Write the set-points for a servo controller (CSV)")
            ->type_name("FILE");
    command.add_option("--period", options.servo_period, "Period of the servo controller, s")
        ->check(CLI::Range(1e-6, 10.0))
        ->needs(servo)
        ->capture_default_str();
}

std::optional<CordicMotionReport> move_along(const cordic::Processor& processor,
                                             const cordic_machine::CordicProgram& made,
                                             const CordicMotionOptions& options,
                                             double most_acceleration,
                                             const std::string& file) {
    if (options.profile.empty()) {
        if (!options.pulses.empty() || !options.servo.empty()) {
            throw Error("pulses and servo set-points need a motion profile",
                        {},
                        "give --profile trapezoid or s-curve");
        }
        return std::nullopt;
    }
    const bool s_curve = options.profile == "s-curve";
    if (options.jerk && !s_curve) {
        throw Error("--jerk applies only to --profile s-curve");
    }
    const double jerk = s_curve ? options.jerk.value_or(usual_jerk) : 0.0;
    constexpr double of_no_motion = 1.0;
    const double greatest = std::min(cordic_machine::greatest_acceleration(processor), most_acceleration);
    const auto machine = cordic_machine::cordic_machine(greatest > 0.0 ? greatest : of_no_motion, jerk);
    const kinematics::AxisPositions start = kinematics::AxisPositions::Zero(machine.axis_count());
    const auto [program, accelerations] =
        cordic_machine::cordic_motion(processor, made, machine, start, file, most_acceleration);
    const motion::Trajectory trajectory =
        motion::plan_within(program, accelerations, machine, {}, Progress());
    CordicMotionReport report;
    if (std::isfinite(most_acceleration) && most_acceleration > greatest) {
        report.remarks.push_back(fmt::format(
            "--acceleration exceeds the program's own Amax, which applies: {:.6g} mm/s2", greatest));
    }
    report.seconds = trajectory.duration();
    sample(trajectory, report);
    report.axes = pulses_of(trajectory, program, options, file);
    if (!options.servo.empty()) {
        write_servo(trajectory, options, machine.axis_count());
    }
    return report;
}

void print(const CordicMotionReport& report) {
    fmt::print("motion: {:.6g} s, up to {:.6g} mm/s and {:.6g} mm/s2\n",
               report.seconds,
               report.max_speed,
               report.max_acceleration);
    for (const AxisPulses& axis : report.axes) {
        fmt::print("{}: {} up to {:.6g} Hz, output at up to {:.6g} Hz, {}, jitter {:.3g} us at most, {:.3g} "
                   "us RMS, {} late\n",
                   axis.letter,
                   counted(axis.pulses, "pulse"),
                   axis.max_frequency,
                   axis.given_frequency,
                   counted(axis.reversals, "reversal"),
                   1e6 * axis.max_jitter,
                   1e6 * axis.rms_jitter,
                   axis.late);
    }
}

nlohmann::ordered_json json_of(const CordicMotionReport& report) {
    nlohmann::ordered_json answer;
    answer["time_s"] = report.seconds;
    answer["max_speed_mm_s"] = report.max_speed;
    answer["max_acceleration_mm_s2"] = report.max_acceleration;
    for (const AxisPulses& axis : report.axes) {
        answer["axes"].push_back({{"axis", std::string(1, axis.letter)},
                                  {"pulses", axis.pulses},
                                  {"reversals", axis.reversals},
                                  {"max_frequency_hz", axis.max_frequency},
                                  {"given_frequency_hz", axis.given_frequency},
                                  {"max_jitter_s", axis.max_jitter},
                                  {"rms_jitter_s", axis.rms_jitter},
                                  {"late", axis.late},
                                  {"end_error_steps", axis.end_error_steps}});
    }
    return answer;
}

} // namespace millwright::app
