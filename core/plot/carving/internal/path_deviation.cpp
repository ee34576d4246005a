#include "core/plot/carving/internal/path_deviation.h"

#include "core/plot/carving/internal/segment_tree.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::plot::internal {
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
