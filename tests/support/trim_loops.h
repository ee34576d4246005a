// Outlines in the parameters of a patch, for tests.
#pragma once

#include "core/geometry/trim.h"

#include <cmath>
#include <numbers>

namespace millwright::test {

inline geometry::Trim::Loop circle(const Vec2& middle, double radius, int corners) {
    geometry::Trim::Loop loop;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / corners;
        loop.emplace_back(middle + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return loop;
}

inline geometry::Trim::Loop rectangle(double u0, double v0, double u1, double v1) {
    return {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
}

} // namespace millwright::test
