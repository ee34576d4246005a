#include "core/plot/linking.h"

#include "core/base/error.h"
#include "core/plot_strokes/region.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::plot {

namespace {

// Which side of closed lines something is on.

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

constexpr double on_ring_mm = 1e-6; // hatch lines end on outlines, as exactly as they are computed

/// Where the line a + t (b - a) meets the edge from c to d, if it does between its ends.
std::optional<double> crossing(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const Vec2 u = b - a;
    const Vec2 v = d - c;
    const Vec2 w = c - a;
    const double cross = u.x() * v.y() - u.y() * v.x();
    constexpr double nearly_parallel = 1e-12;
    if (!(std::abs(cross) > nearly_parallel * u.norm() * v.norm())) {
        return std::nullopt;
    }
    const double t = (w.x() * v.y() - w.y() * v.x()) / cross;
    const double s = (w.x() * u.y() - w.y() * u.x()) / cross;
    return t > 0.0 && t < 1.0 && s >= 0.0 && s <= 1.0 ? std::optional(t) : std::nullopt;
}

double distance_to_edge(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 ab = b - a;
    const double t = ab.squaredNorm() > 0.0 ? std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0) : 0.0;
    return (a + t * ab - p).norm();
}

template <class Visit> void for_each_edge(const Ring& ring, const Visit& visit) {
    for (std::size_t n = 0; n < ring.size(); ++n) {
        visit(ring[n], ring[(n + 1) % ring.size()]);
    }
}

Faces::Faces(std::vector<Ring> rings) {
    for (Ring& ring : rings) {
        if (ring.empty()) {
            continue;
        }
        Vec2 lower = ring.front();
        Vec2 upper = ring.front();
        for (const Vec2& p : ring) {
            lower = lower.cwiseMin(p);
            upper = upper.cwiseMax(p);
        }
        rings_.push_back({.ring = {std::move(ring)}, .lower = lower, .upper = upper});
    }
}

bool Faces::on_ring(const Vec2& p) const {
    bool on = false;
    for (const Bounded& bounded : rings_) {
        const bool far =
            (p - bounded.upper).maxCoeff() > on_ring_mm || (bounded.lower - p).maxCoeff() > on_ring_mm;
        if (!far && !on) {
            for_each_edge(bounded.ring.front(), [&](const Vec2& a, const Vec2& b) {
                on = on || distance_to_edge(p, a, b) <= on_ring_mm;
            });
        }
    }
    return on;
}

std::vector<double> Faces::cuts(const Vec2& a, const Vec2& b) const {
    std::vector<double> cuts = {0.0, 1.0};
    const Vec2 lower = a.cwiseMin(b);
    const Vec2 upper = a.cwiseMax(b);
    for (const Bounded& bounded : rings_) {
        if ((lower - bounded.upper).maxCoeff() > 0.0 || (bounded.lower - upper).maxCoeff() > 0.0) {
            continue;
        }
        for_each_edge(bounded.ring.front(), [&](const Vec2& c, const Vec2& d) {
            if (const auto t = crossing(a, b, c, d)) {
                cuts.push_back(*t);
            }
        });
    }
    std::ranges::sort(cuts);
    return cuts;
}

bool Faces::same_face(const Vec2& p, const Vec2& q) const {
    return std::ranges::all_of(rings_, [&](const Bounded& bounded) {
        const auto around = [&](const Vec2& point) {
            const bool outside =
                (point - bounded.upper).maxCoeff() > 0.0 || (bounded.lower - point).maxCoeff() > 0.0;
            return !outside && contains(bounded.ring, point);
        };
        return around(p) == around(q);
    });
}

bool Faces::stays_in_face(const Vec2& a, const Vec2& b, const Vec2& witness) const {
    const std::vector<double> pieces = cuts(a, b);
    for (std::size_t n = 1; n < pieces.size(); ++n) {
        const Vec2 middle = a + 0.5 * (pieces[n - 1] + pieces[n]) * (b - a);
        if (!on_ring(middle) && !same_face(middle, witness)) {
            return false;
        }
    }
    return true;
}

/// Whether a link from the end of one stroke to the start of the next is on the side of the outlines that
/// both are on. A stroke on an outline is on no side; two of them are not linked but along it.
bool on_their_side(const Faces& faces, const Stroke& from, const Stroke& to) {
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
    const Faces faces(settings.outlines);
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

namespace {

/// Ends have numbers: 2 n is where stroke n begins, 2 n + 1 where it ends.
class Ends {
public:
    Ends(const Strokes& strokes, double tolerance) : strokes_(strokes), tolerance_(tolerance) {
        for (std::size_t n = 0; n < strokes.size(); ++n) {
            if (strokes[n].points.size() > 1 && closed_outlines({strokes[n]}).empty()) {
                cells_[cell_of(at(2 * n))].push_back(2 * n);
                cells_[cell_of(at(2 * n + 1))].push_back(2 * n + 1);
            }
        }
    }

    [[nodiscard]] bool is_open(std::size_t stroke) const {
        const auto found = cells_.find(cell_of(at(2 * stroke)));
        return found != cells_.end() && std::ranges::find(found->second, 2 * stroke) != found->second.end();
    }

    /// The one other end there, of the same pen; nothing if there is none or are several.
    [[nodiscard]] std::optional<std::size_t> partner(std::size_t end) const {
        std::optional<std::size_t> found;
        const auto [x, y] = cell_of(at(end));
        for (std::int64_t row = y - 1; row <= y + 1; ++row) {
            for (std::int64_t column = x - 1; column <= x + 1; ++column) {
                const auto cell = cells_.find({column, row});
                if (cell == cells_.end()) {
                    continue;
                }
                for (const std::size_t other : cell->second) {
                    if (!touches(end, other)) {
                        continue;
                    }
                    if (found) {
                        return std::nullopt;
                    }
                    found = other;
                }
            }
        }
        return found;
    }

private:
    [[nodiscard]] const Vec2& at(std::size_t end) const {
        const std::vector<Vec2>& points = strokes_[end / 2].points;
        return end % 2 == 0 ? points.front() : points.back();
    }
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> cell_of(const Vec2& point) const {
        return {static_cast<std::int64_t>(std::floor(point.x() / tolerance_)),
                static_cast<std::int64_t>(std::floor(point.y() / tolerance_))};
    }
    [[nodiscard]] bool touches(std::size_t end, std::size_t other) const {
        return other != end && strokes_[other / 2].pen == strokes_[end / 2].pen &&
               (at(other) - at(end)).norm() <= tolerance_;
    }

    const Strokes& strokes_;
    double tolerance_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> cells_;
};

/// The ends at which the strokes of the ring that begins with `stroke` are entered; empty: there is none.
std::vector<std::size_t> ring_from(const Ends& ends, std::size_t stroke, std::size_t count) {
    std::vector<std::size_t> entries{2 * stroke};
    while (entries.size() <= count) {
        const std::size_t exit = entries.back() ^ 1U;
        const auto next = ends.partner(exit);
        if (!next || ends.partner(*next) != exit) {
            return {};
        }
        if (*next == entries.front()) {
            return entries;
        }
        entries.push_back(*next);
    }
    return {};
}

Stroke joined(const Strokes& strokes, const std::vector<std::size_t>& entries) {
    Stroke ring = strokes[entries.front() / 2];
    for (std::size_t n = 1; n < entries.size(); ++n) {
        std::vector<Vec2> points = strokes[entries[n] / 2].points;
        if (entries[n] % 2 == 1) {
            std::ranges::reverse(points);
        }
        ring.points.insert(ring.points.end(), points.begin() + 1, points.end());
    }
    ring.points.back() = ring.points.front();
    return ring;
}

} // namespace

Strokes rings_joined(const Strokes& strokes, double tolerance) {
    const Ends ends(strokes, tolerance);
    std::vector<bool> done(strokes.size(), false);
    Strokes result;
    for (std::size_t n = 0; n < strokes.size(); ++n) {
        if (done[n]) {
            continue;
        }
        const auto entries =
            ends.is_open(n) ? ring_from(ends, n, strokes.size()) : std::vector<std::size_t>();
        Stroke ring = entries.empty() ? strokes[n] : joined(strokes, entries);
        if (ring.points.size() <= 3) { // there and back
            ring = strokes[n];
        } else {
            for (const std::size_t entry : entries) {
                done[entry / 2] = true;
            }
        }
        result.push_back(std::move(ring));
    }
    return result;
}

Strokes outlines_for(const Strokes& drawn, const StrokePlan& plan) {
    const bool asked =
        plan.compensates() || plan.hatch_pitch || plan.contour_pitch || (plan.link > 0.0 && plan.link_inside);
    if (!asked) {
        return drawn;
    }
    Strokes outlines = rings_joined(drawn);
    if (plan.compensates() && closed_outlines(outlines).empty()) {
        throw Error("no stroke is closed, so there is no inside or outside to follow",
                    {},
                    "cut on the line, or draw outlines whose ends meet");
    }
    return outlines;
}

} // namespace millwright::plot
