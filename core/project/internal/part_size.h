// A part so small that its unit must be another one.
#pragma once

#include "core/geometry/vectors.h"

#include <string>
#include <vector>

namespace millwright::project {

/// What is machined is this large at least along one axis, mm: as far as errors are certified.
inline constexpr double smallest_part_mm = 1e-3;

/// The largest side of the box around `points`, mm; 0 without one.
[[nodiscard]] double size_of(const std::vector<Vec3>& points);

/// That something `size_mm` large is smaller than `smallest_part_mm`: "is 5e-06 mm large, less than 0.001
/// mm". Empty if it is not, and for 0: that no normal is there tells more of what is a point.
[[nodiscard]] std::string fault_of_size(double size_mm);

/// "check the unit; in inches the size would be 1.27 mm large, in metres 50 mm"
[[nodiscard]] std::string question_of_unit(double size_mm);

} // namespace millwright::project
