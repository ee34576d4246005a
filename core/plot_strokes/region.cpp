#include "core/plot_strokes/region.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace millwright::plot {

bool contains(const Region& region, const Vec2& point) {
    bool inside = false;
    for (const Ring& ring : region) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const Vec2& a = ring[n];
            const Vec2& b = ring[(n + 1) % ring.size()];
            if ((a.y() <= point.y()) != (b.y() <= point.y())) {
                const double t = (point.y() - a.y()) / (b.y() - a.y());
                inside ^= point.x() < a.x() + t * (b.x() - a.x());
            }
        }
    }
    return inside;
}

namespace {

/// Where a hatch line (number k) crosses an edge, counted along the line.
struct Crossing {
    double k = 0.0;
    double u = 0.0;
};

/// u along the lines, v across them in pitches: line k is v = k.
struct LineFrame {
    Vec2 along;
    Vec2 across;
    Vec2 origin;
    double pitch;

    LineFrame(const HatchSettings& settings, double angle)
        : along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x()), origin(settings.origin),
          pitch(settings.pitch) {}
    [[nodiscard]] Vec2 in(const Vec2& p) const {
        const Vec2 d = p - origin;
        return {along.dot(d), across.dot(d) / pitch};
    }
    [[nodiscard]] Vec2 out(double u, double k) const { return origin + u * along + (k * pitch) * across; }
};

// Half open, so that a line through a vertex counts once: lower end in, upper end out.
void add_crossings(const Vec2& a, const Vec2& b, std::vector<Crossing>& crossings) {
    const double low = std::min(a.y(), b.y());
    const double high = std::max(a.y(), b.y());
    for (double k = std::ceil(low); k < high; k += 1.0) {
        crossings.push_back({k, a.x() + (b.x() - a.x()) * ((k - a.y()) / (b.y() - a.y()))});
    }
}

void hatch_at(const Region& region, const LineFrame& frame, int pen, Strokes& strokes) {
    std::vector<Crossing> crossings;
    for (const Ring& ring : region) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            add_crossings(frame.in(ring[n]), frame.in(ring[(n + 1) % ring.size()]), crossings);
        }
    }
    std::ranges::sort(crossings, [](const Crossing& a, const Crossing& b) {
        return a.k < b.k || (!(b.k < a.k) && a.u < b.u);
    });
    bool backwards = false;
    for (std::size_t from = 0; from < crossings.size();) {
        std::size_t to = from;
        while (to < crossings.size() && !(crossings[to].k > crossings[from].k)) {
            ++to;
        }
        const auto piece = [&](std::size_t n) {
            const double k = crossings[from].k;
            Stroke stroke{.pen = pen,
                          .points = {frame.out(crossings[n].u, k), frame.out(crossings[n + 1].u, k)}};
            if (backwards) {
                std::ranges::reverse(stroke.points);
            }
            return stroke;
        };
        const std::size_t pieces = (to - from) / 2;
        for (std::size_t n = 0; n < pieces; ++n) {
            const std::size_t pair = from + 2 * (backwards ? pieces - 1 - n : n);
            if (crossings[pair + 1].u > crossings[pair].u) {
                strokes.push_back(piece(pair));
            }
        }
        backwards = !backwards;
        from = to;
    }
}

void check_hatch_settings(const Region& region, const HatchSettings& settings) {
    if (!(settings.pitch > 0.0) || !std::isfinite(settings.pitch) || !std::isfinite(settings.angle) ||
        !is_finite(settings.origin)) {
        throw Error("a hatch needs a pitch above 0, and a finite angle and origin");
    }
    for (const Ring& ring : region) {
        if (!std::ranges::all_of(ring, [](const Vec2& p) { return is_finite(p); })) {
            throw Error("a region to be hatched has a point that is not a number");
        }
    }
}

} // namespace

double line_count(const Region& region, const HatchSettings& settings) {
    check_hatch_settings(region, settings);
    const LineFrame frame(settings, settings.angle);
    double low = 0.0;
    double high = 0.0;
    bool first = true;
    for (const Ring& ring : region) {
        for (const Vec2& point : ring) {
            const double v = frame.in(point).y();
            low = first ? v : std::min(low, v);
            high = first ? v : std::max(high, v);
            first = false;
        }
    }
    return first ? 0.0 : high - low + 1.0;
}

Strokes hatch(const Region& region, const HatchSettings& settings, int pen) {
    check_hatch_settings(region, settings);
    Strokes strokes;
    hatch_at(region, LineFrame(settings, settings.angle), pen, strokes);
    if (settings.cross) {
        hatch_at(region, LineFrame(settings, settings.angle + pi / 2.0), pen, strokes);
    }
    return strokes;
}

} // namespace millwright::plot
