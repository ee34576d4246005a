#include "core/exchange/internal/visible_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace millwright::exchange {

Vec3 mean_direction(const TriangleMesh& mesh) {
    constexpr double closed =
        1e-3; // of the whole area: what rounding leaves of a closed body's sum of normals
    Vec3 sum = Vec3::Zero();
    double area = 0.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const Vec3 normal = mesh.doubled_area(n);
        sum += normal;
        area += normal.norm();
    }
    return sum.norm() > closed * area ? Vec3(sum.normalized()) : Vec3(Vec3::UnitZ());
}

namespace {

/// Some triangles of a mesh, with only the points that they have.
class PartOfMesh {
public:
    explicit PartOfMesh(const TriangleMesh& whole) : whole_(whole), place_(whole.points.size(), -1) {}

    void add(std::size_t n) {
        std::array<int, 3> triangle = whole_.triangles[n];
        for (int& corner : triangle) {
            int& at = place_[static_cast<std::size_t>(corner)];
            if (at < 0) {
                at = static_cast<int>(part_.points.size());
                part_.points.push_back(whole_.points[static_cast<std::size_t>(corner)]);
                numbers_.push_back(corner);
            }
            corner = at;
        }
        part_.triangles.push_back(triangle);
    }
    [[nodiscard]] TriangleMesh take_mesh() { return std::move(part_); }
    [[nodiscard]] std::vector<int> take_numbers() { return std::move(numbers_); }

private:
    const TriangleMesh& whole_;
    std::vector<int> place_;
    TriangleMesh part_;
    std::vector<int> numbers_;
};

} // namespace

VisibleSide visible_side(const TriangleMesh& mesh, const Vec3& along) {
    constexpr double sideways = 1e-3; // sine of the angle between a triangle and the line of sight
    VisibleSide side;
    PartOfMesh seen(mesh);
    PartOfMesh left_out(mesh);
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const Vec3 normal = mesh.doubled_area(n);
        const bool is_seen = normal.dot(along) > sideways * normal.norm();
        (is_seen ? side.area : side.left_out_area) += 0.5 * normal.norm();
        (is_seen ? seen : left_out).add(n);
    }
    side.mesh = seen.take_mesh();
    side.numbers = seen.take_numbers();
    side.left_out = left_out.take_mesh();
    return side;
}

namespace {

/// Counter-clockwise; Andrew's monotone chain.
std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
    const auto before = [](const Vec2& a, const Vec2& b) {
        return std::tuple(a.x(), a.y()) < std::tuple(b.x(), b.y());
    };
    std::ranges::sort(points, before);
    std::vector<Vec2> hull;
    const auto chain = [&](const auto& way) {
        const std::size_t start = hull.size();
        for (const Vec2& point : way) {
            while (hull.size() >= start + 2 &&
                   cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0) {
                hull.pop_back();
            }
            hull.push_back(point);
        }
        hull.pop_back(); // the other chain begins there
    };
    chain(points);
    std::ranges::reverse(points);
    chain(points);
    return hull;
}

struct FlatRectangle {
    Vec2 corner = Vec2::Zero();
    Vec2 direction = Vec2::UnitX(); ///< unit, of the first side
    Vec2 size = Vec2::Zero();

    [[nodiscard]] double area() const { return size.prod(); }
};

FlatRectangle around(const std::vector<Vec2>& points, const Vec2& direction) {
    const Vec2 across(-direction.y(), direction.x());
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
    Vec2 high = -low;
    for (const Vec2& point : points) {
        const Vec2 place(point.dot(direction), point.dot(across));
        low = low.cwiseMin(place);
        high = high.cwiseMax(place);
    }
    return {low.x() * direction + low.y() * across, direction, high - low};
}

/// A side of the least rectangle lies on a side of the hull (Freeman and Shapira 1975).
FlatRectangle least_around(const std::vector<Vec2>& points) {
    constexpr double hardly_larger = 1.001;
    const std::vector<Vec2> hull = convex_hull(points);
    const FlatRectangle upright = around(hull, Vec2::UnitX());
    FlatRectangle least = upright;
    for (std::size_t n = 0; n < hull.size(); ++n) {
        const Vec2 side = hull[(n + 1) % hull.size()] - hull[n];
        if (side.norm() > 0.0) {
            const FlatRectangle here = around(hull, side.normalized());
            least = here.area() < least.area() ? here : least;
        }
    }
    return upright.area() <= hardly_larger * least.area() ? upright : least;
}

} // namespace

std::optional<Rectangle> least_rectangle(const std::vector<Vec3>& points, const Vec3& along) {
    constexpr double thinnest = 1e-9; // of its length
    const bool along_x = std::abs(along.x()) > 0.9;
    const Vec3 reference = along_x ? Vec3::UnitY() : Vec3::UnitX();
    const Vec3 x = (reference - reference.dot(along) * along).normalized();
    const Vec3 y = along.cross(x);
    std::vector<Vec2> flat;
    flat.reserve(points.size());
    for (const Vec3& point : points) {
        flat.emplace_back(point.dot(x), point.dot(y));
    }
    const FlatRectangle least = least_around(flat);
    if (!(least.size.minCoeff() > thinnest * least.size.maxCoeff())) {
        return std::nullopt;
    }
    double height = std::numeric_limits<double>::infinity();
    for (const Vec3& point : points) {
        height = std::min(height, point.dot(along));
    }
    const auto in_space = [&](const Vec2& p) { return Vec3(p.x() * x + p.y() * y); };
    const Vec2 across(-least.direction.y(), least.direction.x());
    Rectangle result{in_space(least.corner) + height * along,
                     in_space(least.size.x() * least.direction),
                     in_space(least.size.y() * across)};
    // Quarter turns until u looks where x does.
    for (int turn = 0; turn < 3 && !(result.u.normalized().dot(x) > std::sqrt(0.5) - 1e-12); ++turn) {
        result = {result.corner + result.u, result.v, -result.u};
    }
    return result;
}

namespace {

using Loop = std::vector<Vec2>; ///< as seen, mm; the mesh lies to its left

std::vector<Vec2> seen_from(const std::vector<Vec3>& points, const Vec3& along) {
    const Vec3 u = along.unitOrthogonal();
    const Vec3 v = along.cross(u);
    std::vector<Vec2> seen;
    seen.reserve(points.size());
    for (const Vec3& point : points) {
        seen.emplace_back(point.dot(u), point.dot(v));
    }
    return seen;
}

/// Where several meet in a point, each goes on with any of the others.
std::vector<Loop> loops_of(const TriangleMesh& mesh, const std::vector<Vec2>& seen) {
    std::set<std::pair<int, int>> edges;
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.emplace(triangle[k], triangle[(k + 1) % 3]);
        }
    }
    std::multimap<int, int> next;
    for (const auto& [from, to] : edges) {
        if (!edges.contains({to, from})) {
            next.emplace(from, to);
        }
    }
    std::vector<Loop> loops;
    while (!next.empty()) {
        Loop& loop = loops.emplace_back();
        for (auto edge = next.begin(); edge != next.end();) {
            loop.push_back(seen[static_cast<std::size_t>(edge->first)]);
            const int to = edge->second;
            next.erase(edge);
            edge = next.find(to);
        }
    }
    return loops;
}

double doubled_area(const Loop& loop) {
    double sum = 0.0;
    for (std::size_t n = 0; n < loop.size(); ++n) {
        const Vec2& a = loop[n];
        const Vec2& b = loop[(n + 1) % loop.size()];
        sum += a.x() * b.y() - a.y() * b.x();
    }
    return sum;
}

/// Least and largest, mm.
std::pair<double, double> widths_of(const Loop& loop) {
    constexpr int directions = 36;
    std::pair<double, double> widths{std::numeric_limits<double>::infinity(), 0.0};
    for (int k = 0; k < directions; ++k) {
        const double angle = std::numbers::pi * k / directions;
        const Vec2 way(std::cos(angle), std::sin(angle));
        const auto [low, high] = std::ranges::minmax(loop, {}, [&](const Vec2& at) { return at.dot(way); });
        const double width = (high - low).dot(way);
        widths = {std::min(widths.first, width), std::max(widths.second, width)};
    }
    return widths;
}

bool contains(const Loop& loop, const Vec2& at) {
    bool inside = false;
    for (std::size_t n = 0; n < loop.size(); ++n) {
        const Vec2& a = loop[n];
        const Vec2& b = loop[(n + 1) % loop.size()];
        const bool crosses = (a.y() > at.y()) != (b.y() > at.y());
        if (crosses && at.x() < a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
            inside = !inside;
        }
    }
    return inside;
}

/// Of a raster over its box.
std::vector<Vec2> points_inside(const Loop& loop) {
    constexpr int steps = 9;
    Eigen::AlignedBox2d box;
    for (const Vec2& at : loop) {
        box.extend(at);
    }
    std::vector<Vec2> points;
    for (int n = 0; n < steps * steps; ++n) {
        const Vec2 share((n % steps + 0.5) / steps, (static_cast<double>(n / steps) + 0.5) / steps);
        const Vec2 at = box.min() + box.sizes().cwiseProduct(share);
        if (contains(loop, at)) {
            points.push_back(at);
        }
    }
    return points;
}

bool covers(const TriangleMesh& mesh, const std::vector<Vec2>& seen, const Vec2& at) {
    return std::ranges::any_of(mesh.triangles, [&](const std::array<int, 3>& triangle) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2& a = seen[static_cast<std::size_t>(triangle[k])];
            const Vec2 edge = seen[static_cast<std::size_t>(triangle[(k + 1) % 3])] - a;
            const Vec2 way = at - a;
            if (edge.x() * way.y() - edge.y() * way.x() < 0.0) {
                return false;
            }
        }
        return true;
    });
}

/// Half of what is seen through it is none of the mesh.
bool is_open(const Loop& hole, const TriangleMesh& mesh, const std::vector<Vec2>& seen) {
    const std::vector<Vec2> points = points_inside(hole);
    const auto covered =
        std::ranges::count_if(points, [&](const Vec2& at) { return covers(mesh, seen, at); });
    return 2 * covered < std::ssize(points);
}

double length_of(const Loop& loop) {
    double length = 0.0;
    for (std::size_t n = 0; n < loop.size(); ++n) {
        length += (loop[(n + 1) % loop.size()] - loop[n]).norm();
    }
    return length;
}

/// The points of the loop at equal steps of its length.
Loop evenly_spread(const Loop& loop, int count) {
    const double step = length_of(loop) / count;
    Loop spread;
    double passed = 0.0;
    for (std::size_t n = 0; n < loop.size(); ++n) {
        const Vec2 edge = loop[(n + 1) % loop.size()] - loop[n];
        const double length = edge.norm();
        for (; std::ssize(spread) < count && step * static_cast<double>(spread.size()) <= passed + length;) {
            const double behind = step * static_cast<double>(spread.size()) - passed;
            spread.emplace_back(loop[n] + (length > 0.0 ? behind / length : 0.0) * edge);
        }
        passed += length;
    }
    return spread;
}

/// Between chords of a fiftieth of the outline on both sides, so that the steps of a raster are none.
int corner_count(const Loop& outline) {
    constexpr int count = 400;
    constexpr std::size_t chord = count / 50;
    constexpr double least_turn = std::numbers::pi / 4.0;
    const Loop points = evenly_spread(outline, count);
    if (points.size() < count) {
        return 0;
    }
    std::vector<char> turns(count);
    for (std::size_t n = 0; n < count; ++n) {
        const Vec2 before = points[n] - points[(n + count - chord) % count];
        const Vec2 behind = points[(n + chord) % count] - points[n];
        const double turn = std::atan2(before.x() * behind.y() - before.y() * behind.x(), before.dot(behind));
        turns[n] = std::abs(turn) >= least_turn ? 1 : 0;
    }
    int corners = 0;
    for (std::size_t n = 0; n < count; ++n) {
        corners += turns[n] != 0 && turns[(n + count - 1) % count] == 0 ? 1 : 0;
    }
    return corners;
}

} // namespace

MeshOutlines outlines_of(const TriangleMesh& mesh, const Vec3& along) {
    constexpr double least_width = 0.2; // mm: a narrower gap is one between triangles that should meet
    constexpr std::ptrdiff_t most_holes = 100;
    const std::vector<Vec2> seen = seen_from(mesh.points, along);
    MeshOutlines found;
    std::vector<std::pair<double, Loop>> gaps;
    const Loop* longest = nullptr;
    const std::vector<Loop> loops = loops_of(mesh, seen);
    for (const Loop& loop : loops) {
        const auto [least, most] = widths_of(loop);
        if (doubled_area(loop) < 0.0 && least >= least_width) {
            gaps.emplace_back(most, loop);
        } else if (longest == nullptr || length_of(loop) > length_of(*longest)) {
            longest = &loop;
        }
    }
    found.corners = longest != nullptr ? corner_count(*longest) : 0;
    std::ranges::sort(gaps, std::greater{}, &std::pair<double, Loop>::first);
    for (const auto& [width, loop] : gaps) {
        if (std::ssize(found.holes) < most_holes && is_open(loop, mesh, seen)) {
            found.holes.push_back(width);
        }
    }
    return found;
}

} // namespace millwright::exchange
