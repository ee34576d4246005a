// Which side of closed lines something is on.
#pragma once

#include "core/plot_strokes/region.h"

#include <vector>

namespace millwright::plot::internal {

/// Closed lines cut the plane into faces; two points are in the same one if the same rings are around both.
class Faces {
public:
    explicit Faces(std::vector<Ring> rings);

    /// Whether the straight line from `a` to `b` runs along rings or in the face of `witness` all the way.
    /// Its ends may be on rings.
    [[nodiscard]] bool stays_in_face(const Vec2& a, const Vec2& b, const Vec2& witness) const;

    /// Whether the point is on a ring, so that it is a witness of no face.
    [[nodiscard]] bool on_ring(const Vec2& p) const;

private:
    struct Bounded {
        Region ring; ///< of one ring
        Vec2 lower;
        Vec2 upper;
    };
    [[nodiscard]] std::vector<double> cuts(const Vec2& a, const Vec2& b) const;
    [[nodiscard]] bool same_face(const Vec2& p, const Vec2& q) const;

    std::vector<Bounded> rings_;
};

} // namespace millwright::plot::internal
