#include "core/motion/trajectory.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/motion/internal/piece.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::motion {

namespace {

double fraction_of(const Segment& segment, double offset) {
    const double whole = segment.length > 0.0 ? segment.length : segment.standing_time;
    return whole > 0.0 ? std::clamp(offset / whole, 0.0, 1.0) : 1.0;
}

} // namespace

Trajectory::Trajectory(std::shared_ptr<const Path> path, int first_block, std::vector<Piece> pieces)
    : path_(std::move(path)), first_block_(first_block), pieces_(std::move(pieces)) {
    expects(path_ != nullptr && first_block >= 0, "a trajectory has a path");
    expects(first_block + std::ssize(pieces_) <= path_->block_count() &&
                (!pieces_.empty() || block_count() == 0),
            "a trajectory executes blocks of its path");
    piece_starts_.reserve(pieces_.size() + 1);
    double time = 0.0;
    for (const Piece& piece : pieces_) {
        piece_starts_.push_back(time);
        time += piece.duration();
    }
    piece_starts_.push_back(time);
    expects(std::isfinite(time), "a trajectory takes a finite time");
}

int Trajectory::axis_count() const {
    return static_cast<int>(path_->positions.front().size());
}

int Trajectory::last_block() const {
    return first_block_ + static_cast<int>(pieces_.size()) - 1;
}

int Trajectory::piece_index(int block) const {
    expects(block >= first_block_ && block <= last_block(), "the trajectory executes the block asked for");
    return block - first_block_;
}

const Piece& Trajectory::piece(int block) const {
    return pieces_[static_cast<std::size_t>(piece_index(block))];
}

int Trajectory::block_at(double time) const {
    expects(!std::isnan(time), "a time is a number");
    const auto after = std::upper_bound(piece_starts_.begin(), piece_starts_.end(), time);
    const auto index = static_cast<int>(after - piece_starts_.begin()) - 1;
    return first_block_ + std::clamp(index, 0, std::max(0, static_cast<int>(pieces_.size()) - 1));
}

/// The time into a block's piece: exactly its duration at the end, whatever the sums of durations rounded to.
double Trajectory::time_inside(int block, double time) const {
    const double whole = piece(block).duration();
    return time >= end_of(block) ? whole : std::clamp(time - start_of(block), 0.0, whole);
}

PathState Trajectory::state_at(double time) const {
    if (pieces_.empty()) {
        return {};
    }
    const int block = block_at(time);
    const Piece& now = piece(block);
    const double inside = time_inside(block, time);
    const auto& segment = path_->segments[static_cast<std::size_t>(block)];
    const internal::Moment moment = internal::moment(now, segment, inside);
    return {block, moment.offset, moment.speed};
}

Sample Trajectory::at(double time) const {
    Sample sample;
    const auto axes = static_cast<Eigen::Index>(axis_count());
    sample.position = path_->positions.front();
    sample.velocity = sample.acceleration = kinematics::AxisPositions::Zero(axes);
    if (pieces_.empty()) {
        return sample;
    }
    sample.block = block_at(time);
    const auto n = static_cast<std::size_t>(sample.block);
    const Segment& segment = path_->segments[n];
    const Piece& now = piece(sample.block);
    const double inside = time_inside(sample.block, time);
    const internal::Moment moment = internal::moment(now, segment, inside);
    sample.fraction = fraction_of(segment, moment.offset);

    const kinematics::AxisPositions& a = path_->positions[n];
    const kinematics::AxisPositions& b = path_->positions[n + 1];
    sample.position = b; // exactly, not but for rounding
    if (sample.fraction < 1.0) {
        sample.position = a + sample.fraction * (b - a);
    }
    if (segment.length > 0.0) {
        sample.velocity = (b - a) * (moment.speed / segment.length);
        sample.acceleration = (b - a) * (moment.acceleration / segment.length);
    }
    return sample;
}

double Trajectory::start_of(int block) const {
    return piece_starts_[static_cast<std::size_t>(piece_index(block))];
}

double Trajectory::end_of(int block) const {
    return piece_starts_[static_cast<std::size_t>(piece_index(block)) + 1];
}

double Trajectory::time_at(int block, double fraction) const {
    expects(block >= 0 && block < block_count(), "a block belongs to the program");
    const Segment& segment = path_->segments[static_cast<std::size_t>(block)];
    const double whole = segment.length > 0.0 ? segment.length : segment.standing_time;
    return start_of(block) + internal::time_of(piece(block), segment, fraction * whole);
}

double Trajectory::part_length_at(double time) const {
    if (pieces_.empty()) {
        return 0.0;
    }
    const PathState state = state_at(time);
    const auto n = static_cast<std::size_t>(state.block);
    const double fraction = fraction_of(path_->segments[n], state.offset);
    return mix(path_->part_length[n], path_->part_length[n + 1], fraction);
}

double Trajectory::time_at_part_length(double length) const {
    if (pieces_.empty()) {
        return 0.0;
    }
    const auto& lengths = path_->part_length;
    const auto after = std::upper_bound(lengths.begin() + 1, lengths.end(), length);
    if (after == lengths.end()) {
        return duration();
    }
    const auto n = static_cast<std::size_t>(after - lengths.begin()) - 1;
    const int block = std::clamp(static_cast<int>(n), first_block_, last_block());
    const double fraction = (length - lengths[n]) / (lengths[n + 1] - lengths[n]);
    return time_at(block, std::clamp(fraction, 0.0, 1.0));
}

Trajectory::BlockLimit Trajectory::limit_of(int block) const {
    expects(block >= 0 && block < block_count(), "a block belongs to the program");
    const Segment& segment = path_->segments[static_cast<std::size_t>(block)];
    if (!(segment.length > 0.0)) {
        return {};
    }
    constexpr double nearly = 1.0 - 1e-12; // rounding of the peak's square root
    if (piece(block).peak_speed >= nearly * segment.max_speed) {
        const bool by_axis = segment.velocity_axis >= 0;
        return {by_axis ? Limit::axis_velocity : Limit::programmed_feed, segment.velocity_axis};
    }
    return {Limit::axis_acceleration, segment.acceleration_axis};
}

} // namespace millwright::motion
