// Tool axes that lean against a normal.
#pragma once

#include "core/base/units.h"
#include "core/toolpath/tool.h"
#include "tests/support/machines.h"

#include <cmath>
#include <random>

namespace millwright::test {

inline const toolpath::Lean ten_degrees{.lead = from_degrees(10.0)};

/// An axis that leans by `angle` against `normal`, to any side.
inline Vec3 leaning(std::mt19937& random, const Vec3& normal, double angle) {
    const Vec3 side = normal.cross(random_upward(random)).normalized();
    return std::cos(angle) * normal + std::sin(angle) * side;
}

} // namespace millwright::test
