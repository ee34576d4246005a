#include "core/exchange/internal/visible_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

} // namespace millwright::exchange
