#include "core/geometry/distance_bounds.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/geometry/bezier_patch.h"
#include "core/geometry/patch_refinement.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace millwright::geometry {

namespace {

/// No point of the net's hull is nearer: by its box, and by the plane across the way to its middle.
double least_distance(const ControlNet& net, const Box3& box, const Vec3& point) {
    const Vec3 way = box.center() - point;
    const double length = way.norm();
    if (!(length > 0.0)) {
        return 0.0;
    }
    double along = infinity;
    for (const Vec3& control : net.points) {
        along = std::min(along, (control - point).dot(way) / length);
    }
    return std::max(along, box.exteriorDistance(point));
}

/// The four corners of a net are on the surface.
double nearest_corner(const ControlNet& net, const Vec3& point) {
    double nearest = infinity;
    for (const int i : {0, net.rows - 1}) {
        for (const int j : {0, net.columns - 1}) {
            nearest = std::min(nearest, (net.point(i, j) - point).norm());
        }
    }
    return nearest;
}

struct PatchPart {
    double at_least;
    int splits; ///< how often it was split
    BezierPatch patch;

    /// The part with the least bound is the first of a heap.
    friend bool operator<(const PatchPart& a, const PatchPart& b) { return a.at_least > b.at_least; }
};

} // namespace

DistanceBounds distance_bounds(
    const ParametricSurface& surface, const Vec3& point, double found, double tolerance, int most_splits) {
    expects(is_finite(point) && std::isfinite(found) && tolerance > 0.0, "a distance is bounded of a point");
    std::priority_queue<PatchPart> open;
    double at_most = found;
    const auto add = [&](BezierPatch part, int splits) {
        at_most = std::min(at_most, nearest_corner(part.net(), point));
        const double at_least = least_distance(part.net(), part.control_box(), point);
        open.push({at_least, splits, std::move(part)});
    };
    for (SurfacePiece& piece : surface.pieces()) {
        add(std::move(piece.patch), 0);
    }
    for (int n = 0; n < most_splits && open.top().at_least < at_most - tolerance; ++n) {
        const PatchPart part = open.top();
        open.pop();
        auto [first, second] = split(part.patch, part.splits % 2 == 0 ? Parameter::u : Parameter::v, 0.5);
        add(std::move(first), part.splits + 1);
        add(std::move(second), part.splits + 1);
    }
    return {std::clamp(open.top().at_least, 0.0, at_most), at_most};
}

} // namespace millwright::geometry
