// Where a program's zero lies on the machine, for machines without a controller that keeps it.
#pragma once

#include "core/gcode/reader_settings.h"
#include "core/geometry/vectors.h"

#include <optional>

namespace millwright::gcode {

/// In machine coordinates, mm.
struct WorkOrigin {
    double x = 0.0, y = 0.0;
    std::optional<double> z{}; ///< not given: not known

    WorkOrigin() = default;
    WorkOrigin(double along_x, double along_y) : x(along_x), y(along_y) {}
    explicit WorkOrigin(const Vec3& whole) : x(whole.x()), y(whole.y()), z(whole.z()) {}

    /// What is not known counts as 0.
    [[nodiscard]] Vec3 at() const { return Vec3(x, y, z.value_or(0.0)); }
};

/// Every work system (G54 to G59.3) begins there until the program changes it, without a rotation and without
/// G92 where the settings do not have them. With Z it is a whole origin: axes other than X, Y and Z begin at
/// 0 where the settings do not have them.
void put_origin(ReaderSettings& settings, const WorkOrigin& origin);

} // namespace millwright::gcode
