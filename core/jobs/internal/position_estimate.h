// What a controller's position says while a program runs: which line its machine is at, and whether the
// program can have sent it there.
#pragma once

#include "core/jobs/program_check.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace millwright::jobs::internal {

// Which line a controller is at that says where its machine is, and not which line that belongs to: the
// reported position is looked for on the path of the program. Lengths mm.

struct PathPlace {
    int line = 0;
    double fraction = 0.0; ///< of the way of that line, 0 to 1
};

class PathEstimate {
public:
    /// Knows no path, and estimates nothing.
    PathEstimate() = default;
    /// `path` as checked from `start`, both machine coordinates.
    PathEstimate(std::vector<ProgramCheck::MoveEnd> path, const Vec3& start);

    [[nodiscard]] bool knows_path() const { return !path_.empty(); }
    /// On the first move that `at` lies on, from the move of the last call on and of the lines `first` to
    /// `last`; where it lies on none, the place of the last call, but at least the beginning of `first`.
    /// Never goes back. Proves nothing: a path may come to one place twice.
    [[nodiscard]] PathPlace place_at(const Vec3& at, int first, int last);

private:
    std::vector<ProgramCheck::MoveEnd> path_;
    Vec3 start_ = Vec3::Zero();
    std::size_t next_ = 0; ///< move of the last call
    PathPlace place_;

    [[nodiscard]] const Vec3& begin_of(std::size_t move) const {
        return move == 0 ? start_ : path_[move - 1].at;
    }
    [[nodiscard]] double length_of(std::size_t move) const;
    [[nodiscard]] double fraction_of_line(std::size_t move, double part) const;
};

// Whether a machine is where its program can have sent it: a number that was changed on the way to a
// controller shows in what the controller reports. Lengths mm, angles rad, times s.

/// The box around everything that a program sends, and the watch over it.
class PositionEnvelope {
public:
    /// Knows of nothing.
    PositionEnvelope() = default;
    /// `before` and `offsets` as the controller reports them, `found` checked with them. What cannot be
    /// known beforehand is not watched: programs that probe, and controllers that report no modes or no
    /// offsets.
    PositionEnvelope(const ProgramCheck& found,
                     std::vector<program::ProgramAxis> axes,
                     const drivers::DriverStatus& before,
                     const std::vector<drivers::StoredOffset>& offsets);

    /// What is wrong, a part of a sentence, once a running machine has been beyond the box for longer than
    /// one wrong report can last, or rests there; else empty.
    [[nodiscard]] std::string watch(const drivers::DriverStatus& status, double now);

private:
    [[nodiscard]] bool leaves_watch(const drivers::DriverStatus& status);
    [[nodiscard]] std::string beyond(const drivers::DriverStatus& status) const;

    std::optional<ProgramCheck> found_;
    std::vector<program::ProgramAxis> axes_;
    std::string doubt_; ///< of the position, before
    std::optional<double> since_;
    kinematics::AxisPositions offset_before_; ///< of the work, at a tool change under way; empty: none is
};

} // namespace millwright::jobs::internal
