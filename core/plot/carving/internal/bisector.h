// The curve of places that are equally far from two sites, each a point or a segment. Any one unit.
#pragma once

#include "core/geometry/vectors.h"

#include <vector>

namespace millwright::plot::internal {

struct Site {
    bool point = false;
    Vec2 a = Vec2::Zero(); ///< the point, or where the segment begins
    Vec2 b = Vec2::Zero(); ///< where it ends
};

/// From `place` to the point, or to the line of the segment.
[[nodiscard]] double clearance(const Site& site, const Vec2& place);

/// A piece of it: a straight line, of two points or two segments, or a parabola.
class Bisector {
public:
    /// `from` and `to` lie on it.
    Bisector(const Site& one, const Site& other, const Vec2& from, const Vec2& to);

    /// x, y and clearance; `t` from 0 at `from` to 1 at `to`.
    [[nodiscard]] Vec3 at(double t) const;

    /// Places whose chords miss x, y and clearance by no more than `tolerance`, both ends among them.
    [[nodiscard]] std::vector<Vec3> sampled(double tolerance) const;

private:
    Site site_; ///< that the clearance is measured from
    Vec2 from_;
    Vec2 to_;
    bool parabola_ = false;
    Vec2 foot_ = Vec2::Zero();   ///< of the point on the line
    Vec2 along_ = Vec2::Zero();  ///< unit vector of the line
    Vec2 across_ = Vec2::Zero(); ///< unit vector from the line to the point
    double height_ = 0.0;        ///< of the point above the line
};

} // namespace millwright::plot::internal
