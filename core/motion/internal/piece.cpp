#include "core/motion/internal/piece.h"

#include "core/base/numbers.h"

#include <algorithm>
#include <cmath>

namespace millwright::motion::internal {

namespace {

double length_between(double slow, double fast, double acceleration) {
    return (fast - slow) * (fast + slow) / (2.0 * acceleration);
}

/// The time to cover `length` from `speed` while accelerating; stable for any of them near zero.
double time_for(double length, double speed, double acceleration) {
    const double sum = speed + speed_after(speed, acceleration, length);
    return sum > 0.0 ? 2.0 * length / sum : 0.0;
}

} // namespace

double speed_after(double speed, double acceleration, double length) {
    return std::sqrt(square(speed) + 2.0 * acceleration * length);
}

Piece trapezoid(const Segment& segment, double begin, double end, double start_speed, double end_speed) {
    const double a = segment.max_acceleration;
    const double length = end - begin;
    const double without_cruise = std::sqrt((square(start_speed) + square(end_speed)) / 2.0 + a * length);
    Piece piece{.begin = begin, .end = end, .start_speed = start_speed, .end_speed = end_speed};
    piece.peak_speed = std::max({std::min(segment.max_speed, without_cruise), start_speed, end_speed});
    const double cruise = length - length_between(start_speed, piece.peak_speed, a) -
                          length_between(end_speed, piece.peak_speed, a);
    piece.rise_time = (piece.peak_speed - start_speed) / a;
    piece.fall_time = (piece.peak_speed - end_speed) / a;
    piece.cruise_time = without_cruise > segment.max_speed ? std::max(0.0, cruise) / piece.peak_speed : 0.0;
    return piece;
}

Piece standing(double begin, double end) {
    return {.begin = begin, .end = end, .cruise_time = end - begin};
}

Moment moment(const Piece& piece, const Segment& segment, double time) {
    if (!(segment.length > 0.0)) {
        return {piece.begin + time, 0.0, 0.0};
    }
    const double a = segment.max_acceleration;
    if (time < piece.rise_time) {
        const double speed = piece.start_speed + a * time;
        return {piece.begin + (piece.start_speed + speed) / 2.0 * time, speed, a};
    }
    const double left = piece.duration() - time;
    if (left > piece.fall_time) {
        const double risen = piece.begin + (piece.start_speed + piece.peak_speed) / 2.0 * piece.rise_time;
        return {risen + piece.peak_speed * (time - piece.rise_time), piece.peak_speed, 0.0};
    }
    // Counted from the end, so that the piece ends exactly where and as fast as it says.
    const double speed = std::min(piece.end_speed + a * left, piece.peak_speed);
    const double acceleration = piece.fall_time > 0.0 ? -a : 0.0;
    return {piece.end - (piece.end_speed + speed) / 2.0 * left, speed, acceleration};
}

double time_of(const Piece& piece, const Segment& segment, double offset) {
    if (offset <= piece.begin) {
        return 0.0;
    }
    if (offset >= piece.end) {
        return piece.duration();
    }
    if (!(segment.length > 0.0)) {
        return offset - piece.begin;
    }
    const double a = segment.max_acceleration;
    const double done = offset - piece.begin;
    const double risen = (piece.start_speed + piece.peak_speed) / 2.0 * piece.rise_time;
    if (done <= risen) {
        return time_for(done, piece.start_speed, a);
    }
    const double cruised = risen + piece.peak_speed * piece.cruise_time;
    if (done <= cruised) {
        return piece.rise_time + (done - risen) / piece.peak_speed;
    }
    return piece.duration() - time_for(piece.end - offset, piece.end_speed, a);
}

} // namespace millwright::motion::internal
