#include "core/plot/linking.h"

#include "core/base/error.h"
#include "core/plot/internal/faces.h"

namespace millwright::plot {
namespace {

/// Whether a link from the end of one stroke to the start of the next is on the side of the outlines that
/// both are on. A stroke on an outline is on no side; two of them are not linked but along it.
bool on_their_side(const internal::Faces& faces, const Stroke& from, const Stroke& to) {
    const Vec2& a = from.points.back();
    const Vec2& b = to.points.front();
    const Vec2 before = (from.points[from.points.size() - 2] + a) / 2.0;
    const Vec2 after = (b + to.points[1]) / 2.0;
    bool known = false;
    for (const Vec2& witness : {before, after}) {
        if (faces.on_ring(witness)) {
            continue;
        }
        known = true;
        if (!faces.stays_in_face(a, b, witness)) {
            return false;
        }
    }
    return known || (a - b).norm() <= 0.0;
}

} // namespace

std::vector<Ring> closed_outlines(const Strokes& strokes, double tolerance) {
    std::vector<Ring> outlines;
    for (const Stroke& stroke : strokes) {
        const bool closed =
            stroke.points.size() > 3 && (stroke.points.front() - stroke.points.back()).norm() < tolerance;
        if (closed) {
            outlines.emplace_back(stroke.points.begin(), stroke.points.end() - 1);
        }
    }
    return outlines;
}

Linked link(const Strokes& strokes, const LinkSettings& settings) {
    if (!(settings.distance >= 0.0)) {
        throw Error("the length of links must be 0 mm or more");
    }
    const internal::Faces faces(settings.outlines);
    Linked linked;
    for (const Stroke& stroke : strokes) {
        Stroke* last = linked.strokes.empty() ? nullptr : &linked.strokes.back();
        const bool lines = last != nullptr && last->points.size() > 1 && stroke.points.size() > 1;
        const double gap = lines ? (stroke.points.front() - last->points.back()).norm() : 0.0;
        const bool near = lines && last->pen == stroke.pen && gap < settings.distance;
        if (near && !settings.outlines.empty() && !on_their_side(faces, *last, stroke)) {
            ++linked.refused;
        } else if (near) {
            const auto from = stroke.points.begin() + (gap > 0.0 ? 0 : 1);
            last->points.insert(last->points.end(), from, stroke.points.end());
            ++linked.links;
            linked.link_length += gap;
            continue;
        }
        linked.strokes.push_back(stroke);
    }
    return linked;
}

} // namespace millwright::plot
