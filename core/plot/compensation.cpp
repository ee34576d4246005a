#include "core/plot/compensation.h"

#include "core/base/error.h"
#include "core/plot/internal/point_grid.h"

#include <fmt/format.h>
#include <polyclipping/clipper.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace millwright::plot {
namespace {

// Regions as Clipper has them, in whole numbers of a millionth of a millimetre, and its offsets.

constexpr double units_per_mm = 1e6;
constexpr double largest_mm = 1e6; // 1 km
constexpr double miter_limit = 4.0;

/// Throws Error for what is not finite and for coordinates beyond 1 km.
ClipperLib::Paths to_clipper(const Region& region) {
    ClipperLib::Paths paths;
    for (const Ring& ring : region) {
        ClipperLib::Path& path = paths.emplace_back();
        for (const Vec2& p : ring) {
            if (!(p.cwiseAbs().maxCoeff() <= largest_mm)) {
                throw Error("an outline has a point that is not a number or is farther than 1 km away");
            }
            path.emplace_back(std::llround(p.x() * units_per_mm), std::llround(p.y() * units_per_mm));
        }
    }
    return paths;
}

Region from_clipper(const ClipperLib::Paths& paths) {
    Region region;
    for (const ClipperLib::Path& path : paths) {
        Ring& ring = region.emplace_back();
        for (const ClipperLib::IntPoint& p : path) {
            ring.push_back(Vec2(static_cast<double>(p.X), static_cast<double>(p.Y)) / units_per_mm);
        }
    }
    return region;
}

/// Grown by `distance`, mm; the outermost rings have one sense, those within them turn about. Throws Error
/// for an offset beyond 1 km and an invalid tolerance.
ClipperLib::Paths
offset_paths(const ClipperLib::Paths& paths, double distance, Corners corners, double arc_tolerance) {
    if (!(std::abs(distance) <= largest_mm) || !(arc_tolerance > 0.0)) {
        throw Error(fmt::format(
            "an offset of {} mm with an arc tolerance of {} mm is not possible", distance, arc_tolerance));
    }
    ClipperLib::ClipperOffset clipper(miter_limit, arc_tolerance * units_per_mm);
    clipper.AddPaths(paths,
                     corners == Corners::sharp ? ClipperLib::jtMiter : ClipperLib::jtRound,
                     ClipperLib::etClosedPolygon);
    ClipperLib::Paths found;
    clipper.Execute(found, distance * units_per_mm);
    return found;
}

/// Rings that neither cross nor overlap, outer ones counter-clockwise, holes clockwise.
ClipperLib::Paths simple(const Region& region) {
    ClipperLib::Paths paths = to_clipper(region);
    ClipperLib::SimplifyPolygons(paths, ClipperLib::pftEvenOdd);
    return paths;
}

Strokes closed_strokes(const Region& region, int pen) {
    Strokes strokes;
    for (const Ring& ring : region) {
        Stroke stroke{.pen = pen, .points = ring};
        stroke.points.push_back(ring.front());
        strokes.push_back(std::move(stroke));
    }
    return strokes;
}

/// Clipper begins its rings anywhere and gives them in any order. Here each begins where it is nearest to the
/// beginning of a ring as drawn, and they come in the order of those.
Region begun_as(const Region& drawn, Region found) {
    std::vector<Vec2> begins;
    for (const Ring& ring : drawn) {
        if (!ring.empty()) {
            begins.push_back(ring.front());
        }
    }
    const internal::PointGrid grid(begins);
    std::vector<std::pair<int, Ring>> rings;
    for (Ring& ring : found) {
        std::size_t first = 0;
        int like = -1;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const int near = grid.nearest(ring[n]);
            const double distance = (begins[static_cast<std::size_t>(near)] - ring[n]).norm();
            if (distance < least) {
                least = distance;
                like = near;
                first = n;
            }
        }
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first), ring.end());
        rings.emplace_back(like, std::move(ring));
    }
    std::ranges::stable_sort(rings, {}, &std::pair<int, Ring>::first);
    found.clear();
    for (auto& [like, ring] : rings) {
        found.push_back(std::move(ring));
    }
    return found;
}

} // namespace

Region offset(const Region& region, double distance, Corners corners, double arc_tolerance) {
    return from_clipper(offset_paths(simple(region), distance, corners, arc_tolerance));
}

Strokes compensated(const Region& region, const CompensationSettings& settings, int pen) {
    if (!(settings.tool_diameter > 0.0)) {
        throw Error(fmt::format("the tool diameter {} mm is not valid", settings.tool_diameter));
    }
    if (settings.side == CutterSide::on_line) {
        return closed_strokes(region, pen);
    }
    const double radius = settings.tool_diameter / 2.0;
    const double distance = settings.side == CutterSide::outside ? radius : -radius;
    return closed_strokes(
        begun_as(region, offset(region, distance, settings.corners, settings.arc_tolerance)), pen);
}

Strokes contour_hatch(const Region& region, double first, double pitch, int pen) {
    constexpr int most_contours = 100'000;
    if (!(pitch > 0.0) || !(first >= 0.0)) {
        throw Error("contours need a pitch above 0 and must start at or inside the outline");
    }
    Strokes strokes;
    for (int n = 0; n < most_contours; ++n) {
        // From the outline each time: errors of one contour do not go on to the next.
        const Region ring = offset(region, -(first + n * pitch), Corners::sharp);
        if (ring.empty()) {
            return strokes;
        }
        for (Stroke& stroke : closed_strokes(ring, pen)) {
            strokes.push_back(std::move(stroke));
        }
    }
    throw Error(fmt::format("more than {} contours are needed: the pitch is too small", most_contours));
}

std::size_t count_unreachable_regions(const Region& region, const CompensationSettings& settings) {
    if (settings.side == CutterSide::on_line) {
        return 0;
    }
    ClipperLib::Clipper clipper;
    clipper.AddPaths(to_clipper(region), ClipperLib::ptSubject, true);
    ClipperLib::PolyTree tree;
    clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftEvenOdd);
    const bool holes = settings.side == CutterSide::outside;
    const double radius = settings.tool_diameter / 2.0;
    std::size_t count = 0;
    for (const ClipperLib::PolyNode* part = tree.GetFirst(); part != nullptr; part = part->GetNext()) {
        if (part->IsHole() != holes) {
            continue;
        }
        ClipperLib::Paths rings = {part->Contour};
        for (const ClipperLib::PolyNode* within : part->Childs) {
            rings.push_back(within->Contour);
        }
        const ClipperLib::Paths left = offset_paths(rings, -radius, settings.corners, settings.arc_tolerance);
        count += left.empty() ? 1 : 0;
    }
    return count;
}

} // namespace millwright::plot
