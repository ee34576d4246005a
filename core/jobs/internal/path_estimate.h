// Which line a controller is at that says where its machine is, and not which line that belongs to: the
// reported position is looked for on the path of the program. Lengths mm.
#pragma once

#include "core/jobs/survey.h"

#include <cstddef>
#include <vector>

namespace millwright::jobs::internal {

class PathEstimate {
public:
    /// Knows no path, and estimates nothing.
    PathEstimate() = default;
    /// `path` as surveyed from `start`, both machine coordinates.
    PathEstimate(std::vector<Survey::PathPoint> path, const Vec3& start);

    [[nodiscard]] bool knows_path() const { return !path_.empty(); }
    /// The line of the first move that `at` lies on, from the move of the last call on and of the lines
    /// `first` to `last`; where it lies on none, the line of the last call, but at least `first`. Proves
    /// nothing: a path may come to one place twice.
    [[nodiscard]] int line_at(const Vec3& at, int first, int last);

private:
    std::vector<Survey::PathPoint> path_;
    Vec3 start_ = Vec3::Zero();
    std::size_t next_ = 0;
    int line_ = 0;
};

} // namespace millwright::jobs::internal
