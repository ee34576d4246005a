#include "core/project/internal/part_size.h"

#include <fmt/format.h>

namespace millwright::project {

double size_of(const std::vector<Vec3>& points) {
    Box3 box;
    for (const Vec3& point : points) {
        box.extend(point);
    }
    return box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
}

std::string fault_of_size(double size_mm) {
    return size_mm > 0.0 && size_mm < smallest_part_mm
               ? fmt::format("is {:.6g} mm in size, below the minimum of {} mm", size_mm, smallest_part_mm)
               : std::string();
}

std::string question_of_unit(double size_mm) {
    constexpr double mm_per_inch = 25.4;
    constexpr double mm_per_metre = 1000.0;
    return fmt::format("check the unit; in inches the size would be {:.3g} mm, in metres {:.3g} mm",
                       mm_per_inch * size_mm,
                       mm_per_metre * size_mm);
}

} // namespace millwright::project
