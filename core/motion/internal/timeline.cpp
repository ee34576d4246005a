#include "core/motion/internal/timeline.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/motion/internal/speed_segments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace millwright::motion::internal {

namespace {

/// Instead of a block's end: it ends in motion, when the way is there.
constexpr double in_motion = -1.0;

constexpr std::size_t steps_between_looks = 4096; // at the progress: some ms

/// Gives the blocks their ends and the standing ones their time, as the motion comes past them.
class Blocks {
public:
    Blocks(const Path& path, const Departure& from)
        : path_(path), next_(from.block), schedule_{from.block, from.standing_done, {}},
          left_out_(from.standing_done) {
        schedule_.ends.reserve(static_cast<std::size_t>(path.block_count() - from.block));
    }

    /// Whether the next block ends here, or is none that moves.
    [[nodiscard]] bool next_ends_at(double way) const {
        return next_ < path_.block_count() && !(segment().end() > way);
    }

    /// The axes rest at the end of the list.
    void rest(PhaseList& list) {
        while (next_ends_at(list.way())) {
            const bool here = exactly_equal(segment().end(), list.way());
            if (here && !(segment().length > 0.0)) {
                list.stand(segment().standing_time - std::exchange(left_out_, 0.0));
            }
            end_next(here ? list.time() : in_motion);
        }
    }

    /// The next block and those after it that begin before the end of the list; the last ends with it.
    void rest_inside(const PhaseList& list) {
        while (next_ + 1 < path_.block_count() && segment().end() < list.way()) {
            end_next(in_motion);
        }
        end_next(list.time());
    }

    void end_next(double time) {
        schedule_.ends.push_back(time);
        ++next_;
        left_out_ = 0.0;
    }

    Schedule take() { return std::move(schedule_); }

private:
    const Path& path_;
    int next_ = 0;
    Schedule schedule_;
    double left_out_ = 0.0; ///< of the next block's standing time: it is done

    [[nodiscard]] const Segment& segment() const { return path_.segments[static_cast<std::size_t>(next_)]; }
};

/// Where a motion comes to rest that brakes as hard as it can; not beyond a place where it has to.
double way_to_rest(const Path& path, double way, double speed) {
    double stop = way;
    for (auto step = std::ranges::upper_bound(path.acceleration, way, {}, &Step::end);
         step != path.acceleration.end();
         ++step) {
        const double ends = stop + square(speed) / (2.0 * step->value);
        if (ends <= step->end) {
            stop = ends;
            break;
        }
        speed = std::sqrt(std::max(0.0, square(speed) - 2.0 * step->value * (step->end - stop)));
        stop = step->end;
    }
    for (auto step = std::ranges::upper_bound(path.speed, way, {}, &Step::end);
         step != path.speed.end() && step->end <= stop;
         ++step) {
        if (!(step->value > 0.0)) {
            return step->end;
        }
    }
    return stop;
}

void brake_along(const Path& path, PhaseList& list, double speed) {
    const double stop = way_to_rest(path, list.way(), speed);
    for (auto step = std::ranges::upper_bound(path.acceleration, list.way(), {}, &Step::end);
         step != path.acceleration.end() && speed > 0.0;
         ++step) {
        const bool last = step->end >= stop;
        const double left = square(speed) - 2.0 * step->value * (step->end - list.way());
        const double after = last ? 0.0 : std::sqrt(std::max(0.0, left));
        list.brake(speed, after, step->value, last ? stop : step->end);
        speed = after;
    }
}

/// With the ends of the blocks that end in motion.
Schedule completed(const Path& path, const Timing& timing, Schedule schedule, const Progress& progress) {
    double before = 0.0;
    for (std::size_t n = 0; n < schedule.ends.size(); ++n) {
        if (n % steps_between_looks == 0) {
            progress.check();
        }
        const Segment& block = path.segments[static_cast<std::size_t>(schedule.first_block) + n];
        double& end = schedule.ends[n];
        if (end >= 0.0) {
            end = std::max(before, end);
        } else {
            end = block.length > 0.0 ? timing.time_of(block.end(), before, timing.end()) : before;
        }
        before = end;
    }
    return schedule;
}

} // namespace

Departure departure() {
    Departure from;
    from.history = {{}};
    return from;
}

Departure departure(const Trajectory& now, double time) {
    time = std::clamp(time, 0.0, now.duration());
    const Sample sample = now.at(time);
    const Path& path = now.path();
    Departure from;
    from.block = sample.block;
    if (path.block_count() > 0) {
        from.standing_done =
            sample.fraction * path.segments[static_cast<std::size_t>(sample.block)].standing_time;
    }
    from.history = now.timing().history(time);
    if (!(from.history.back().speed > 0.0)) {
        from.settling = std::max(0.0, path.filter_time - (time - now.timing().at_rest_since(time)));
    }
    return from;
}

int first_block_after(const Path& path, const Departure& from) {
    int block = from.block;
    while (block < path.block_count() &&
           !(path.segments[static_cast<std::size_t>(block)].end() > from.history.back().way)) {
        ++block;
    }
    return block;
}

int first_block_to_rest_in(const Path& path, const Departure& from) {
    const Phase& now = from.history.back();
    const double stop = now.speed > 0.0 ? way_to_rest(path, now.way, now.speed) : now.way;
    int block = from.block;
    while (block + 1 < path.block_count() && path.segments[static_cast<std::size_t>(block)].end() < stop) {
        ++block;
    }
    return block;
}

Trajectory go_to_the_end_of(int last,
                            std::shared_ptr<const Path> path,
                            Departure from,
                            const Override& rates,
                            const Progress& progress) {
    expects(rates.feed > 0.0 && rates.feed <= highest_override && rates.rapid > 0.0 && rates.rapid <= 1.0,
            "an override is within the range of the machine");
    const Phase now = from.history.back();
    WayRange range{now.way, now.way, now.way};
    if (last >= 0) {
        range.filtered = std::min(now.way, path->segments[static_cast<std::size_t>(from.block)].start);
        range.end = path->segments[static_cast<std::size_t>(last)].end();
    }
    const std::vector<SpeedSegment> speed_segments = speed_segments_of(*path, range, rates);
    progress.check();
    const std::vector<double> speeds =
        reached_speeds(speed_segments, allowed_speeds(*path, speed_segments), now.speed);
    progress.check();
    Blocks blocks(*path, from);
    PhaseList list(std::move(from.history));
    if (!(now.speed > 0.0) && blocks.next_ends_at(now.way)) {
        list.stand(from.settling);
        blocks.rest(list);
    }
    bool moving = now.speed > 0.0;
    for (std::size_t n = 0; n < speed_segments.size(); ++n) {
        if (n % steps_between_looks == 0) {
            progress.check();
        }
        list.go(speed_segments[n], speeds[n], speeds[n + 1]);
        moving = moving || speed_segments[n].end > speed_segments[n].begin;
        if (moving && !(speeds[n + 1] > 0.0)) {
            list.stand(path->filter_time);
            blocks.rest(list);
            moving = false;
        }
    }
    Timing timing(list.take(), path->filter_time);
    Schedule schedule = completed(*path, timing, blocks.take(), progress);
    return {std::move(path), std::move(timing), std::move(schedule)};
}

Trajectory brake_to_rest(std::shared_ptr<const Path> path, Departure from) {
    const Phase now = from.history.back();
    Blocks blocks(*path, from);
    PhaseList list(std::move(from.history));
    if (now.speed > 0.0) {
        brake_along(*path, list, now.speed);
        list.stand(path->filter_time);
        blocks.rest_inside(list);
    } else {
        list.stand(from.settling);
        blocks.end_next(list.time());
    }
    Timing timing(list.take(), path->filter_time);
    Schedule schedule = completed(*path, timing, blocks.take(), Progress());
    return {std::move(path), std::move(timing), std::move(schedule)};
}

} // namespace millwright::motion::internal
