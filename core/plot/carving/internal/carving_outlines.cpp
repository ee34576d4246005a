#include "core/plot/carving/internal/carving_outlines.h"

#include "core/base/counted.h"
#include "core/plot/carving/internal/segment_tree.h"
#include "core/plot/linking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::plot::internal {

CarvingOutlines carving_outlines(const Strokes& drawn, double gap) {
    CarvingOutlines found;
    std::size_t open = 0;
    const Stroke* first = nullptr;
    Strokes others;
    const auto is_closed = [gap](const Stroke& stroke) {
        return stroke.points.size() > 2 && (stroke.points.front() - stroke.points.back()).norm() < gap;
    };
    for (const Stroke& stroke : drawn) {
        if (is_closed(stroke)) { // across the gap, by a line from its last point to its first
            found.region.push_back(stroke.points);
        } else {
            others.push_back(stroke);
        }
    }
    others = rings_joined(others, gap);
    for (const Stroke& stroke : others) {
        if (is_closed(stroke)) {
            found.region.push_back(stroke.points);
        } else if (++open == 1) {
            first = &stroke;
        }
    }
    if (first == nullptr) {
        return found;
    }
    const Vec2& from = first->points.front();
    const Vec2& to = first->points.back();
    Diagnostic notice;
    notice.place.byte = first->byte;
    notice.message = fmt::format("{} {} skipped, the first from ({:.3f}, {:.3f}) to ({:.3f}, {:.3f}) mm, "
                                 "with its ends {:.3f} mm apart",
                                 counted(open, "open stroke"),
                                 open == 1 ? "is" : "are",
                                 from.x(),
                                 from.y(),
                                 to.x(),
                                 to.y(),
                                 (to - from).norm());
    notice.hint = fmt::format(
        "ends up to {:g} mm apart are joined: close the outline, or allow wider gaps to be closed", gap);
    if (found.region.empty()) {
        notice.message = "no outline is closed, so there is nothing to carve: " + notice.message;
        throw Error(notice);
    }
    found.notices.push_back(std::move(notice));
    return found;
}

namespace {

SegmentTree outline_of(const Region& region) {
    std::vector<Segment2> segments;
    for (const Ring& ring : region) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            segments.push_back({ring[n], ring[(n + 1) % ring.size()]});
        }
    }
    return SegmentTree(std::move(segments));
}

} // namespace

double
path_deviation(const CutPath& path, const Region& region, const ToolTip& tip, const Progress& progress) {
    const SegmentTree outline = outline_of(region);
    std::optional<double> worst;
    for (std::size_t n = 1; n < path.size(); ++n) {
        constexpr std::size_t often = 1000;
        if (n % often == 0) {
            progress.check();
        }
        const bool cuts = path[n].move == CutMove::cut;
        if (!cuts && path[n].move != CutMove::plunge) {
            continue;
        }
        const Vec3& from = cuts ? path[n - 1].at : path[n].at;
        for (const double t : {0.25, 0.5, 0.75, 1.0}) {
            const Vec3 at = from + t * (path[n].at - from);
            if (at.z() < 0.0) {
                const Vec2 place = at.head<2>();
                const double distance = outline.distance(place);
                const double room = outline.surrounds(place) ? distance : -distance;
                const double beyond = mouth_radius(tip, -at.z()) - room;
                worst = std::max(worst.value_or(beyond), beyond);
            }
        }
    }
    return worst.value_or(0.0);
}

} // namespace millwright::plot::internal
