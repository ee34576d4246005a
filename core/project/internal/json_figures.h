// Figures as reports write them.
#pragma once

#include "core/geometry/vectors.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace millwright::project {

/// To a nanometre or a microdegree: no reader needs more.
[[nodiscard]] inline double rounded(double value) {
    constexpr double steps = 1e6;
    return std::round(value * steps) / steps;
}

[[nodiscard]] inline nlohmann::ordered_json vector(const Vec3& p) {
    return nlohmann::ordered_json::array({rounded(p.x()), rounded(p.y()), rounded(p.z())});
}

} // namespace millwright::project
