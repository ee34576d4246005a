#include "core/simulation/internal/mesh_rays.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace millwright::simulation {

namespace {

const Vec3& corner(const MeshStock& mesh, const std::array<int, 3>& triangle, int n) {
    return mesh.points[static_cast<std::size_t>(triangle[static_cast<std::size_t>(n % 3)])];
}

std::string place_text(const Vec3& p) {
    return fmt::format("{:.4g}, {:.4g}, {:.4g}", p.x(), p.y(), p.z());
}

/// An edge with its direction: +1 from the smaller index to the larger.
struct Edge {
    int low = 0, high = 0, direction = 0;
};

std::vector<Edge> sorted_edges(const MeshStock& mesh) {
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t n = 0; n < 3; ++n) {
            const int a = triangle[n], b = triangle[(n + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    }
    std::ranges::sort(edges, {}, [](const Edge& edge) { return std::pair(edge.low, edge.high); });
    return edges;
}

/// Where a line crosses a triangle, and +1 where it enters the body.
struct MeshCrossing {
    double at = 0.0;
    int sense = 0;
};

/// A triangle seen along the lines. Coordinates (u, v) across them.
class SeenTriangle {
public:
    SeenTriangle(const MeshStock& mesh, const std::array<int, 3>& triangle, int k)
        : u_((k + 1) % 3), v_((k + 2) % 3), k_(k) {
        for (int n = 0; n < 3; ++n) {
            points_[static_cast<std::size_t>(n)] = &corner(mesh, triangle, n);
        }
        index_ = triangle;
    }
    [[nodiscard]] std::pair<double, double> range(int axis) const {
        return std::minmax({(*points_[0])[axis], (*points_[1])[axis], (*points_[2])[axis]});
    }

    /// False if the line through (u, v) misses it.
    [[nodiscard]] bool cross(double u, double v, MeshCrossing& found) const {
        std::array<int, 3> side{};
        std::array<double, 3> weight{};
        for (std::size_t n = 0; n < 3; ++n) {
            side[n] = side_of(n, u, v, weight[(n + 2) % 3]);
        }
        if (side[0] != side[1] || side[1] != side[2]) {
            return false;
        }
        const double sum = weight[0] + weight[1] + weight[2];
        if (!(std::abs(sum) > 0.0)) {
            return false;
        }
        double at = 0.0;
        for (std::size_t n = 0; n < 3; ++n) {
            at += weight[n] / sum * (*points_[n])[k_];
        }
        // Counter-clockwise in (u, v): the normal looks along +k, so the line leaves the body.
        found = {at, side[0] > 0 ? -1 : 1};
        return true;
    }

private:
    /// On which side of edge n the line is. Both triangles of an edge compute the same number, and a line
    /// that meets it is taken to be shifted by (e, e^2), so that one of them has it and never both.
    [[nodiscard]] int side_of(std::size_t n, double u, double v, double& area) const {
        const std::size_t m = (n + 1) % 3;
        const bool forward = index_[n] < index_[m];
        const Vec3& a = forward ? *points_[n] : *points_[m];
        const Vec3& b = forward ? *points_[m] : *points_[n];
        const double du = b[u_] - a[u_];
        const double dv = b[v_] - a[v_];
        const double twice = du * (v - a[v_]) - dv * (u - a[u_]);
        area = forward ? twice : -twice;
        const int along = dv > 0.0 ? -1 : dv < 0.0 ? 1 : du > 0.0 ? 1 : -1;
        const int sign = twice > 0.0 ? 1 : twice < 0.0 ? -1 : along;
        return forward ? sign : -sign;
    }

    std::array<const Vec3*, 3> points_{};
    std::array<int, 3> index_{};
    int u_, v_, k_;
};

/// The material between the crossings of one line.
std::vector<Interval> inside_of(std::vector<MeshCrossing>& crossings, const Vec3& at, int k) {
    std::ranges::sort(crossings, {}, [](const MeshCrossing& one) { return std::pair(one.at, one.sense); });
    std::vector<Interval> inside;
    constexpr double touching = 1e-6; // mm: two sheets closer than this are one
    int depth = 0;
    for (std::size_t n = 0; n < crossings.size(); ++n) {
        depth += crossings[n].sense;
        const bool last = n + 1 == crossings.size();
        const double gap = last ? 0.0 : crossings[n + 1].at - crossings[n].at;
        if ((depth != 0 && depth != 1 && gap > touching) || (last && depth != 0)) {
            Vec3 place = at;
            place[k] = crossings[n].at;
            throw Error(fmt::format("the mesh of the stock crosses itself, or has triangles that look "
                                    "inwards, near {}",
                                    place_text(place)),
                        {},
                        "repair it in the program that it comes from");
        }
        if (depth == 1 && gap > touching) {
            if (!inside.empty() && crossings[n].at - inside.back().to <= touching) {
                inside.back().to = crossings[n + 1].at;
            } else {
                inside.push_back({crossings[n].at, crossings[n + 1].at});
            }
        }
    }
    return inside;
}

} // namespace

std::string fault_of_mesh(const MeshStock& mesh) {
    if (mesh.triangles.empty()) {
        return "the mesh of the stock has no triangles";
    }
    for (const Vec3& point : mesh.points) {
        if (!is_finite(point)) {
            return "the mesh of the stock has a corner that is not finite";
        }
    }
    const std::vector<Edge> edges = sorted_edges(mesh);
    int open = 0;
    const Edge* first = nullptr;
    for (std::size_t n = 0; n < edges.size();) {
        int sum = 0;
        std::size_t m = n;
        while (m < edges.size() && edges[m].low == edges[n].low && edges[m].high == edges[n].high) {
            sum += edges[m++].direction;
        }
        if (sum != 0) {
            ++open;
            first = first != nullptr ? first : &edges[n];
        }
        n = m;
    }
    if (first != nullptr) {
        return fmt::format("the mesh of the stock is open: {} edges belong to one triangle, the first from "
                           "{} to {}",
                           open,
                           place_text(mesh.points[static_cast<std::size_t>(first->low)]),
                           place_text(mesh.points[static_cast<std::size_t>(first->high)]));
    }
    return mesh_volume(mesh) > 0.0 ? std::string()
                                   : "the mesh of the stock has no volume: its triangles look inwards";
}

double mesh_volume(const MeshStock& mesh) {
    double six = 0.0;
    for (const auto& triangle : mesh.triangles) {
        six += corner(mesh, triangle, 0).dot(corner(mesh, triangle, 1).cross(corner(mesh, triangle, 2)));
    }
    return six / 6.0;
}

std::vector<std::vector<Interval>> mesh_along(const MeshStock& mesh, const RayGrid& grid) {
    const int u = (grid.k + 1) % 3;
    const int v = (grid.k + 2) % 3;
    const std::size_t width = static_cast<std::size_t>(grid.count[0]);
    std::vector<std::vector<MeshCrossing>> crossings(width * static_cast<std::size_t>(grid.count[1]));
    const auto range = [&](const SeenTriangle& triangle, int axis, int count) {
        const auto [low, high] = triangle.range(axis);
        const double from = std::floor((low - grid.first[axis]) / grid.pitch[axis]);
        const double to = std::ceil((high - grid.first[axis]) / grid.pitch[axis]);
        const double beyond = count; // the range of a triangle outside is empty
        return std::pair(static_cast<int>(std::clamp(from, 0.0, beyond)),
                         static_cast<int>(std::clamp(to, -1.0, beyond - 1.0)));
    };
    for (const auto& indices : mesh.triangles) {
        const SeenTriangle triangle(mesh, indices, grid.k);
        const auto [i0, i1] = range(triangle, u, grid.count[0]);
        const auto [j0, j1] = range(triangle, v, grid.count[1]);
        for (int j = j0; j <= j1; ++j) {
            for (int i = i0; i <= i1; ++i) {
                MeshCrossing found;
                if (triangle.cross(
                        grid.first[u] + i * grid.pitch[u], grid.first[v] + j * grid.pitch[v], found)) {
                    crossings[static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i)].push_back(
                        found);
                }
            }
        }
    }
    std::vector<std::vector<Interval>> lines(crossings.size());
    for (std::size_t n = 0; n < lines.size(); ++n) {
        Vec3 at = grid.first;
        at[u] += static_cast<double>(n % width) * grid.pitch[u];
        at[v] += static_cast<double>(n / width) * grid.pitch[v];
        lines[n] = inside_of(crossings[n], at, grid.k);
    }
    return lines;
}

} // namespace millwright::simulation
