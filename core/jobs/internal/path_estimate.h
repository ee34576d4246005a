// Which line a controller is at that says where its machine is, and not which line that belongs to: the
// reported position is looked for on the path of the program. Lengths mm.
#pragma once

#include "core/jobs/program_check.h"

#include <cstddef>
#include <vector>

namespace millwright::jobs::internal {

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

} // namespace millwright::jobs::internal
