// The axes as functions of time. Within a block the speed along the straight way rises at a constant
// acceleration, stays, and falls at the same one (trapezoid). Lengths mm, angles rad, times s.
#pragma once

#include "core/motion/path.h"

#include <memory>
#include <vector>

namespace millwright::motion {

/// Everything about one instant.
struct Sample {
    kinematics::AxisPositions position, velocity, acceleration;
    int block = 0;         ///< being executed
    double fraction = 0.0; ///< of its way, or of its time if it stands still, 0 to 1
};

/// Where on the path and how fast.
struct PathState {
    int block = 0;
    double offset = 0.0; ///< into the block: scaled length, or s where it stands still
    double speed = 0.0;  ///< scaled (path.h)
};

/// The timing of one block or of a part of it: from `begin` to `end` of its scaled length (or of its standing
/// time), rising from `start_speed` to `peak_speed`, falling to `end_speed`. Scaled units.
struct Piece {
    double begin = 0.0, end = 0.0;
    double start_speed = 0.0, peak_speed = 0.0, end_speed = 0.0;
    double rise_time = 0.0, cruise_time = 0.0, fall_time = 0.0;

    [[nodiscard]] double duration() const { return rise_time + cruise_time + fall_time; }
};

/// Can be sampled anywhere in O(log blocks). Cheap to copy apart from its pieces; safe to read from any
/// thread.
class Trajectory {
public:
    /// Pieces of consecutive blocks of `path` from `first_block` on. Throws Defect if there is none or too
    /// many.
    Trajectory(std::shared_ptr<const Path> path, int first_block, std::vector<Piece> pieces);

    [[nodiscard]] double duration() const { return piece_starts_.back(); }
    [[nodiscard]] int axis_count() const;
    /// Blocks of the whole program, of which this trajectory executes first_block() to last_block().
    [[nodiscard]] int block_count() const { return path_->block_count(); }
    [[nodiscard]] int first_block() const { return first_block_; }
    [[nodiscard]] int last_block() const;

    /// At `time`, or at the nearer end for a time outside of [0, duration()]. Where blocks meet, the later
    /// one with any duration counts. Throws Defect if `time` is not a number.
    [[nodiscard]] Sample at(double time) const;
    [[nodiscard]] PathState state_at(double time) const;
    [[nodiscard]] int block_at(double time) const;

    /// When a block begins and ends; both the same for one that takes no time.
    [[nodiscard]] double start_of(int block) const;
    [[nodiscard]] double end_of(int block) const;
    /// When `fraction` of the block's way is done.
    [[nodiscard]] double time_at(int block, double fraction) const;

    /// The tip's way on the part so far, mm (chords of the blocks), and when it has come that far.
    [[nodiscard]] double part_length_at(double time) const;
    [[nodiscard]] double time_at_part_length(double length) const;
    [[nodiscard]] double part_length() const { return path_->part_length.back(); }

    /// What keeps a block from being faster, and the axis if it is one's doing (else -1).
    struct BlockLimit {
        Limit limit = Limit::standing;
        int axis = -1;
    };
    [[nodiscard]] BlockLimit limit_of(int block) const;

    [[nodiscard]] const Path& path() const { return *path_; }
    [[nodiscard]] const std::shared_ptr<const Path>& shared_path() const { return path_; }
    [[nodiscard]] const Piece& piece(int block) const;

private:
    [[nodiscard]] int piece_index(int block) const;
    [[nodiscard]] double time_inside(int block, double time) const;

    std::shared_ptr<const Path> path_;
    int first_block_ = 0;
    std::vector<Piece> pieces_;
    std::vector<double> piece_starts_; ///< and the end of the last
};

} // namespace millwright::motion
