#include "core/motion/step_pulses.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::motion {

namespace {

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

    /// Adds the pulses of one block as far as `end`, in the order in which they are due.
    void add(const Trajectory& trajectory,
             int block,
             const kinematics::AxisPositions& end,
             std::vector<StepPulse>& pulses) {
        const auto n = static_cast<std::size_t>(block);
        const double from = steps_at(trajectory.path().positions[n]);
        const double to = steps_at(trajectory.path().positions[n + 1]);
        const int direction = to > from ? 1 : -1;
        // The middle that is passed next, while it lies on this block's way.
        for (double middle = next_middle(direction); direction * (steps_at(end) - middle) > 0.0;
             middle = next_middle(direction)) {
            const double fraction = std::clamp((middle - from) / (to - from), 0.0, 1.0);
            add(trajectory.time_at(block, fraction), direction, block, pulses);
        }
    }

    /// Pulses that a block at least needs, to be asked before they are made.
    [[nodiscard]] double pulses_to(const kinematics::AxisPositions& target) const {
        return std::abs(steps_at(target) - static_cast<double>(position_));
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

} // namespace

std::vector<StepJitter> step_pulses(const Trajectory& trajectory,
                                    const StepSettings& settings,
                                    const StepSink& sink,
                                    const Progress& progress) {
    check(trajectory, settings);
    const double most = static_cast<double>(settings.most_pulses_a_block > 0 ? settings.most_pulses_a_block
                                                                             : usual_most_pulses);
    const kinematics::AxisPositions start = trajectory.at(0.0).position;
    const kinematics::AxisPositions end = trajectory.at(trajectory.duration()).position;
    std::vector<Motor> motors;
    for (int n = 0; n < trajectory.axis_count(); ++n) {
        motors.emplace_back(n, settings.steps_per_unit[static_cast<std::size_t>(n)], start[n], settings);
    }
    std::vector<StepPulse> pulses;
    for (int block = trajectory.first_block(); block <= trajectory.last_block(); ++block) {
        progress.check();
        const bool is_last = block == trajectory.last_block();
        const auto after = static_cast<std::size_t>(block) + 1;
        const kinematics::AxisPositions& target = is_last ? end : trajectory.path().positions[after];
        pulses.clear();
        for (Motor& motor : motors) {
            if (motor.pulses_to(target) > most) {
                throw Error(fmt::format("block {} needs {:.0f} pulses", block, motor.pulses_to(target)),
                            {},
                            "fewer steps a unit, or shorter blocks");
            }
            motor.add(trajectory, block, target, pulses);
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
