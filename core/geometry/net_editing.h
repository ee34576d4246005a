// Control nets as a whole: edited on both sides at once, and turned about z.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/bspline_surface.h"

#include <compare>
#include <vector>

namespace millwright::geometry {

// Editing both sides of a net at once: what happens to a control point happens mirrored to its image in the
// net. Sides are those of the net, so that a net that is not symmetric keeps its own shape.

/// Along which axes of the workpiece both sides are edited.
struct NetSymmetry {
    bool x = false;
    bool y = false;

    friend bool operator==(const NetSymmetry&, const NetSymmetry&) = default;
};

/// A control point by its row and column.
struct NetPlace {
    int i = 0;
    int j = 0;

    friend auto operator<=>(const NetPlace&, const NetPlace&) = default;
};

/// The place and its images, ascending, each once.
[[nodiscard]] std::vector<NetPlace>
images(const ControlNet& net, const NetSymmetry& symmetry, const NetPlace& place);

/// On which side of the middle of the net a control point lies: -1, 0 or 1 in x and y where `symmetry` counts
/// them, else 1. An axis runs along the direction of the net that goes farther along it.
[[nodiscard]] Vec2 side_of(const ControlNet& net, const NetSymmetry& symmetry, const NetPlace& place);

/// What a control point on `side` takes of the way of one on the side `leads`, in each coordinate: all, its
/// opposite, or nothing in the middle.
[[nodiscard]] Vec3 share_of_way(const Vec2& side, const Vec2& leads);

// Control nets turned about z through their origin, counter-clockwise seen from above.

/// `turn` in rad.
[[nodiscard]] ControlNet turned(ControlNet net, double turn);
[[nodiscard]] BsplineNet turned(BsplineNet net, double turn);

} // namespace millwright::geometry
