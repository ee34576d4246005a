#include "core/motion/internal/rounding_choice.h"

#include "core/motion/internal/speed_segments.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace millwright::motion::internal {

TimeWindow::TimeWindow(const Mechanism& machine,
                       const PlannerSettings& settings,
                       const kinematics::AxisPositions& start,
                       double filter_time)
    : filter_time_(filter_time), builder_(machine, settings, filter_time, start, false) {}

void TimeWindow::add(const program::Block& block, double path_acceleration) {
    builder_.add(block, path_acceleration);
    if (block.kind == program::BlockKind::dwell && block.duration > 0.0) {
        time_ += block.duration;
    }
    if (builder_.block_count() >= full_) {
        pass(false);
        full_ =
            std::max(least_window, 2 * builder_.block_count()); // so that a block is looked at twice or so
    }
}

double TimeWindow::finish() {
    builder_.finish();
    pass(true);
    return time_;
}

/// Counts the time of what is settled, or of all, and forgets it.
void TimeWindow::pass(bool all) {
    const Path& path = builder_.with_limits();
    const std::vector<SpeedSegment> speed_segments =
        speed_segments_of(path, {builder_.kept_from(), way_, builder_.limited_to()}, {});
    const std::size_t count =
        all ? speed_segments.size() : settled(path, speed_segments, builder_.limited_to() - builder_.reach());
    if (count == 0) {
        return;
    }
    const std::vector<double> speeds =
        reached_speeds(speed_segments, allowed_speeds(path, speed_segments), speed_);
    PhaseList list({Phase{0.0, way_, speed_, 0.0}});
    for (std::size_t n = 0; n < count; ++n) {
        list.go(speed_segments[n], speeds[n], speeds[n + 1]);
        moving_ = moving_ || speed_segments[n].end > speed_segments[n].begin;
        if (moving_ && !(speeds[n + 1] > 0.0)) {
            list.stand(filter_time_);
            moving_ = false;
        }
    }
    time_ += list.time();
    way_ = speed_segments[count - 1].end;
    speed_ = speeds[count];
    builder_.forget_before(way_);
}

using kinematics::AxisPositions;
using program::Block;

RoundingChoice::RoundingChoice(const Mechanism& machine,
                               const PlannerSettings& settings,
                               const AxisPositions& start,
                               double filter_time,
                               bool keep)
    : machine_(machine), settings_(settings), filter_time_(filter_time), keep_(keep),
      limits_(limits_of(machine)), at_(start) {
    open_section();
}

void RoundingChoice::open_section() {
    tries_.clear();
    eager_tries_.clear();
    tries_.push_back({{}, TimeWindow(machine_, settings_, at_, filter_time_)});
    begin_ = block_;
}

/// The fastest one; of equals the one with the larger roundings.
void RoundingChoice::close_section() {
    double fastest = std::numeric_limits<double>::infinity();
    RoundingBounds bounds;
    for (std::list<Try>* const tries : {&tries_, &eager_tries_}) {
        for (auto one = tries->rbegin(); one != tries->rend(); ++one) {
            if (const double time = one->window.finish(); time < fastest) {
                fastest = time;
                bounds = one->bounds;
            }
        }
    }
    if (keep_ && tries_.size() > 1) {
        sections_.push_back({begin_, bounds});
        sections_.push_back({block_, {}});
    }
    time_ += fastest;
}

double RoundingChoice::finish() {
    close_section();
    return time_;
}

void RoundingChoice::add(const Block& block, double path_acceleration) {
    const AxisPositions after = position_after(block, at_);
    const bool moves = (after - at_).cwiseAbs().maxCoeff() > 0.0;
    if (moves) {
        const Straight next{unit_of(limits_, at_, after),
                            block.kind == program::BlockKind::rapid,
                            block.path.value_or(settings_.path)};
        if (last_) {
            meet(next);
        }
        last_ = next;
    } else if (!keeps_moving(block.kind)) {
        last_.reset();
    }
    if (!last_ && tries_.size() > 1) {
        close_section();
        open_section();
    }
    for (std::list<Try>* const tries : {&tries_, &eager_tries_}) {
        for (Try& one : *tries) {
            one.window.add(block, path_acceleration);
        }
    }
    at_ = after;
    ++block_;
}

void RoundingChoice::meet(const Straight& next) {
    switch (meeting_of(last_->path, last_->unit, last_->rapid, next.unit, next.rapid)) {
    case Meeting::rest:
        if (tries_.size() > 1) {
            close_section();
            open_section();
        }
        break;
    case Meeting::rounding:
        try_up_to(rounding_tolerance_of(last_->path, settings_));
        break;
    case Meeting::corner:
        break;
    }
}

/// Up to here the way within a new tolerance is the one within all tolerances that came.
void RoundingChoice::insert(std::list<Try>& tries, double tolerance) {
    Try again = tries.back();
    again.bounds.tolerance = tolerance;
    again.window.set_rounding_bounds(again.bounds);
    tries.insert(std::prev(tries.end()), std::move(again));
}

void RoundingChoice::try_up_to(double tolerance) {
    const double largest = rounding_step(tolerance);
    if (tries_.size() == 1) {
        Try eager = tries_.back();
        eager.bounds.turning_share = greatest_turning_share;
        eager.window.set_rounding_bounds(eager.bounds);
        eager_tries_.push_back(std::move(eager));
        insert(tries_, 0.0);
    }
    double known = std::prev(tries_.end(), 2)->bounds.tolerance;
    for (double step = 0.0; step < largest; step = next_rounding_step(step)) {
        if (step > known) {
            insert(tries_, step);
            insert(eager_tries_, step);
            known = step;
        }
    }
}

} // namespace millwright::motion::internal
