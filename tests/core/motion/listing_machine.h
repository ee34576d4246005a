// The machine of the thesis's listing and where its axes are.
#pragma once

#include "tests/support/machines.h"

namespace millwright::test {

/// X 250 mm/s, 1500 mm/s^2; Y the same; Z 200 mm/s, 1200 mm/s^2.
inline kinematics::MachineModel listing_machine() {
    return machine("rotary-tilt-listing");
}

inline kinematics::AxisPositions at_xy(double x, double y = 0.0) {
    kinematics::AxisPositions q = kinematics::AxisPositions::Zero(5);
    q.head<2>() << x, y;
    return q;
}

} // namespace millwright::test
