#include "core/motion/internal/axis_path.h"

#include "core/base/error.h"
#include "core/motion/internal/planned_move.h"
#include "core/motion/internal/rounding_choice.h"
#include "core/motion/override.h"
#include "core/motion/time_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace millwright::motion::internal {

using kinematics::AxisPositions;
using program::Block;
using program::BlockKind;

namespace {

/// No motion is faster along the way: its direction is of length 1 in scaled axes.
double greatest_speed(const std::vector<AxisLimits>& limits) {
    double squares = 0.0;
    for (const AxisLimits& axis : limits) {
        squares += axis.velocity / axis.acceleration * (axis.velocity / axis.acceleration);
    }
    return std::sqrt(squares);
}

/// Of the last `d` of a move.
double slowest_at_end(const PlannedMove& move, double d) {
    double slowest = std::numeric_limits<double>::infinity();
    for (const FeedStep& step : move.feed) {
        slowest = step.end > move.length - d ? std::min(slowest, step.speed) : slowest;
    }
    return slowest;
}

/// Of the first `d`.
double slowest_at_begin(const PlannedMove& move, double d) {
    double slowest = std::numeric_limits<double>::infinity();
    double begin = 0.0;
    for (const FeedStep& step : move.feed) {
        slowest = begin < d ? std::min(slowest, step.speed) : slowest;
        begin = step.end;
    }
    return slowest;
}

/// The speeds that the program asks for on both halves of a rounding. Of linear axes each half has that of
/// its own move, as far as the blended direction is no faster than the faster move. A turn of rotary axes may
/// take the tip farther than either move: there both halves have the lower one.
std::pair<double, double>
feeds_of_halves(const Mechanism& machine, const PlannedMove& last, const PlannedMove& next, double d) {
    const double before = slowest_at_end(last, d);
    const double after = slowest_at_begin(next, d);
    const bool turns = std::ranges::any_of(machine.rotary_axes(), [&](int n) {
        return std::abs(last.direction[n]) > 0.0 || std::abs(next.direction[n]) > 0.0;
    });
    if (turns) {
        return {std::min(before, after), std::min(before, after)};
    }
    const double rate_before = machine.linear_length(last.direction); // mm by the way
    const double rate_after = machine.linear_length(next.direction);
    const double fastest = std::max(before * rate_before, after * rate_after);
    const auto within = [&](double own, double own_rate, double other_rate) {
        return std::min(own, fastest / (0.5 * (own_rate + std::max(own_rate, other_rate))));
    };
    return {within(before, rate_before, rate_after), within(after, rate_after, rate_before)};
}

template <class Places> void drop_up_to(Places& places, double way) {
    const auto kept = std::ranges::upper_bound(places, way, {}, [](const auto& place) { return place.end; });
    places.erase(places.begin(), kept);
}

} // namespace

bool keeps_moving(BlockKind kind) {
    return kind == BlockKind::comment || kind == BlockKind::rapid || kind == BlockKind::feed;
}

Meeting meeting_of(const program::PathControl& last_path,
                   const AxisPositions& last_unit,
                   bool last_rapid,
                   const AxisPositions& next_unit,
                   bool next_rapid) {
    constexpr double straight = 1e-15; // rounding of a unit vector
    const bool turns = (next_unit - last_unit).cwiseAbs().maxCoeff() > straight;
    const bool rounded = last_path.mode == program::PathMode::continuous && turns;
    if (last_path.mode == program::PathMode::exact_stop || (rounded && last_rapid != next_rapid)) {
        return Meeting::rest;
    }
    return rounded ? Meeting::rounding : Meeting::corner;
}

double rounding_tolerance_of(const program::PathControl& path, const PlannerSettings& settings) {
    return path.tolerance > 0.0 ? path.tolerance : settings.rounding_tolerance;
}

void check_axes(const std::vector<program::ProgramAxis>& axes,
                const std::string& machine_of_program,
                const Mechanism& machine) {
    std::string wanted;
    std::string there;
    bool same = static_cast<int>(axes.size()) == machine.axis_count();
    for (int n = 0; n < static_cast<int>(axes.size()); ++n) {
        const program::ProgramAxis& axis = axes[static_cast<std::size_t>(n)];
        wanted += axis.letter;
        same = same && axis.letter == machine.axis(n).letter && axis.kind == machine.axis(n).kind;
    }
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        there += axis.letter;
    }
    if (!same) {
        throw Error(fmt::format("the program is for axes {} of '{}', but the machine '{}' has {}",
                                wanted,
                                machine_of_program,
                                machine.name(),
                                there));
    }
}

void check_settings(const PlannerSettings& settings, const Mechanism& machine, const AxisPositions& start) {
    expects(start.size() == machine.axis_count() && start.allFinite(),
            "a start has a finite position for each axis");
    expects(settings.corner_time >= 0.0 && settings.junction_deviation >= 0.0,
            "a corner time and a junction deviation are not negative");
    expects(settings.rounding_tolerance > 0.0 && settings.rounding_angle > 0.0,
            "rounding tolerances are positive");
    expects(settings.look_ahead >= 0, "the look-ahead is not negative");
}

AxisPositions position_after(const Block& block, const AxisPositions& before) {
    if (!block.moves()) {
        return before;
    }
    AxisPositions after = before;
    for (int n = 0; n < static_cast<int>(after.size()); ++n) {
        if (block.named.contains(n)) {
            after[n] = block.target[n];
        }
    }
    expects(after.allFinite(), "the target of a block is finite");
    return after;
}

AxisPathBuilder::AxisPathBuilder(const Mechanism& machine,
                                 const PlannerSettings& settings,
                                 double filter_time,
                                 const AxisPositions& start,
                                 bool part)
    : machine_(machine), settings_(settings), part_(part), last_tip_(machine.tip(start)) {
    path_.limits = limits_of(machine);
    path_.filter_time = filter_time;
    path_.look_ahead = settings.look_ahead;
    path_.positions.push_back(start);
    path_.part_length.push_back(0.0);
    reach_ = 0.5 * filter_time * greatest_speed(path_.limits);
}

void AxisPathBuilder::reserve(std::size_t blocks) {
    path_.positions.reserve(blocks + 1);
    path_.part_length.reserve(blocks + 1);
    path_.segments.reserve(blocks);
    speeds_.reserve(blocks);
    accelerations_.reserve(blocks);
    path_.programmed.reserve(blocks);
}

void AxisPathBuilder::add(const Block& block, double path_acceleration) {
    const AxisPositions before = path_.positions.back();
    const AxisPositions after = position_after(block, before);
    Segment segment;
    segment.start = way_;
    segment.before = last_ ? last_->block : -1;
    if (block.kind == BlockKind::dwell) {
        segment.standing_time = block.duration;
    }
    path_.segments.push_back(segment);
    path_.positions.push_back(after);
    const bool moves = (after - before).cwiseAbs().maxCoeff() > 0.0;
    if (moves) {
        add_move(block, before, after, path_acceleration);
    } else if (!keeps_moving(block.kind)) {
        stop();
    }
    if (part_) {
        add_part_length(after, moves);
    }
}

const Path& AxisPathBuilder::with_limits() {
    path_.speed = profile_of(speeds_, kept_from_);
    path_.acceleration = profile_of(accelerations_, kept_from_);
    return path_;
}

void AxisPathBuilder::forget_before(double way) {
    kept_from_ = std::max(kept_from_, way - reach_);
    drop_up_to(speeds_, kept_from_);
    drop_up_to(accelerations_, kept_from_);
    drop_up_to(path_.programmed, kept_from_);
    const int needed = open_ ? last_->block - forgotten_ : path_.block_count();
    const auto kept =
        std::ranges::find_if(path_.segments, [&](const Segment& segment) { return segment.end() > way; });
    const auto count = std::min<std::ptrdiff_t>(kept - path_.segments.begin(), needed);
    path_.segments.erase(path_.segments.begin(), path_.segments.begin() + count);
    path_.positions.erase(path_.positions.begin(), path_.positions.begin() + count);
    forgotten_ += static_cast<int>(count);
}

Path AxisPathBuilder::take(const Progress& progress) {
    stop();
    progress.check();
    path_.speed = profile_of(speeds_, 0.0);
    progress.check();
    path_.acceleration = profile_of(accelerations_, 0.0);
    return std::move(path_);
}

void AxisPathBuilder::add_move(const Block& block,
                               const AxisPositions& before,
                               const AxisPositions& after,
                               double path_acceleration) {
    PlannedMove move =
        planned_move_of(machine_, path_.limits, settings_, block, before, after, path_acceleration);
    move.block = forgotten_ + path_.block_count() - 1;
    segment_of(move).length = move.length;
    if (open_) {
        meet(move, before);
    }
    way_ += move.length;
    last_ = std::move(move);
    open_ = true;
}

/// The last move ends at rest.
void AxisPathBuilder::stop() {
    if (open_) {
        limit_last_up_to_rounding(0.0);
        limit_corner(0.0);
        open_ = false;
    }
}

void AxisPathBuilder::limit_last_up_to_rounding(double d) {
    const double straight = last_->length - segment_of(*last_).rounding_start - d;
    if (!(straight > 0.0)) { // by the lengths of the move: places along the way are rounded
        return;
    }
    const double end = std::max(limited_to_, way_ - d);
    limit_up_to(end, last_->speed, last_->speed_cause, last_->acceleration, last_->acceleration_cause);
    add_feed(*last_, way_ - last_->length, end);
}

void AxisPathBuilder::limit_up_to(
    double end, double speed, Cause by, double acceleration, Cause acceleration_by) {
    const double reach = 0.5 * path_.filter_time * speed;
    speeds_.push_back({end, speed, reach, by});
    accelerations_.push_back({end, acceleration, reach, acceleration_by});
    limited_to_ = end;
}

void AxisPathBuilder::limit_corner(double speed) {
    const double reach = 0.5 * path_.filter_time * speed;
    const bool rests = !(speed > 0.0);
    speeds_.push_back({limited_to_, speed, reach, {Limit::corner, -1}, rests});
    if (rests) { // for as long as the filter: what held before holds no more
        accelerations_.back().rests = true;
        path_.programmed.back().rests = true;
    }
}

/// The programmed speeds of a move that starts at `start`, on what of it is not done yet and before
/// `end`.
void AxisPathBuilder::add_feed(const PlannedMove& move, double start, double end) {
    for (const FeedStep& step : move.feed) {
        const bool last = &step == &move.feed.back();
        const double until = last ? end : std::min(end, start + step.end);
        if (until > programmed_to()) {
            path_.programmed.push_back({until, step.speed, move.rapid});
        }
    }
}

double AxisPathBuilder::programmed_to() const {
    return path_.programmed.empty() ? kept_from_ : path_.programmed.back().end;
}

/// The corner between the last move and the next one, which starts where it ends.
void AxisPathBuilder::meet(const PlannedMove& next, const AxisPositions& position) {
    const PlannedMove& last = *last_;
    const Meeting meeting = meeting_of(last.path, last.unit, last.rapid, next.unit, next.rapid);
    const double tolerance =
        std::min(rounding_step(rounding_tolerance_of(last.path, settings_)), bounds_.tolerance);
    if (meeting == Meeting::rest || (meeting == Meeting::rounding && !(tolerance > 0.0))) {
        return stop();
    }
    if (meeting == Meeting::rounding) {
        const double acceleration = std::min(last.path_acceleration, next.path_acceleration);
        return round({position, last.direction, next.direction, acceleration}, next, tolerance);
    }
    limit_last_up_to_rounding(0.0);
    const double speed = corner_speed(machine_, settings_, last, next);
    if (speed < std::min(last.speed, next.speed)) {
        limit_corner(speed);
    }
}

void AxisPathBuilder::round(const Corner& corner, const PlannedMove& next, double tolerance) {
    const PlannedMove& last = *last_;
    const double longest = 0.5 * std::min(last.length, next.length);
    const double d = rounding_length(machine_, corner, {tolerance, settings_.rounding_angle}, longest);
    const double top = std::min(last.axis_speed, next.axis_speed);
    segment_of(last).rounding_end = segment_of(next).rounding_start = d;
    segment_of(last).after = next.block;
    segment_of(next).before = last.block;
    limit_last_up_to_rounding(d);
    const auto [before, after] = feeds_of_halves(machine_, last, next, d);
    limit_half(corner, d, way_, last.rapid ? top : std::min(top, highest_override * before));
    limit_half(corner, d, way_ + d, next.rapid ? top : std::min(top, highest_override * after));
    path_.programmed.push_back({way_, before, last.rapid});
    path_.programmed.push_back({way_ + d, after, next.rapid});
}

/// One half of a rounding, up to `end`, at no more than `fastest`.
void AxisPathBuilder::limit_half(const Corner& corner, double d, double end, double fastest) {
    const RoundingLimits limits =
        rounding_limits(machine_, path_.limits, corner, d, fastest, path_.filter_time, bounds_.turning_share);
    limit_up_to(end, limits.speed, limits.speed_cause, limits.acceleration, limits.acceleration_cause);
}

void AxisPathBuilder::add_part_length(const AxisPositions& position, bool moved) {
    double length = path_.part_length.back();
    if (moved) {
        const Vec3 tip = machine_.tip(position);
        length += (tip - last_tip_).norm();
        last_tip_ = tip;
    }
    path_.part_length.push_back(length);
}

namespace {

bool may_round(const program::Program& program, const PlannerSettings& settings) {
    return std::ranges::any_of(program.blocks, [&](const program::Block& block) {
        return block.moves() && block.path.value_or(settings.path).mode == program::PathMode::continuous;
    });
}

} // namespace

Path lay_out(const program::Program& program,
             const Mechanism& machine,
             const PlannerSettings& settings,
             const kinematics::AxisPositions& start,
             std::span<const double> accelerations,
             const Progress& progress) {
    check_axes(program.axes, program.machine, machine);
    check_settings(settings, machine, start);
    FilterTime filter(limits_of(machine), start);
    for (std::size_t n = 0; n < program.blocks.size() && !filter.settled(); ++n) {
        filter.add(program.blocks[n]);
    }
    const auto for_each_block = [&](const Progress& part, const auto& add) {
        constexpr std::size_t blocks_between_looks = 4096; // about 1 ms
        for (std::size_t n = 0; n < program.blocks.size(); ++n) {
            if (n % blocks_between_looks == 0) {
                part.check();
                part.report(static_cast<double>(n) / static_cast<double>(program.blocks.size()));
            }
            add(static_cast<int>(n),
                program.blocks[n],
                accelerations.empty() ? std::numeric_limits<double>::infinity() : accelerations[n]);
        }
    };
    std::vector<RoundingChoice::Section> sections;
    double chosen = 0.0; // of the work
    if (may_round(program, settings)) {
        chosen = 0.75;
        RoundingChoice choice(machine, settings, start, filter.seconds(), true);
        for_each_block(
            progress.part(0.0, chosen),
            [&](int, const program::Block& block, double acceleration) { choice.add(block, acceleration); });
        static_cast<void>(choice.finish());
        sections = choice.sections();
    }
    AxisPathBuilder builder(machine, settings, filter.seconds(), start, true);
    builder.reserve(program.blocks.size());
    auto section = sections.begin();
    for_each_block(progress.part(chosen, 1.0), [&](int n, const program::Block& block, double acceleration) {
        for (; section != sections.end() && section->first <= n; ++section) {
            builder.set_rounding_bounds(section->bounds);
        }
        builder.add(block, acceleration);
    });
    return builder.take(progress);
}

} // namespace millwright::motion::internal
