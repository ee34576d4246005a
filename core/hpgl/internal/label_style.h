// How labels look: size, direction, slant, spacing, origin (SI SR DI DR DV SL ES LO).
#pragma once

#include "core/geometry/vectors.h"

namespace millwright::hpgl::internal {

struct LabelStyle {
    bool size_relative = false;
    Vec2 size = Vec2(0.187, 0.269); ///< cm, HP's on an A4 sheet; if relative percent of the span P1 to P2
    bool direction_relative = false;
    Vec2 direction = Vec2(1.0, 0.0);
    int path = 0;                ///< DV: 0 to the right, 1 down, 2 to the left, 3 up
    double slant = 0.0;          ///< tangent of the angle to upright
    Vec2 extra = Vec2(0.0, 0.0); ///< added to the cell, in cells
    int origin = 1;
    Vec2 line_start = Vec2::Zero(); ///< where a carriage return goes to, plotter units
    Vec2 label_end = Vec2::Zero();  ///< where the last label ended, plotter units
};

} // namespace millwright::hpgl::internal
