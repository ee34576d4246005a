#include "core/motion/step_pulses.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/motion/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace millwright::motion {
namespace {

// One axis on its way through a block: where it turns back, and where it has a given position.

/// A part of a block's way, as offsets into it.
struct Part {
    double begin = 0.0, end = 0.0;
};

double position_at(const Path& path, int block, int axis, double offset) {
    return path.at(block, offset).position[axis];
}

/// Bisection to the last bit: where `rises` in [begin, end] passes from false to true.
template <class Passed> double place_of(double begin, double end, Passed passed) {
    for (;;) {
        const double middle = 0.5 * (begin + end);
        if (!(middle > begin && middle < end)) {
            return middle;
        }
        (passed(middle) ? end : begin) = middle;
    }
}

/// Cuts a rounding where the axis stands still for a moment.
void add_rounding(const Path& path, int block, int axis, const Part& part, std::vector<Part>& parts) {
    const double in = path.at(block, part.begin).first[axis];
    const double out = path.at(block, part.end).first[axis];
    if (in * out < 0.0) {
        const double turn = place_of(part.begin, part.end, [&](double offset) {
            return path.at(block, offset).first[axis] * in < 0.0;
        });
        parts.push_back({part.begin, turn});
        parts.push_back({turn, part.end});
    } else {
        parts.push_back(part);
    }
}

/// The part of a block between two offsets, cut so that the axis only rises or only falls on each piece, and
/// goes linearly on a piece without a rounding.
std::vector<Part> monotone_parts(const Path& path, int block, int axis, const Part& whole) {
    const Segment& segment = path.segments[static_cast<std::size_t>(block)];
    std::vector<Part> parts;
    const auto inside = [&](double begin, double end) {
        return Part{std::max(begin, whole.begin), std::min(end, whole.end)};
    };
    const double straight_end = segment.length - segment.rounding_end;
    if (const Part in = inside(0.0, segment.rounding_start); in.begin < in.end) {
        add_rounding(path, block, axis, in, parts);
    }
    if (const Part straight = inside(segment.rounding_start, straight_end); straight.begin < straight.end) {
        parts.push_back(straight);
    }
    if (const Part out = inside(straight_end, segment.length);
        out.begin < out.end && segment.rounding_end > 0.0) {
        add_rounding(path, block, axis, out, parts);
    }
    return parts;
}

/// Where on a monotone part the axis is at `position`, which must lie between its ends.
double offset_of(const Path& path, int block, int axis, const Part& part, double position) {
    const Segment& segment = path.segments[static_cast<std::size_t>(block)];
    const double from = position_at(path, block, axis, part.begin);
    const double to = position_at(path, block, axis, part.end);
    if (!(part.begin < segment.rounding_start) && !(part.end > segment.length - segment.rounding_end)) {
        const double share = std::clamp((position - from) / (to - from), 0.0, 1.0);
        return std::lerp(part.begin, part.end, share);
    }
    const double sense = to > from ? 1.0 : -1.0;
    return place_of(part.begin, part.end, [&](double offset) {
        return sense * (position_at(path, block, axis, offset) - position) > 0.0;
    });
}

constexpr std::int64_t usual_most_pulses = 1'000'000'000; // a block: minutes of computing
constexpr std::size_t handed_over = 4096;                 // pulses at once
constexpr double farthest = 1e15;                         // steps: as integers still exact in a double

void check(const Trajectory& trajectory, const StepSettings& settings) {
    if (std::ssize(settings.steps_per_unit) != trajectory.axis_count()) {
        throw Error(fmt::format("steps per unit are given for {} axes, but the motion has {}",
                                settings.steps_per_unit.size(),
                                trajectory.axis_count()));
    }
    for (const double steps : settings.steps_per_unit) {
        if (!(steps > 0.0 && std::isfinite(steps))) {
            throw Error(fmt::format("{} steps per unit is not a positive number", steps));
        }
    }
    if (!(settings.timer_frequency > 0.0 && std::isfinite(settings.timer_frequency))) {
        throw Error(fmt::format("the timer frequency of {} Hz must be positive", settings.timer_frequency));
    }
    if (settings.min_interval < 1 || settings.jitter_limit < 0.0 || settings.most_pulses_per_block < 0) {
        throw Error(
            "the interval must be above 0; the jitter limit and the number of pulses must not be negative");
    }
}

/// One axis with its motor.
class Motor {
public:
    Motor(int axis, double steps_per_unit, double start, const StepSettings& settings)
        : axis_(axis), steps_per_unit_(steps_per_unit), settings_(settings), position_(nearest_step(start)) {}

    /// Begins with a part of a block.
    void enter(const Trajectory& trajectory, int block, const Part& part) {
        const Path& path = trajectory.path();
        trajectory_ = &trajectory;
        block_ = block;
        length_ = path.segments[static_cast<std::size_t>(block)].length;
        pieces_ = monotone_parts(path, block, axis_, part);
        piece_ = 0;
        enter_piece();
    }

    /// The pulse that is due next there; nothing behind the last one.
    std::optional<StepPulse> next() {
        while (piece_ < pieces_.size()) {
            const double middle = static_cast<double>(position_) + 0.5 * direction_;
            if (direction_ * (end_ - middle) > 0.0) {
                const double offset =
                    offset_of(trajectory_->path(), block_, axis_, pieces_[piece_], middle / steps_per_unit_);
                return pulse(trajectory_->time_at(block_, offset / length_));
            }
            ++piece_;
            enter_piece();
        }
        return std::nullopt;
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
    // Where it is on its way:
    const Trajectory* trajectory_ = nullptr;
    int block_ = 0;
    double length_ = 0.0;      ///< of the block
    std::vector<Part> pieces_; ///< of the block, on each of which the axis goes one way
    std::size_t piece_ = 0;
    double end_ = 0.0;  ///< of the piece, steps
    int direction_ = 1; ///< on it

    void enter_piece() {
        if (piece_ < pieces_.size()) {
            const Path& path = trajectory_->path();
            const Part& piece = pieces_[piece_];
            end_ = steps_at(path.at(block_, piece.end).position);
            direction_ = end_ > steps_at(path.at(block_, piece.begin).position) ? 1 : -1;
            check_number(block_, std::abs(end_ - static_cast<double>(position_)));
        }
    }

    [[nodiscard]] double steps_at(const kinematics::AxisPositions& q) const {
        return q[axis_] * steps_per_unit_;
    }
    [[nodiscard]] std::int64_t nearest_step(double position) const {
        const double steps = position * steps_per_unit_;
        if (!(std::abs(steps) < farthest)) {
            throw Error(fmt::format("axis {} is {} steps from its zero, which is too far", axis_, steps));
        }
        return std::llround(steps);
    }
    void check_number(int block, double pulses) const {
        const double most = static_cast<double>(
            settings_.most_pulses_per_block > 0 ? settings_.most_pulses_per_block : usual_most_pulses);
        if (pulses > most) {
            throw Error(
                fmt::format(
                    "block {} needs {:.0f} pulses on one axis, more than {:.0f}", block, pulses, most),
                {},
                "use fewer steps per unit, or shorter blocks");
        }
    }

    StepPulse pulse(double due) {
        std::int64_t tick = std::llround(due * settings_.timer_frequency);
        if (report_.pulses > 0) {
            const std::int64_t earliest = last_tick_ + settings_.min_interval;
            report_.late += tick < earliest ? 1 : 0;
            tick = std::max(tick, earliest);
            if (direction_ == last_direction_ && due > last_due_) {
                report_.max_frequency = std::max(report_.max_frequency, 1.0 / (due - last_due_));
                report_.given_frequency =
                    std::max(report_.given_frequency,
                             settings_.timer_frequency / static_cast<double>(tick - last_tick_));
            }
            report_.reversals += direction_ != last_direction_ ? 1 : 0;
        }
        const double jitter = std::abs(static_cast<double>(tick) / settings_.timer_frequency - due);
        report_.max_jitter = std::max(report_.max_jitter, jitter);
        report_.over_limit += settings_.jitter_limit > 0.0 && jitter > settings_.jitter_limit ? 1 : 0;
        const bool overruns =
            jitter * settings_.timer_frequency > static_cast<double>(settings_.min_interval + 1);
        report_.overrun_block = overruns && report_.overrun_block < 0 ? block_ : report_.overrun_block;
        squares_ += square(jitter);
        ++report_.pulses;
        position_ += direction_;
        last_direction_ = direction_;
        last_due_ = due;
        last_tick_ = tick;
        return {tick, due, axis_, direction_, position_, block_};
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

/// The pulses of all motors on their way through a block, in the order of their ticks; of equal ticks, axis
/// by axis. Only the next pulse of each motor is in memory, and what is handed over at once.
void merge(std::vector<Motor>& motors, const StepSink& sink, const Progress& progress) {
    std::vector<std::optional<StepPulse>> heads;
    for (Motor& motor : motors) {
        heads.push_back(motor.next());
    }
    const auto tick_of = [](const std::optional<StepPulse>& head) {
        return head ? head->tick : std::numeric_limits<std::int64_t>::max();
    };
    std::vector<StepPulse> pulses;
    for (auto first = std::ranges::min_element(heads, {}, tick_of); first->has_value();
         first = std::ranges::min_element(heads, {}, tick_of)) {
        pulses.push_back(**first);
        *first = motors[static_cast<std::size_t>(first - heads.begin())].next();
        if (pulses.size() >= handed_over) {
            progress.check();
            sink(pulses);
            pulses.clear();
        }
    }
    sink(pulses);
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
    for (int block = trajectory.first_block(); block <= trajectory.last_block(); ++block) {
        progress.check();
        const Part part = executed_part(trajectory, block);
        for (Motor& motor : motors) {
            motor.enter(trajectory, block, part);
        }
        merge(motors, sink, progress);
        progress.report(static_cast<double>(block + 1) / trajectory.block_count());
    }
    std::vector<StepJitter> reports;
    for (const Motor& motor : motors) {
        reports.push_back(motor.report(end));
    }
    return reports;
}

} // namespace millwright::motion
