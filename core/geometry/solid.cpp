#include "core/geometry/solid.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

namespace millwright::geometry {

namespace {

constexpr int directions = 40; // of a whole turn, at which a circle is touched

/// A point of the outline with the outward normal there.
struct Touch {
    Vec2 point, normal;
};

Vec2 direction(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

std::size_t farthest(std::span<const Circle> circles, const Vec2& normal) {
    const auto reach = [&](const Circle& circle) { return circle.center.dot(normal) + circle.radius; };
    const auto found = std::ranges::max_element(circles, {}, reach);
    return static_cast<std::size_t>(found - circles.begin());
}

Touch touch(const Circle& circle, double angle) {
    const Vec2 normal = direction(angle);
    return {circle.center + circle.radius * normal, normal};
}

/// Where a straight line along the outline leaves one circle for another, between two directions: it touches
/// both under the same normal.
double common_tangent(const Circle& from, const Circle& to, double first, double last) {
    double low = first, high = last;
    for (int n = 0; n < 60; ++n) { // halved below the spacing of doubles
        const double middle = 0.5 * (low + high);
        const Vec2 normal = direction(middle);
        const double ahead = (from.center - to.center).dot(normal) + from.radius - to.radius;
        (ahead > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Counter-clockwise; a straight stretch has its normal at both ends.
std::vector<Touch> outline(std::span<const Circle> circles) {
    std::vector<Touch> all;
    constexpr double step = 2.0 * pi / directions;
    std::size_t at = farthest(circles, direction(0.0));
    for (int n = 0; n < directions; ++n) {
        const double angle = n * step;
        all.push_back(touch(circles[at], angle));
        const std::size_t next = farthest(circles, direction(angle + step));
        if (next != at) {
            const double tangent = common_tangent(circles[at], circles[next], angle, angle + step);
            all.push_back(touch(circles[at], tangent));
            all.push_back(touch(circles[next], tangent));
            at = next;
        }
    }
    return all;
}

int add(SolidMesh& mesh, const Vec3& position, const Vec3& normal) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    return static_cast<int>(mesh.positions.size()) - 1;
}

/// One ring of the body: how far inside the outline, how high, and how its normals lean.
struct Ring {
    double inset = 0.0, z = 0.0;
};

Vec3 on_ring(const Touch& touch, const Ring& ring) {
    const Vec2 flat = touch.point - ring.inset * touch.normal;
    return {flat.x(), flat.y(), ring.z};
}

/// The band between two rings, the lower first or the outer first; `up`: z of its normals.
void add_band(
    SolidMesh& mesh, const std::vector<Touch>& outline, const Ring& lower, const Ring& upper, double up) {
    const auto begin = static_cast<int>(mesh.positions.size());
    const double out = std::sqrt(1.0 - up * up);
    for (const Touch& touch : outline) {
        const Vec3 normal(out * touch.normal.x(), out * touch.normal.y(), up);
        (void)add(mesh, on_ring(touch, lower), normal);
        (void)add(mesh, on_ring(touch, upper), normal);
    }
    const auto count = static_cast<int>(outline.size());
    for (int n = 0; n < count; ++n) {
        const int a = begin + 2 * n;
        const int b = begin + 2 * ((n + 1) % count);
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
    }
}

void add_cap(SolidMesh& mesh, const std::vector<Touch>& outline, const Ring& ring, bool top) {
    const Vec3 normal(0.0, 0.0, top ? 1.0 : -1.0);
    const auto begin = static_cast<int>(mesh.positions.size());
    for (const Touch& touch : outline) {
        (void)add(mesh, on_ring(touch, ring), normal);
    }
    for (int n = 1; n + 1 < static_cast<int>(outline.size()); ++n) {
        if (top) {
            mesh.triangles.push_back({begin, begin + n, begin + n + 1});
        } else {
            mesh.triangles.push_back({begin, begin + n + 1, begin + n});
        }
    }
}

} // namespace

SolidMesh hull_of(std::span<const Circle> circles, const Extent& extent, const Vec3& color) {
    const double edge = extent.broken_edge;
    expects(!circles.empty() && edge >= 0.0 && extent.top - extent.bottom > 2.0 * edge,
            "a hull has circles and a height");
    expects(std::ranges::all_of(circles, [&](const Circle& circle) { return circle.radius > edge; }),
            "circles are larger than the broken edge");
    const std::vector<Touch> around = outline(circles);
    SolidMesh mesh;
    mesh.color = color;
    const Ring bottom{edge, extent.bottom}, low{0.0, extent.bottom + edge};
    const Ring high{0.0, extent.top - edge}, top{edge, extent.top};
    const double slope = std::sqrt(0.5);
    add_cap(mesh, around, bottom, false);
    if (edge > 0.0) {
        add_band(mesh, around, bottom, low, -slope);
    }
    add_band(mesh, around, low, high, 0.0);
    if (edge > 0.0) {
        add_band(mesh, around, high, top, slope);
    }
    add_cap(mesh, around, top, true);
    return mesh;
}

SolidMesh moved(SolidMesh mesh, const Frame& a_T_b) {
    for (Vec3& position : mesh.positions) {
        position = a_T_b * position;
    }
    for (Vec3& normal : mesh.normals) {
        normal = a_T_b.linear() * normal;
    }
    return mesh;
}

namespace {

/// For each position the number of the first equal one.
std::vector<int> welded(const std::vector<Vec3>& positions) {
    std::map<std::tuple<double, double, double>, int> first;
    std::vector<int> number;
    number.reserve(positions.size());
    for (const Vec3& position : positions) {
        const auto next = static_cast<int>(number.size());
        number.push_back(first.try_emplace({position.x(), position.y(), position.z()}, next).first->second);
    }
    return number;
}

double six_volumes(const SolidMesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto at = [&](int n) { return mesh.positions[static_cast<std::size_t>(n)]; };
        sum += at(a).dot(at(b).cross(at(c)));
    }
    return sum;
}

} // namespace

bool is_closed(const SolidMesh& mesh) {
    const auto count = static_cast<int>(mesh.positions.size());
    const std::vector<int> number = welded(mesh.positions);
    std::map<std::pair<int, int>, int> passes; // forwards less backwards, from the lower to the higher number
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const int from = triangle[k], to = triangle[(k + 1) % 3];
            expects(from >= 0 && from < count && to >= 0 && to < count, "a corner is one of the mesh");
            const int a = number[static_cast<std::size_t>(from)], b = number[static_cast<std::size_t>(to)];
            passes[std::minmax(a, b)] += (a < b) - (b < a);
        }
    }
    return std::ranges::all_of(passes, [](const auto& edge) { return edge.second == 0; }) &&
           six_volumes(mesh) > 0.0;
}

} // namespace millwright::geometry
