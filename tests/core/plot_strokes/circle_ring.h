// A circle as a ring of corners.
#pragma once

#include "core/base/units.h"
#include "core/plot_strokes/region.h"

#include <cmath>

namespace millwright::test {

inline plot::Ring circle_ring(double radius, int count) {
    plot::Ring ring;
    for (int n = 0; n < count; ++n) {
        ring.push_back(radius * Vec2(std::cos(2.0 * pi * n / count), std::sin(2.0 * pi * n / count)));
    }
    return ring;
}

} // namespace millwright::test
