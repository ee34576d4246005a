// How near the tool tip comes to the part on its way above it. The part is known by the points of the tool
// path and their tangent planes.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/toolpath/toolpath.h"

#include <array>
#include <map>
#include <vector>

namespace millwright::program::internal {

class Clearance {
public:
    /// Keeps `height` above the tangent plane of the nearest path point. `toolpath` must outlive it.
    Clearance(const toolpath::Toolpath& toolpath, double height);

    [[nodiscard]] bool clear(const Vec3& tip) const;

    /// Whether the tip stays clear while all axes go straight from `a` to `b`. Moves along the tool's own
    /// axis are: only the tool itself has been there.
    [[nodiscard]] bool clear(const kinematics::MachineModel& machine,
                             const kinematics::AxisPositions& a,
                             const kinematics::AxisPositions& b) const;

private:
    using Cell = std::array<int, 3>;
    [[nodiscard]] Cell cell_of(const Vec3& point) const;

    const toolpath::Toolpath& toolpath_;
    double height_ = 0.0;
    double reach_ = 0.0; ///< a tip farther than this from every point is clear; edge of a cell
    std::map<Cell, std::vector<int>> cells_;
};

} // namespace millwright::program::internal
