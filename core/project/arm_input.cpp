#include "core/project/arm_input.h"

#include "core/base/units.h"

namespace millwright::project {

Frame base_T_path(const PathPlace& place) {
    const auto turn = [&](Eigen::Index axis) {
        return Eigen::AngleAxisd(from_degrees(place.turned_deg[axis]), Vec3::Unit(axis));
    };
    Frame frame = Frame::Identity();
    frame.translation() = place.at_mm;
    frame.linear() = (turn(2) * turn(1) * turn(0)).toRotationMatrix();
    return frame;
}

} // namespace millwright::project
