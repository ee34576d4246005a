#include "core/exchange/internal/harmonic_parametrization.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace millwright::exchange {

namespace {

using Edge = std::pair<int, int>;

/// Each directed edge with the triangle it belongs to; nothing if one stands twice, which no sheet has.
std::optional<std::map<Edge, std::size_t>> directed_edges(const TriangleMesh& mesh) {
    std::map<Edge, std::size_t> edges;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const auto& triangle = mesh.triangles[n];
        for (std::size_t k = 0; k < 3; ++k) {
            if (!edges.emplace(Edge{triangle[k], triangle[(k + 1) % 3]}, n).second) {
                return std::nullopt;
            }
        }
    }
    return edges;
}

/// The points of the outline, counter-clockwise; nothing if there are several outlines or none.
std::optional<std::vector<int>> outline_of(const std::map<Edge, std::size_t>& edges) {
    std::map<int, int> next;
    for (const auto& [edge, triangle] : edges) {
        if (!edges.contains({edge.second, edge.first}) && !next.emplace(edge).second) {
            return std::nullopt;
        }
    }
    if (next.empty()) {
        return std::nullopt;
    }
    std::vector<int> outline{next.begin()->first};
    for (int at = next.begin()->second; at != outline.front(); at = next.at(at)) {
        outline.push_back(at);
    }
    return outline.size() == next.size() ? std::optional(outline) : std::nullopt;
}

/// Points - edges + triangles: 1 for one sheet without holes.
std::ptrdiff_t euler_characteristic(const TriangleMesh& mesh, const std::map<Edge, std::size_t>& edges) {
    std::ptrdiff_t undirected = 0;
    for (const auto& [edge, triangle] : edges) {
        undirected += edge.first < edge.second || !edges.contains({edge.second, edge.first}) ? 1 : 0;
    }
    return std::ssize(mesh.points) - undirected + std::ssize(mesh.triangles);
}

/// Places in the outline of the points next to the corners of the rectangle; nothing unless they are in
/// order.
std::optional<std::array<std::size_t, 4>>
corners_of(const std::vector<int>& outline, const TriangleMesh& mesh, const Rectangle& rectangle) {
    const std::array<Vec2, 4> wanted{Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(1.0, 1.0), Vec2(0.0, 1.0)};
    std::array<std::size_t, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto away = [&](int point) {
            return (rectangle.place_of(mesh.points[static_cast<std::size_t>(point)]) - wanted[k])
                .squaredNorm();
        };
        corners[k] = static_cast<std::size_t>(std::ranges::min_element(outline, {}, away) - outline.begin());
    }
    const auto after_first = [&](std::size_t k) {
        return (corners[k] + outline.size() - corners[0]) % outline.size();
    };
    const bool in_order =
        0 < after_first(1) && after_first(1) < after_first(2) && after_first(2) < after_first(3);
    return in_order ? std::optional(corners) : std::nullopt;
}

/// Whether the outline turns there by 30 degrees or more, between points a fiftieth of it away on both sides.
bool is_corner(const std::vector<int>& outline, const TriangleMesh& mesh, std::size_t place) {
    constexpr double straight = 150.0 / 180.0 * std::numbers::pi;
    const std::size_t size = outline.size();
    const auto point = [&](std::size_t n) {
        return mesh.points[static_cast<std::size_t>(outline[n % size])];
    };
    double length = 0.0;
    for (std::size_t n = 0; n < size; ++n) {
        length += (point(n + 1) - point(n)).norm();
    }
    const auto away = [&](std::size_t step) {
        double passed = 0.0;
        std::size_t n = place;
        while (passed < length / 50.0) {
            passed += (point(n + step) - point(n)).norm();
            n = (n + step) % size;
        }
        return Vec3(point(n) - point(place));
    };
    return angle_between(away(1), away(size - 1)) < straight;
}

Vec2 on_side(int side, double share) {
    switch (side) {
    case 0:
        return {share, 0.0};
    case 1:
        return {1.0, share};
    case 2:
        return {1.0 - share, 1.0};
    default:
        return {0.0, 1.0 - share};
    }
}

/// Puts the points of one side at equal shares of its length.
void spread_side(HarmonicParametrization& map,
                 const TriangleMesh& mesh,
                 const std::vector<int>& outline,
                 int side,
                 std::pair<std::size_t, std::size_t> ends) {
    std::vector<double> passed{0.0};
    const auto point = [&](std::size_t n) { return outline[n % outline.size()]; };
    const std::size_t last = ends.second > ends.first ? ends.second : ends.second + outline.size();
    for (std::size_t n = ends.first; n < last; ++n) {
        const Vec3 way = mesh.points[static_cast<std::size_t>(point(n + 1))] -
                         mesh.points[static_cast<std::size_t>(point(n))];
        passed.push_back(passed.back() + way.norm());
        map.outline.push_back({point(n), point(n + 1), side});
    }
    for (std::size_t n = ends.first; n < last; ++n) {
        map.places[static_cast<std::size_t>(point(n))] =
            on_side(side, passed[n - ends.first] / passed.back());
    }
}

/// Cotangent of the angle at a triangle's corner.
double cotangent(const TriangleMesh& mesh, std::size_t triangle, int corner) {
    const Vec3& at = mesh.corner(triangle, corner);
    const Vec3 a = mesh.corner(triangle, (corner + 1) % 3) - at;
    const Vec3 b = mesh.corner(triangle, (corner + 2) % 3) - at;
    return a.dot(b) / a.cross(b).norm();
}

/// Moves the inner points to where the sum over the edges of weight * length^2 is least. False if that has no
/// solution, which is so when a part of the mesh hangs together with no outline.
bool spread_inside(HarmonicParametrization& map, const TriangleMesh& mesh, const std::vector<int>& outline) {
    constexpr double least_weight = 0.01;
    std::vector<int> unknown(mesh.points.size(), 0);
    for (const int point : outline) {
        unknown[static_cast<std::size_t>(point)] = -1;
    }
    int count = 0;
    for (int& number : unknown) {
        number = number < 0 ? -1 : count++;
    }
    if (count == 0) {
        return true;
    }
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(count, 2);
    const auto pull = [&](int a, int b, double weight) {
        const int row = unknown[static_cast<std::size_t>(a)];
        const int column = unknown[static_cast<std::size_t>(b)];
        if (row < 0) {
            return;
        }
        entries.emplace_back(row, row, weight);
        if (column >= 0) {
            entries.emplace_back(row, column, -weight);
        } else {
            right.row(row) += weight * map.places[static_cast<std::size_t>(b)].transpose();
        }
    };
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        for (int k = 0; k < 3; ++k) {
            const double weight = std::max(least_weight, cotangent(mesh, n, k));
            const int a = mesh.triangles[n][static_cast<std::size_t>((k + 1) % 3)];
            const int b = mesh.triangles[n][static_cast<std::size_t>((k + 2) % 3)];
            pull(a, b, weight);
            pull(b, a, weight);
        }
    }
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    if (factors.info() != Eigen::Success) {
        return false;
    }
    const Eigen::MatrixX2d places = factors.solve(right);
    for (std::size_t n = 0; n < unknown.size(); ++n) {
        if (unknown[n] >= 0) {
            map.places[n] = places.row(unknown[n]).transpose();
        }
    }
    return places.allFinite();
}

} // namespace

std::optional<HarmonicParametrization> harmonic_parametrization(const TriangleMesh& mesh,
                                                                const Rectangle& rectangle) {
    const auto edges = directed_edges(mesh);
    const auto outline = edges ? outline_of(*edges) : std::nullopt;
    if (!outline || euler_characteristic(mesh, *edges) != 1) {
        return std::nullopt;
    }
    const auto corners = corners_of(*outline, mesh, rectangle);
    const auto smooth = [&](std::size_t place) { return !is_corner(*outline, mesh, place); };
    if (!corners || std::ranges::any_of(*corners, smooth)) {
        return std::nullopt;
    }
    HarmonicParametrization map;
    map.places.assign(mesh.points.size(), Vec2::Zero());
    for (int side = 0; side < 4; ++side) {
        const auto k = static_cast<std::size_t>(side);
        spread_side(map, mesh, *outline, side, {(*corners)[k], (*corners)[(k + 1) % 4]});
    }
    return spread_inside(map, mesh, *outline) ? std::optional(std::move(map)) : std::nullopt;
}

} // namespace millwright::exchange
