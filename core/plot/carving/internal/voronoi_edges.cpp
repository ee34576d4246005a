#include "core/plot/carving/internal/voronoi_edges.h"

#include "core/base/quiet_floats.h"
#include "core/geometry/vectors.h"

#include <boost/polygon/voronoi.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace millwright::plot::internal {

// The curve of places that are equally far from two sites, each a point or a segment. Any one unit.

struct Site {
    bool point = false;
    Vec2 a = Vec2::Zero(); ///< the point, or where the segment begins
    Vec2 b = Vec2::Zero(); ///< where it ends
};

/// A piece of it: a straight line, of two points or two segments, or a parabola.
class Bisector {
public:
    /// `from` and `to` lie on it.
    Bisector(const Site& one, const Site& other, const Vec2& from, const Vec2& to);

    /// x, y and clearance; `t` from 0 at `from` to 1 at `to`.
    [[nodiscard]] Vec3 at(double t) const;

    /// Places whose chords miss x, y and clearance by no more than `tolerance`, both ends among them.
    [[nodiscard]] std::vector<Vec3> sampled(double tolerance) const;

private:
    Site site_; ///< that the clearance is measured from
    Vec2 from_;
    Vec2 to_;
    bool parabola_ = false;
    Vec2 foot_ = Vec2::Zero();   ///< of the point on the line
    Vec2 along_ = Vec2::Zero();  ///< unit vector of the line
    Vec2 across_ = Vec2::Zero(); ///< unit vector from the line to the point
    double height_ = 0.0;        ///< of the point above the line
};

namespace {

constexpr double flat_height = 1e-3; ///< of a parabola that is as good as straight, in whole units

/// Half of what a chord of a convex curve may miss in the middle, so that it misses no more anywhere.
void sample_between(const Bisector& curve,
                    double t,
                    const Vec3& from,
                    double u,
                    const Vec3& to,
                    double tolerance,
                    int depth,
                    std::vector<Vec3>& found) {
    constexpr int most_halvings = 20;
    const double middle = 0.5 * (t + u);
    const Vec3 at = curve.at(middle);
    const Vec3 missed = at - 0.5 * (from + to);
    const double off = std::max(missed.head<2>().norm(), std::abs(missed.z()));
    if (off > 0.5 * tolerance && depth < most_halvings) {
        sample_between(curve, t, from, middle, at, tolerance, depth + 1, found);
        sample_between(curve, middle, at, u, to, tolerance, depth + 1, found);
        return;
    }
    found.push_back(to);
}

} // namespace

/// From `place` to the point, or to the line of the segment.
double clearance(const Site& site, const Vec2& place) {
    if (site.point) {
        return (place - site.a).norm();
    }
    const Vec2 along = site.b - site.a;
    return std::abs(cross(along, place - site.a)) / along.norm();
}

Bisector::Bisector(const Site& one, const Site& other, const Vec2& from, const Vec2& to)
    : site_(one.point ? one : other), from_(from), to_(to) {
    if (one.point == other.point) {
        return;
    }
    const Site& line = one.point ? other : one;
    along_ = (line.b - line.a).normalized();
    const Vec2 to_point = site_.a - line.a;
    height_ = std::abs(cross(along_, to_point));
    foot_ = line.a + along_.dot(to_point) * along_;
    if (height_ > flat_height) {
        parabola_ = true;
        across_ = (site_.a - foot_) / height_;
    }
}

Vec3 Bisector::at(double t) const {
    const Vec2 straight = (1.0 - t) * from_ + t * to_;
    if (!parabola_) {
        return {straight.x(), straight.y(), clearance(site_, straight)};
    }
    const double u = along_.dot(straight - foot_);
    const double y = (u * u + height_ * height_) / (2.0 * height_);
    const Vec2 place = foot_ + u * along_ + y * across_;
    return {place.x(), place.y(), y};
}

std::vector<Vec3> Bisector::sampled(double tolerance) const {
    const auto end = [&](const Vec2& place) { return Vec3(place.x(), place.y(), clearance(site_, place)); };
    std::vector<Vec3> found{end(from_)};
    sample_between(*this, 0.0, found.front(), 1.0, end(to_), tolerance, 0, found);
    return found;
}

namespace {

using VoronoiDiagram = boost::polygon::voronoi_diagram<double>;
using BoostEdge = VoronoiDiagram::edge_type;
using BoostCell = VoronoiDiagram::cell_type;
using BoostVertex = VoronoiDiagram::vertex_type;

enum class Where : std::size_t { unknown, inside, outside, on_outline };

Vec2 plane_of(const UnitPoint& p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1])};
}
Vec2 plane_of(const BoostVertex& vertex) {
    return {vertex.x(), vertex.y()};
}

class InsideEdges {
public:
    InsideEdges(const OutlineSegments& outlines, double sampling, const Progress& progress)
        : outlines_(outlines), sampling_(sampling / outlines.unit), progress_(progress) {
        boost::polygon::voronoi_builder<std::int32_t> builder;
        for (const OutlineSegment& s : outlines.segments) {
            builder.insert_segment(s.a[0], s.a[1], s.b[0], s.b[1]);
        }
        const QuietFloats quiet; // its bounds of errors may be infinite
        builder.construct(&diagram_);
        progress_.check();
    }

    std::vector<VoronoiEdge> take() {
        mark_outline();
        mark_beside_segments();
        mark_between_points();
        std::vector<VoronoiEdge> result;
        for_each_edge([&](const BoostEdge& edge) {
            if (where(edge) == Where::inside) {
                result.push_back(curve_of(edge));
            }
        });
        return result;
    }

private:
    /// Each once, those without a direction of their own left out.
    template <class Visit> void for_each_edge(const Visit& visit) const {
        std::size_t n = 0;
        constexpr std::size_t often = 1000;
        for (const BoostEdge& edge : diagram_.edges()) {
            if (++n % often == 0) {
                progress_.check();
            }
            if (edge.is_primary() && edge.is_finite() && &edge < edge.twin()) {
                visit(edge);
            }
        }
    }

    /// Those of for_each_edge() that begin or end there.
    template <class Visit> static void for_each_edge_at(const BoostVertex& vertex, const Visit& visit) {
        const BoostEdge* const first = vertex.incident_edge();
        const BoostEdge* edge = first;
        do {
            if (edge->is_primary() && edge->is_finite()) {
                visit(edge < edge->twin() ? *edge : *edge->twin());
            }
            edge = edge->rot_next();
        } while (edge != first);
    }

    [[nodiscard]] const OutlineSegment& segment_of(const BoostCell& cell) const {
        return outlines_.segments[cell.source_index()];
    }
    [[nodiscard]] Site site_of(const BoostCell& cell) const {
        const OutlineSegment& s = segment_of(cell);
        if (cell.contains_segment()) {
            return {false, plane_of(s.a), plane_of(s.b)};
        }
        const bool start = cell.source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_START_POINT;
        return {true, plane_of(start ? s.a : s.b), Vec2::Zero()};
    }
    [[nodiscard]] Bisector bisector_of(const BoostEdge& edge) const {
        return {site_of(*edge.cell()),
                site_of(*edge.twin()->cell()),
                plane_of(*edge.vertex0()),
                plane_of(*edge.vertex1())};
    }

    static Where where(const BoostVertex& vertex) { return static_cast<Where>(vertex.color()); }
    static Where where(const BoostEdge& edge) { return static_cast<Where>(edge.color()); }
    static void mark(const BoostEdge& edge, Where place) {
        edge.color(static_cast<std::size_t>(place));
        for (const BoostVertex* vertex : {edge.vertex0(), edge.vertex1()}) {
            if (where(*vertex) == Where::unknown) {
                vertex->color(static_cast<std::size_t>(place));
            }
        }
    }

    void mark_outline() const {
        constexpr double nearly = 0.5; // units: no other place in whole units is so near
        for (const BoostVertex& vertex : diagram_.vertices()) {
            if (clearance(site_of(*vertex.incident_edge()->cell()), plane_of(vertex)) < nearly) {
                vertex.color(static_cast<std::size_t>(Where::on_outline));
            }
        }
    }

    /// The inside is at the left of each segment.
    void mark_beside_segments() const {
        for_each_edge([&](const BoostEdge& edge) {
            const bool here = edge.cell()->contains_segment();
            if (!here && !edge.twin()->cell()->contains_segment()) {
                return;
            }
            const OutlineSegment& s = segment_of(here ? *edge.cell() : *edge.twin()->cell());
            const Vec2 a = plane_of(s.a);
            const Vec2 along = plane_of(s.b) - a;
            const Vec2 to = bisector_of(edge).at(0.5).head<2>() - a;
            const double left = along.x() * to.y() - along.y() * to.x();
            mark(edge, left > 0.0 ? Where::inside : Where::outside);
        });
    }

    /// An edge crosses no segment: it is where its ends are.
    void mark_between_points() const {
        std::vector<const BoostVertex*> known;
        for (const BoostVertex& vertex : diagram_.vertices()) {
            if (where(vertex) == Where::inside || where(vertex) == Where::outside) {
                known.push_back(&vertex);
            }
        }
        while (!known.empty()) {
            const BoostVertex& from = *known.back();
            known.pop_back();
            for_each_edge_at(from, [&](const BoostEdge& edge) {
                if (where(edge) == Where::unknown) {
                    const BoostVertex& to = edge.vertex0() == &from ? *edge.vertex1() : *edge.vertex0();
                    const bool is_new = where(to) == Where::unknown;
                    mark(edge, where(from));
                    if (is_new) {
                        known.push_back(&to);
                    }
                }
            });
        }
        std::vector<const BoostEdge*> unknown;
        for_each_edge([&](const BoostEdge& edge) {
            if (where(edge) == Where::unknown) {
                unknown.push_back(&edge);
            }
        });
        for (const BoostEdge* edge : unknown) { // that points alone are near
            const Vec2 middle = bisector_of(*edge).at(0.5).head<2>();
            const bool inside = contains(outlines_.rings, outlines_.origin + outlines_.unit * middle);
            mark(*edge, inside ? Where::inside : Where::outside);
        }
    }

    VoronoiEdge curve_of(const BoostEdge& edge) {
        const BoostVertex& from = *edge.vertex0();
        const BoostVertex& to = *edge.vertex1();
        VoronoiEdge result;
        result.from = number_of(from);
        result.to = number_of(to);
        result.ring = segment_of(*edge.cell()).ring;
        result.other_ring = segment_of(*edge.twin()->cell()).ring;
        for (Vec3 at : bisector_of(edge).sampled(sampling_)) {
            at *= outlines_.unit;
            at.head<2>() += outlines_.origin;
            result.way.push_back(at);
        }
        result.way.front().z() = where(from) == Where::on_outline ? 0.0 : result.way.front().z();
        result.way.back().z() = where(to) == Where::on_outline ? 0.0 : result.way.back().z();
        return result;
    }

    int number_of(const BoostVertex& vertex) {
        return numbers_.emplace(&vertex, static_cast<int>(numbers_.size())).first->second;
    }

    const OutlineSegments& outlines_;
    double sampling_; ///< units
    const Progress& progress_;
    VoronoiDiagram diagram_;
    std::map<const BoostVertex*, int> numbers_; ///< in the order of their edges: the same each time
};

} // namespace

std::vector<VoronoiEdge>
voronoi_edges(const OutlineSegments& outlines, double sampling, const Progress& progress) {
    return InsideEdges(outlines, sampling, progress).take();
}

} // namespace millwright::plot::internal
