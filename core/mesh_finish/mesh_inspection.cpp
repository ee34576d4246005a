#include "core/mesh_finish/mesh_inspection.h"

#include "core/base/counted.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace millwright::mesh_finish {

namespace {

/// An edge as its triangle goes along it.
struct Edge {
    int low = 0, high = 0; ///< points
    int triangle = 0;
    int k = 0; ///< from corner k
    bool upwards = true;
};

std::vector<Edge> sorted_edges(const exchange::TriangleMesh& mesh) {
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.triangles[n][static_cast<std::size_t>(k)];
            const int b = mesh.triangles[n][static_cast<std::size_t>((k + 1) % 3)];
            edges.push_back({std::min(a, b), std::max(a, b), static_cast<int>(n), k, a < b});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
        return std::array{x.low, x.high, x.triangle, x.k} < std::array{y.low, y.high, y.triangle, y.k};
    });
    return edges;
}

/// One kind while its places are found, not in the order of the triangles.
struct Collected {
    OddPlace place;
    int triangle = 0; ///< of the first place

    void add(int of_triangle, const Vec3& at) {
        if (place.count++ == 0 || of_triangle < triangle) {
            triangle = of_triangle;
            place.first = at;
        }
    }
};

bool is_sliver(const exchange::TriangleMesh& mesh, std::size_t n) {
    constexpr double thin = 1e-3; // height by length
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
        longest = std::max(longest, (mesh.corner(n, (k + 1) % 3) - mesh.corner(n, k)).squaredNorm());
    }
    return !(mesh.doubled_area(n).norm() > thin * longest);
}

std::string sentence(const OddPlace& kind, std::string_view what) {
    return fmt::format("{} {}, the first at {:.3f} {:.3f} {:.3f}",
                       kind.count,
                       what,
                       kind.first.x(),
                       kind.first.y(),
                       kind.first.z());
}

} // namespace

MeshInspection inspect(const exchange::TriangleMesh& mesh, const Progress& progress) {
    MeshInspection found;
    found.open.assign(mesh.triangles.size(), 0);
    const std::vector<Edge> edges = sorted_edges(mesh);
    progress.check();
    Collected open;
    Collected shared;
    Collected turned;
    for (std::size_t n = 0; n < edges.size();) {
        std::size_t end = n + 1;
        while (end < edges.size() && edges[end].low == edges[n].low && edges[end].high == edges[n].high) {
            ++end;
        }
        const Edge& edge = edges[n];
        const Vec3 place = 0.5 * (mesh.points[static_cast<std::size_t>(edge.low)] +
                                  mesh.points[static_cast<std::size_t>(edge.high)]);
        if (end - n == 1) {
            open.add(edge.triangle, place);
            found.open[static_cast<std::size_t>(edge.triangle)] |= static_cast<std::uint8_t>(1U << edge.k);
        } else if (end - n > 2) {
            shared.add(edge.triangle, place);
        } else if (edge.upwards == edges[n + 1].upwards) {
            turned.add(edge.triangle, place);
        }
        n = end;
    }
    found.open_edges = open.place;
    found.shared_by_many = shared.place;
    found.turned_over = turned.place;
    progress.check();
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        if (is_sliver(mesh, n) && found.slivers.count++ == 0) {
            found.slivers.first = (mesh.corner(n, 0) + mesh.corner(n, 1) + mesh.corner(n, 2)) / 3.0;
        }
    }
    return found;
}

std::size_t inspection_memory(std::size_t triangles) {
    return 3 * triangles * sizeof(Edge);
}

std::vector<std::string> remarks_of(const MeshInspection& found) {
    std::vector<std::string> remarks;
    const auto add = [&](const OddPlace& kind, std::string_view one, std::string_view several) {
        if (kind.count > 0) {
            remarks.push_back(sentence(kind, kind.count == 1 ? one : several));
        }
    };
    add(found.open_edges, "open edge (the mesh has a border)", "open edges (the mesh has a border)");
    add(found.shared_by_many,
        "edge shared by more than two triangles",
        "edges shared by more than two triangles");
    add(found.turned_over,
        "edge between triangles that face opposite sides",
        "edges between triangles that face opposite sides");
    add(found.slivers,
        "sliver (a triangle 1000 times as long as high)",
        "slivers (triangles 1000 times as long as high)");
    return remarks;
}

void expect_usable(const exchange::TriangleMesh& mesh) {
    if (mesh.triangles.empty()) {
        throw Error("the mesh has no triangles");
    }
    for (const Vec3& point : mesh.points) {
        const auto text = [&] {
            return fmt::format("{:.6g} {:.6g} {:.6g}", point.x(), point.y(), point.z());
        };
        if (!is_finite(point)) {
            throw Error(fmt::format("a point of the mesh, {}, is not finite", text()));
        }
        if (point.cwiseAbs().maxCoeff() > farthest_mm) {
            throw Error(
                fmt::format("the point {} mm is farther than {:.0f} mm from the origin", text(), farthest_mm),
                {},
                "check the unit of the mesh, or move it to the origin");
        }
    }
}

} // namespace millwright::mesh_finish
