// The colors that drawn machines and arms share.
#pragma once

#include "core/geometry/vectors.h"

namespace millwright::kinematics {

inline const Vec3 paint(0.86, 0.87, 0.88), graphite(0.27, 0.29, 0.32), steel(0.60, 0.64, 0.68);

} // namespace millwright::kinematics
