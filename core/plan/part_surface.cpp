#include "core/plan/part_surface.h"

#include "core/base/error.h"
#include "core/exchange/mesh_file.h"
#include "core/geometry/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::plan {

namespace {

using simulation::PartPoint;
using Triangle = std::array<Vec3, 3>;

constexpr int divided_points = 20'000; // about, of a mesh of few triangles

double area_of(const Triangle& t) {
    return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
}

/// Divided across its longest edge until none is longer than `longest`.
void add_divided(const Triangle& t, double longest, PartSurface& part) {
    std::array<double, 3> edge{};
    for (std::size_t n = 0; n < 3; ++n) {
        edge[n] = (t[(n + 1) % 3] - t[n]).norm();
    }
    const auto n = static_cast<std::size_t>(std::ranges::max_element(edge) - edge.begin());
    if (edge[n] > longest) {
        const Vec3 middle = 0.5 * (t[n] + t[(n + 1) % 3]);
        add_divided({t[n], middle, t[(n + 2) % 3]}, longest, part);
        add_divided({middle, t[(n + 1) % 3], t[(n + 2) % 3]}, longest, part);
        return;
    }
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (!(normal.squaredNorm() > 0.0)) { // no direction in which a height could be measured
        return;
    }
    const int first = static_cast<int>(part.corners.size());
    for (const Vec3& corner : t) {
        part.corners.push_back(corner);
        part.point_of_corner.push_back(static_cast<int>(part.points.size()));
    }
    part.triangles.push_back({first, first + 1, first + 2});
    part.points.push_back({Vec3((t[0] + t[1] + t[2]) / 3.0), Vec3(normal.normalized()), area_of(t)});
}

} // namespace

PartSurface part_surface(const CuttingSetup& cutting_setup) {
    constexpr int steps = 80; // each way: 6,561 points
    const geometry::Mesh mesh =
        cutting_setup.trim.everything()
            ? geometry::tessellate(cutting_setup.patch, steps, steps)
            : geometry::tessellate(cutting_setup.patch, cutting_setup.trim, steps, steps).mesh;
    PartSurface part;
    part.text = "the machined face";
    part.corners = mesh.positions;
    part.triangles = mesh.triangles;
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        part.points.push_back(
            {mesh.positions[n], cutting_setup.flipped ? Vec3(-mesh.normals[n]) : mesh.normals[n], 0.0});
        part.point_of_corner.push_back(static_cast<int>(n));
    }
    std::vector<Vec3> around(part.points.size(), Vec3::Zero()); // sums of normals, as long as areas
    for (const auto& triangle : mesh.triangles) {
        Triangle corners;
        for (std::size_t n = 0; n < 3; ++n) {
            corners[n] = mesh.positions[static_cast<std::size_t>(triangle[n])];
        }
        const Vec3 doubled = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        for (const int corner : triangle) {
            part.points[static_cast<std::size_t>(corner)].area += area_of(corners) / 3.0;
            around[static_cast<std::size_t>(corner)] += cutting_setup.flipped ? Vec3(-doubled) : doubled;
        }
    }
    // At a corner where an edge of the patch has no length it has no normal: that of the triangles around.
    for (std::size_t n = 0; n < part.points.size(); ++n) {
        Vec3& normal = part.points[n].normal;
        constexpr double about_unit = 0.5;
        if (!(normal.squaredNorm() > about_unit)) {
            normal = around[n].squaredNorm() > 0.0 ? Vec3(around[n].normalized())
                     : n > 0                       ? part.points[n - 1].normal
                                                   : Vec3(Vec3::UnitZ());
        }
    }
    return part;
}

PartSurface part_surface(const std::filesystem::path& file, const Progress& progress) {
    return part_surface(
        exchange::read_mesh(file, 1.0, progress).mesh, printable(file.filename().string()), progress);
}

PartSurface
part_surface(const exchange::TriangleMesh& mesh, const std::string& name, const Progress& progress) {
    double area = 0.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        area += 0.5 * mesh.doubled_area(n).norm();
    }
    const double longest = 2.0 * std::sqrt(area / divided_points);
    PartSurface part;
    const std::size_t room = mesh.triangles.size() + divided_points;
    part.points.reserve(room);
    part.triangles.reserve(room);
    part.corners.reserve(3 * room);
    part.point_of_corner.reserve(3 * room);
    part.text = fmt::format("{}, {} triangles", name, mesh.triangles.size());
    part.closed = true;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        progress.check();
        add_divided({mesh.corner(n, 0), mesh.corner(n, 1), mesh.corner(n, 2)}, longest, part);
    }
    return part;
}

std::size_t part_surface_memory(std::size_t triangles) {
    constexpr std::size_t of_triangle =
        sizeof(PartPoint) + sizeof(std::array<int, 3>) + 3 * (sizeof(Vec3) + sizeof(int));
    return (triangles + divided_points) * of_triangle;
}

std::vector<std::array<std::uint8_t, 3>> deviation_colors(
    const PartSurface& part, const std::vector<simulation::Deviation>& deviations, double tolerance) {
    constexpr std::array<std::uint8_t, 3> gouge{214, 48, 42}, within{96, 174, 92}, excess{66, 118, 204};
    std::vector<std::array<std::uint8_t, 3>> colors;
    colors.reserve(part.corners.size());
    for (const int point : part.point_of_corner) {
        const double height = deviations[static_cast<std::size_t>(point)].height;
        colors.push_back(height < -tolerance ? gouge : height > tolerance ? excess : within);
    }
    return colors;
}

} // namespace millwright::plan
