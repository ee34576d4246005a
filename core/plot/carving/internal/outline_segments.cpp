#include "core/plot/carving/internal/outline_segments.h"

#include "core/base/error.h"
#include "core/plot/carving/internal/segment_tree.h"
#include "core/plot_strokes/strokes.h"

#include <fmt/format.h>
#include <polyclipping/clipper.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace millwright::plot::internal {
namespace {

constexpr double finest_unit = 1e-6; // mm
constexpr double farthest_mm = 1e6;
constexpr double most_units = 536'870'912.0; // 2^29 on each side of the origin: products fit 64 bits
constexpr std::size_t most_outline_segments = 1'000'000;
constexpr double units_per_tolerance = 10.0;

using UnitRing = std::vector<UnitPoint>;

Extents box_of(const Region& drawn) {
    std::optional<Extents> box;
    std::size_t count = 0;
    for (const Ring& ring : drawn) {
        count += ring.size();
        for (const Vec2& p : ring) {
            if (!(p.cwiseAbs().maxCoeff() <= farthest_mm)) {
                throw Error(fmt::format("an outline has a point at ({:g}, {:g}) mm", p.x(), p.y()),
                            {},
                            "use coordinates within 1 km of the origin");
            }
            if (!box) {
                box = Extents{p, p};
            }
            box->lower = box->lower.cwiseMin(p);
            box->upper = box->upper.cwiseMax(p);
        }
    }
    if (count > most_outline_segments) {
        throw Error(fmt::format("the outlines have {} points, but at most {} can be carved",
                                count,
                                most_outline_segments),
                    {},
                    "use coarser chords to reduce the number of points");
    }
    return box.value_or(Extents{});
}

double unit_for(const Extents& box, double tolerance) {
    const double half = 0.5 * (box.upper - box.lower).maxCoeff();
    double unit = finest_unit;
    while (half > most_units * unit) {
        unit *= 2.0;
    }
    if (unit * units_per_tolerance > tolerance) {
        throw Error(
            fmt::format("outlines {:.6g} mm wide can be carved to a tolerance of {:.2g} mm, not of {:g} mm",
                        2.0 * half,
                        unit * units_per_tolerance,
                        tolerance),
            {},
            "use a smaller drawing or a larger tolerance");
    }
    return unit;
}

UnitRing in_units(const Ring& ring, const Vec2& origin, double unit) {
    UnitRing units;
    for (const Vec2& p : ring) {
        const Vec2 q = (p - origin) / unit;
        const UnitPoint at{static_cast<std::int32_t>(std::lround(q.x())),
                           static_cast<std::int32_t>(std::lround(q.y()))};
        if (units.empty() || units.back() != at) {
            units.push_back(at);
        }
    }
    while (units.size() > 1 && units.back() == units.front()) {
        units.pop_back();
    }
    return units;
}

bool is_flat(const UnitRing& ring) {
    for (std::size_t n = 2; n < ring.size(); ++n) {
        if (turn(ring[0], ring[1], ring[n]) != 0) {
            return false;
        }
    }
    return true;
}

/// Without the points in the middle of straight sides.
UnitRing corners_of(const UnitRing& ring) {
    UnitRing corners;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const UnitPoint& before =
            corners.empty() ? ring[(n + ring.size() - 1) % ring.size()] : corners.back();
        const UnitPoint& after = ring[(n + 1) % ring.size()];
        const bool between = std::min(before, after) < ring[n] && ring[n] < std::max(before, after);
        if (turn(before, ring[n], after) != 0 || !between) {
            corners.push_back(ring[n]);
        }
    }
    return corners;
}

/// The same for a ring that begins elsewhere, also in the middle of a side, or runs backwards.
UnitRing canonical(const UnitRing& drawn) {
    UnitRing ring = corners_of(drawn);
    std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
    if (ring.size() > 2 && ring.back() < ring[1]) {
        std::reverse(ring.begin() + 1, ring.end());
    }
    return ring;
}

void note_place(OutlineFindings& found, const Vec2& place) {
    if (found.count == 0) {
        found.first = place;
    }
    ++found.count;
}

std::vector<OutlineSegment> segments_of(const std::vector<UnitRing>& rings) {
    std::vector<OutlineSegment> segments;
    for (std::size_t n = 0; n < rings.size(); ++n) {
        for (std::size_t k = 0; k < rings[n].size(); ++k) {
            segments.push_back({rings[n][k], rings[n][(k + 1) % rings[n].size()], static_cast<int>(n)});
        }
    }
    return segments;
}

/// By the even-odd rule. Where rings cross, the crossing is rounded.
std::vector<UnitRing> united(const std::vector<UnitRing>& rings) {
    ClipperLib::Clipper clipper;
    for (const UnitRing& ring : rings) {
        ClipperLib::Path path;
        for (const auto& [x, y] : ring) {
            path.emplace_back(x, y);
        }
        clipper.AddPath(path, ClipperLib::ptSubject, true);
    }
    ClipperLib::Paths paths;
    clipper.Execute(ClipperLib::ctUnion, paths, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
    std::vector<UnitRing> result;
    for (const ClipperLib::Path& path : paths) {
        UnitRing ring;
        for (const ClipperLib::IntPoint& p : path) {
            ring.push_back({static_cast<std::int32_t>(p.X), static_cast<std::int32_t>(p.Y)});
        }
        if (!is_flat(ring)) {
            result.push_back(std::move(ring));
        }
    }
    return result;
}

/// As many segments end in each place as begin there. They go on along their own ring where they can, and are
/// of the new rings then.
std::vector<UnitRing> chained(std::vector<OutlineSegment>& segments) {
    std::map<UnitPoint, std::vector<std::size_t>> from;
    for (std::size_t n = 0; n < segments.size(); ++n) {
        from[segments[n].a].push_back(n);
    }
    const auto take_next = [&](const OutlineSegment& last, int ring) {
        std::vector<std::size_t>& next = from.at(last.b);
        auto chosen = std::ranges::find_if(next, [&](std::size_t n) { return segments[n].ring == ring; });
        chosen = chosen == next.end() ? next.begin() : chosen;
        const std::size_t n = *chosen;
        next.erase(chosen);
        return n;
    };
    std::vector<UnitRing> rings;
    std::vector<int> ring_of(segments.size(), -1);
    for (std::size_t first = 0; first < segments.size(); ++first) {
        if (ring_of[first] >= 0) {
            continue;
        }
        std::erase(from.at(segments[first].a), first);
        UnitRing& ring = rings.emplace_back();
        for (std::size_t n = first;;) {
            ring_of[n] = static_cast<int>(rings.size()) - 1;
            ring.push_back(segments[n].a);
            if (segments[n].b == segments[first].a) {
                break;
            }
            n = take_next(segments[n], segments[n].ring);
        }
    }
    for (std::size_t n = 0; n < segments.size(); ++n) {
        segments[n].ring = ring_of[n];
    }
    return rings;
}

/// Rounded crossings may make lines near them cross anew.
std::vector<UnitRing> without_crossings(std::vector<UnitRing> rings, const Progress& progress) {
    constexpr int most_rounds = 16;
    for (int round = 0; round < most_rounds; ++round) {
        rings = united(rings);
        progress.check();
        if (crossings_of(segments_of(rings), progress).crossing == 0) {
            return rings;
        }
    }
    throw Error("the outlines cross at so many points close together that their inside cannot be determined",
                {},
                "draw them without crossings");
}

} // namespace

OutlineSegments outline_segments(const Region& drawn, double tolerance, const Progress& progress) {
    const Extents box = box_of(drawn);
    OutlineSegments result;
    result.origin = 0.5 * (box.lower + box.upper);
    result.unit = unit_for(box, tolerance);
    std::vector<UnitRing> rings;
    std::set<UnitRing> known;
    for (const Ring& ring : drawn) {
        UnitRing units = in_units(ring, result.origin, result.unit);
        if (units.empty()) {
            continue;
        }
        if (is_flat(units)) {
            note_place(result.flat, ring.front());
        } else if (!known.insert(canonical(units)).second) {
            note_place(result.repeated, ring.front());
        } else {
            rings.push_back(std::move(units));
        }
    }
    progress.check();
    const UnitCrossings crossed = crossings_of(segments_of(rings), progress);
    result.crossings.count = crossed.crossing + crossed.overlapping;
    result.crossings.first = result.origin + result.unit * crossed.first;
    rings = without_crossings(std::move(rings), progress);
    std::vector<OutlineSegment> split = split_at_touches(segments_of(rings), progress);
    const std::size_t before = split.size();
    result.segments = without_shared_sides(std::move(split));
    if (result.segments.size() != before) {
        rings = chained(result.segments);
    }
    for (const UnitRing& ring : rings) {
        Ring& mm = result.rings.emplace_back();
        for (const UnitPoint& p : ring) {
            mm.push_back(result.place(p));
        }
    }
    return result;
}

} // namespace millwright::plot::internal
