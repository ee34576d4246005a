#include "core/motion/step_pulses.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/motion/internal/axis_way.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::motion {

namespace {

using internal::Part;

constexpr std::int64_t usual_most_pulses = 10'000'000; // a block: 400 MB
constexpr double farthest = 1e15;                      // steps: as integers still exact in a double

void check(const Trajectory& trajectory, const StepSettings& settings) {
    if (std::ssize(settings.steps_per_unit) != trajectory.axis_count()) {
        throw Error(fmt::format("steps a unit are given for {} axes, the motion has {}",
                                settings.steps_per_unit.size(),
                                trajectory.axis_count()));
    }
    for (const double steps : settings.steps_per_unit) {
        if (!(steps > 0.0 && std::isfinite(steps))) {
            throw Error(fmt::format("{} steps a unit is not a positive number", steps));
        }
    }
    if (!(settings.timer_frequency > 0.0 && std::isfinite(settings.timer_frequency))) {
        throw Error(fmt::format("a timer of {} Hz does not tick", settings.timer_frequency));
    }
    if (settings.min_interval < 1 || settings.jitter_limit < 0.0 || settings.most_pulses_a_block < 0) {
        throw Error("interval, jitter limit and number of pulses are not negative, the interval not zero");
    }
}

/// One axis with its motor.
class Motor {
public:
    Motor(int axis, double steps_per_unit, double start, const StepSettings& settings)
        : axis_(axis), steps_per_unit_(steps_per_unit), settings_(settings), position_(nearest_step(start)) {}

    /// Adds the pulses of a part of one block, in the order in which they are due.
    void add(const Trajectory& trajectory, int block, const Part& part, std::vector<StepPulse>& pulses) {
        const Path& path = trajectory.path();
        const double length = path.segments[static_cast<std::size_t>(block)].length;
        for (const Part& piece : internal::monotone_parts(path, block, axis_, part)) {
            const double end = steps_at(path.at(block, piece.end).position);
            const int direction = end > steps_at(path.at(block, piece.begin).position) ? 1 : -1;
            check_number(block, std::abs(end - static_cast<double>(position_)));
            // The middle that is passed next, while it lies on this piece.
            for (double middle = next_middle(direction); direction * (end - middle) > 0.0;
                 middle = next_middle(direction)) {
                const double offset =
                    internal::offset_of(path, block, axis_, piece, middle / steps_per_unit_);
                add(trajectory.time_at(block, offset / length), direction, block, pulses);
            }
        }
    }

    [[nodiscard]] StepJitter report(const kinematics::AxisPositions& end) const {
        StepJitter report = report_;
        report.rms_jitter =
            report.pulses > 0 ? std::sqrt(squares_ / static_cast<double>(report.pulses)) : 0.0;
        report.end_error_steps = steps_at(end) - static_cast<double>(position_);
        return report;
    }

private:
    int axis_;
    double steps_per_unit_;
    const StepSettings& settings_;
    std::int64_t position_;
    StepJitter report_{};
    double squares_ = 0.0; ///< of the jitter
    int last_direction_ = 0;
    double last_due_ = 0.0;
    std::int64_t last_tick_ = 0;

    [[nodiscard]] double steps_at(const kinematics::AxisPositions& q) const {
        return q[axis_] * steps_per_unit_;
    }
    [[nodiscard]] std::int64_t nearest_step(double position) const {
        const double steps = position * steps_per_unit_;
        if (!(std::abs(steps) < farthest)) {
            throw Error(fmt::format("axis {} is {} steps away from its zero", axis_, steps));
        }
        return std::llround(steps);
    }
    [[nodiscard]] double next_middle(int direction) const {
        return static_cast<double>(position_) + 0.5 * direction;
    }

    void check_number(int block, double pulses) const {
        const double most = static_cast<double>(
            settings_.most_pulses_a_block > 0 ? settings_.most_pulses_a_block : usual_most_pulses);
        if (pulses > most) {
            throw Error(fmt::format("block {} needs {:.0f} pulses", block, pulses),
                        {},
                        "fewer steps a unit, or shorter blocks");
        }
    }

    void add(double due, int direction, int block, std::vector<StepPulse>& pulses) {
        std::int64_t tick = std::llround(due * settings_.timer_frequency);
        if (report_.pulses > 0) {
            const std::int64_t earliest = last_tick_ + settings_.min_interval;
            report_.late += tick < earliest ? 1 : 0;
            tick = std::max(tick, earliest);
            if (due > last_due_) {
                report_.max_frequency = std::max(report_.max_frequency, 1.0 / (due - last_due_));
            }
            report_.reversals += direction != last_direction_ ? 1 : 0;
        }
        const double jitter = std::abs(static_cast<double>(tick) / settings_.timer_frequency - due);
        report_.max_jitter = std::max(report_.max_jitter, jitter);
        report_.over_limit += settings_.jitter_limit > 0.0 && jitter > settings_.jitter_limit ? 1 : 0;
        squares_ += square(jitter);
        ++report_.pulses;
        position_ += direction;
        last_direction_ = direction;
        last_due_ = due;
        last_tick_ = tick;
        pulses.push_back({tick, due, axis_, direction, position_, block});
    }
};

/// What of a block the trajectory executes.
Part executed_part(const Trajectory& trajectory, int block) {
    const double length = trajectory.path().segments[static_cast<std::size_t>(block)].length;
    Part part{0.0, length};
    if (block == trajectory.first_block()) {
        part.begin = trajectory.at(0.0).block == block ? trajectory.at(0.0).fraction * length : length;
    }
    if (block == trajectory.last_block()) {
        part.end = trajectory.at(trajectory.duration()).fraction * length;
    }
    return part;
}

} // namespace

std::vector<StepJitter> step_pulses(const Trajectory& trajectory,
                                    const StepSettings& settings,
                                    const StepSink& sink,
                                    const Progress& progress) {
    check(trajectory, settings);
    const kinematics::AxisPositions start = trajectory.at(0.0).position;
    const kinematics::AxisPositions end = trajectory.at(trajectory.duration()).position;
    std::vector<Motor> motors;
    for (int n = 0; n < trajectory.axis_count(); ++n) {
        motors.emplace_back(n, settings.steps_per_unit[static_cast<std::size_t>(n)], start[n], settings);
    }
    std::vector<StepPulse> pulses;
    for (int block = trajectory.first_block(); block <= trajectory.last_block(); ++block) {
        progress.check();
        const Part part = executed_part(trajectory, block);
        pulses.clear();
        for (Motor& motor : motors) {
            motor.add(trajectory, block, part, pulses);
        }
        std::ranges::stable_sort(pulses, {}, &StepPulse::tick);
        sink(pulses);
        progress.report(static_cast<double>(block + 1) / trajectory.block_count());
    }
    std::vector<StepJitter> reports;
    for (const Motor& motor : motors) {
        reports.push_back(motor.report(end));
    }
    return reports;
}

} // namespace millwright::motion
