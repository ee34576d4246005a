#include "core/pmac/emulator/internal/path.h"

#include <algorithm>
#include <cmath>

namespace millwright::pmac::card {

Axes Move::at(double u) const {
    Axes result;
    for (std::size_t n = 0; n < result.size(); ++n) {
        result[n] = from[n] + u * (to[n] - from[n]);
    }
    if (arc) {
        const Vec3 start(from[0], from[1], from[2]);
        const Vec3 way(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
        const Vec3 arm = start - arc->center;
        const Vec3 across = arm - arm.dot(arc->normal) * arc->normal;
        const double first = across.norm();
        const double radius = first + u * (arc->last_radius - first);
        const Vec3 turned = Eigen::AngleAxisd(u * arc->angle, arc->normal) * across;
        const Vec3 point = arc->center + (radius / first) * turned +
                           (arm.dot(arc->normal) + u * way.dot(arc->normal)) * arc->normal;
        result[0] = point.x();
        result[1] = point.y();
        result[2] = point.z();
    }
    return result;
}

void Path::begin(const Axes& position) {
    moves_.clear();
    waiting_ = 0;
    late_ = false;
    time_ = 0.0;
    base_ = position_ = position;
}

void Path::add(const Move& move) {
    if (moves_.empty()) {
        base_ = position_ = move.from;
    } else if (Active& last = moves_.back(); last.move.blends && last.begun >= 0.0) {
        // it ends as the next one begins, if there is still time for that
        Ramp out = move.ramp;
        out.time = std::min(out.time, 2.0 * (last.move.time - 0.5 * last.move.ramp.time));
        out.s_curve = std::min(out.s_curve, 0.5 * out.time);
        const double begin = 0.5 * last.move.ramp.time + last.move.time - 0.5 * out.time;
        if (time_ - last.begun <= begin) {
            last.out = out;
        }
    }
    moves_.push_back({move, move.stop.value_or(move.ramp), -1.0});
    ++waiting_;
    start_next();
}

void Path::start_next() {
    if (waiting_ == 0) {
        return;
    }
    Active& next = moves_[moves_.size() - 1];
    if (moves_.size() == 1) {
        next.begun = time_;
        waiting_ = 0;
        return;
    }
    const Active& last = moves_[moves_.size() - 2];
    const double begin = last.begun + (last.move.blends && !late_ ? last.out_begin() : last.end());
    if (time_ >= begin) {
        next.begun = begin;
        waiting_ = 0;
    }
}

void Path::advance(double seconds) {
    time_ += seconds;
    start_next();
    if (moves_.size() == 1 && waiting_ == 0 && time_ - moves_[0].begun > moves_[0].out_begin()) {
        late_ = true;
    }
    while (!moves_.empty() && moves_.front().begun >= 0.0 &&
           time_ - moves_.front().begun >= moves_.front().end()) {
        base_ = moves_.front().move.to;
        if (moves_.size() == 2 && waiting_ == 1) {
            moves_[1].begun = moves_.front().begun + moves_.front().end();
            waiting_ = 0;
        }
        moves_.pop_front();
        late_ = false;
    }
    position_ = base_;
    for (const Active& one : moves_) {
        if (one.begun < 0.0) {
            continue;
        }
        const double t = time_ - one.begun;
        const double u = (one.move.ramp.way(t) - one.out.way(t - one.out_begin())) / one.move.time;
        const Axes point = one.move.at(std::clamp(u, 0.0, 1.0));
        for (std::size_t n = 0; n < position_.size(); ++n) {
            position_[n] += point[n] - one.move.from[n];
        }
    }
}

} // namespace millwright::pmac::card
