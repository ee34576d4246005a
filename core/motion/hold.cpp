#include "core/motion/hold.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/motion/internal/piece.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::motion {

namespace {

Piece falling(double begin, double end, double start_speed, double end_speed, double acceleration) {
    Piece piece{.begin = begin, .end = end, .start_speed = start_speed, .end_speed = end_speed};
    piece.peak_speed = start_speed;
    piece.fall_time = (start_speed - end_speed) / acceleration;
    return piece;
}

const Segment& segment_of(const Trajectory& trajectory, int block) {
    return trajectory.path().segments[static_cast<std::size_t>(block)];
}

} // namespace

// The plan never slows down by more than a block's greatest acceleration. Braking by that much all the time
// is therefore never faster than the plan, and passes every corner at most as fast as the plan does.
Trajectory brake(const Trajectory& planned, const PathState& from) {
    std::vector<Piece> pieces;
    double offset = from.offset;
    double speed = from.speed;
    for (int block = from.block; block <= planned.last_block(); ++block, offset = 0.0) {
        const Segment& segment = segment_of(planned, block);
        if (!(segment.length > 0.0)) {
            pieces.push_back({.begin = offset, .end = offset});
            if (speed > 0.0) {
                continue;
            }
            break;
        }
        const double a = segment.max_acceleration;
        const double start_speed = speed;
        const double stop = offset + square(speed) / (2.0 * a);
        if (stop <= segment.length) {
            pieces.push_back(falling(offset, stop, speed, 0.0, a));
            break;
        }
        const double left = segment.length - offset;
        const bool stops_here =
            !(planned.piece(block).end_speed > 0.0); // where only rounding is left of the speed
        speed = stops_here ? 0.0 : std::sqrt(std::max(0.0, square(speed) - 2.0 * a * left));
        pieces.push_back(falling(offset, segment.length, start_speed, speed, a));
        if (stops_here) {
            break;
        }
    }
    return {planned.shared_path(), from.block, std::move(pieces)};
}

Trajectory rejoin(const Trajectory& planned, const PathState& from) {
    std::vector<Piece> pieces;
    double offset = from.offset;
    double speed = from.speed;
    int block = from.block;
    for (; block <= planned.last_block(); ++block, offset = 0.0) {
        const Segment& segment = segment_of(planned, block);
        const Piece& plan = planned.piece(block);
        if (!(segment.length > 0.0)) {
            pieces.push_back(internal::standing(offset, std::max(offset, segment.standing_time)));
            continue;
        }
        if (offset <= plan.begin && speed >= plan.start_speed) {
            break;
        }
        const double left = segment.length - offset;
        const double reachable = internal::speed_after(speed, segment.max_acceleration, left);
        const double end_speed = std::min(plan.end_speed, reachable);
        pieces.push_back(internal::trapezoid(segment, offset, segment.length, speed, end_speed));
        speed = end_speed;
    }
    for (; block <= planned.last_block(); ++block) {
        pieces.push_back(planned.piece(block));
    }
    return {planned.shared_path(), from.block, std::move(pieces)};
}

PathState end_state(const Trajectory& trajectory) {
    const int block = trajectory.last_block();
    const Piece& last = trajectory.piece(block);
    return {block, last.end, last.end_speed};
}

} // namespace millwright::motion
