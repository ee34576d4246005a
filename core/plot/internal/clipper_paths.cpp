#include "core/plot/internal/clipper_paths.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::plot::internal {
namespace {

constexpr double units_per_mm = 1e6;
constexpr double largest_mm = 1e6; // 1 km
constexpr double miter_limit = 4.0;

} // namespace

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

} // namespace millwright::plot::internal
