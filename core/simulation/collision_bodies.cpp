#include "core/simulation/collision_bodies.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/geometry/solid.h"
#include "core/kinematics/machine_solids.h"
#include "core/simulation/collision_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

namespace millwright::simulation {

namespace {

void add(CollisionTriangles& all, const geometry::SolidMesh& mesh) {
    const int first = static_cast<int>(all.points.size());
    all.points.insert(all.points.end(), mesh.positions.begin(), mesh.positions.end());
    for (const auto& [a, b, c] : mesh.triangles) {
        all.triangles.push_back({a + first, b + first, c + first});
    }
}

/// A surface of revolution about the unit vector `axis` from `at`: (rho, z) of `outline`, closed where it
/// begins and ends on the axis, else from its last point to its first.
CollisionTriangles
turned(const std::vector<Vec2>& outline, bool ring, const Vec3& at, const Vec3& axis, int facets) {
    const Mat3 frame = frame_along(axis);
    CollisionTriangles surface;
    const int rows = static_cast<int>(outline.size());
    for (const Vec2& point : outline) {
        for (int n = 0; n < facets; ++n) {
            const double angle = 2.0 * pi * n / facets;
            surface.points.emplace_back(
                at + frame * Vec3(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y()));
        }
    }
    const auto at_row = [&](int row, int n) { return row % rows * facets + n % facets; };
    const auto add_if_area = [&](int a, int b, int c) {
        const auto point = [&](int n) { return surface.points[static_cast<std::size_t>(n)]; };
        if ((point(b) - point(a)).cross(point(c) - point(a)).norm() > 0.0) {
            surface.triangles.push_back({a, b, c});
        }
    };
    for (int row = 0; row < (ring ? rows : rows - 1); ++row) {
        for (int n = 0; n < facets; ++n) {
            add_if_area(at_row(row, n), at_row(row, n + 1), at_row(row + 1, n + 1));
            add_if_area(at_row(row, n), at_row(row + 1, n + 1), at_row(row + 1, n));
        }
    }
    return surface;
}

CollisionTriangles surface_of(const BoxStock& box) {
    CollisionTriangles surface;
    for (int n = 0; n < 8; ++n) {
        surface.points.emplace_back((n & 1) != 0 ? box.high.x() : box.low.x(),
                                    (n & 2) != 0 ? box.high.y() : box.low.y(),
                                    (n & 4) != 0 ? box.high.z() : box.low.z());
    }
    surface.triangles = {{0, 2, 3},
                         {0, 3, 1},
                         {4, 5, 7},
                         {4, 7, 6},
                         {0, 1, 5},
                         {0, 5, 4},
                         {2, 6, 7},
                         {2, 7, 3},
                         {0, 4, 6},
                         {0, 6, 2},
                         {1, 3, 7},
                         {1, 7, 5}};
    return surface;
}

CollisionTriangles surface_of(const CylinderStock& stock, int facets) {
    const double around = 0.5 * stock.diameter / std::cos(pi / facets);
    const double bore = 0.5 * stock.bore;
    const Vec3 axis = Vec3::Unit(stock.axis);
    if (bore > 0.0) {
        return turned({{bore, 0.0}, {around, 0.0}, {around, stock.length}, {bore, stock.length}},
                      true,
                      stock.base,
                      axis,
                      facets);
    }
    return turned({{0.0, 0.0}, {around, 0.0}, {around, stock.length}, {0.0, stock.length}},
                  false,
                  stock.base,
                  axis,
                  facets);
}

/// Whether the mesh shows the cutter of the machine file, as glb files that are made from it do.
bool shows_cutter(const kinematics::MachineModel& machine, const geometry::SolidMesh& mesh) {
    constexpr double rounding = 0.01; // mm: glb files have single precision
    return std::ranges::any_of(machine.description().bodies, [&](const kinematics::MachineBody& body) {
        return kinematics::is_cutter(machine, body) &&
               std::ranges::all_of(mesh.positions, [&](const Vec3& point) {
                   const Vec3 off = point - body.center;
                   const double along = off.dot(body.direction);
                   return std::abs(along) < 0.5 * body.size.z() + rounding &&
                          (off - along * body.direction).norm() < 0.5 * body.size.x() + rounding;
               });
    });
}

std::optional<CollisionBody> machine_body(const kinematics::MachineModel& machine,
                                          const geometry::SolidBody& solid) {
    CollisionTriangles triangles;
    bool closed = true;
    for (const geometry::SolidMesh& mesh : solid.meshes) {
        if (shows_cutter(machine, mesh)) {
            continue;
        }
        add(triangles, mesh);
        closed = closed && geometry::is_closed(mesh);
    }
    if (triangles.triangles.empty()) {
        return std::nullopt;
    }
    return CollisionBody{solid.name,
                         BodyRole::machine,
                         kinematics::carrier_of(solid),
                         std::make_shared<const CollisionMesh>(std::move(triangles)),
                         closed};
}

} // namespace

std::vector<CollisionBody> machine_collision_bodies(const kinematics::MachineModel& machine,
                                                    std::span<const geometry::SolidBody> solids) {
    std::vector<CollisionBody> bodies;
    const auto add_body = [&](const geometry::SolidBody& solid) {
        if (auto body = machine_body(machine, solid)) {
            bodies.push_back(*std::move(body));
        }
    };
    for (const geometry::SolidBody& solid : solids) {
        add_body(solid);
    }
    if (solids.empty()) {
        for (const geometry::PlacedBody& placed : kinematics::machine_solids(machine)) {
            add_body(placed.body);
        }
    }
    return bodies;
}

CollisionBody collision_body(const kinematics::MachineModel& machine,
                             std::string name,
                             BodyRole role,
                             CollisionTriangles triangles,
                             bool closed) {
    for (Vec3& point : triangles.points) {
        point += machine.workpiece_origin();
    }
    return {std::move(name),
            role,
            work_carrier(machine),
            std::make_shared<const CollisionMesh>(std::move(triangles)),
            closed};
}

CollisionTriangles surface_of(const Stock& stock, int facets) {
    if (const auto* box = std::get_if<BoxStock>(&stock)) {
        return surface_of(*box);
    }
    if (const auto* cylinder = std::get_if<CylinderStock>(&stock)) {
        return surface_of(*cylinder, facets);
    }
    const MeshStock& mesh = *std::get<std::shared_ptr<const MeshStock>>(stock);
    return {mesh.points, mesh.triangles};
}

CollisionTriangles surface_of(const toolpath::Profile& body, const geometry::ToolPose& pose, int facets) {
    constexpr double tolerance = 1e-3; // mm
    return turned(body.outline(tolerance), false, pose.tip, pose.axis, facets);
}

void expect_on_table(const CollisionBody& fixture,
                     std::span<const CollisionBody> machine_bodies,
                     const kinematics::MachineModel& machine) {
    constexpr double standing = 0.05; // mm: meshes are rounded, and clamps are pressed down
    constexpr int looks = 3000;
    for (const CollisionBody& body : machine_bodies) {
        if (body.carrier != fixture.carrier || !body.closed) {
            continue;
        }
        const auto in_table = body.mesh->deepest(*fixture.mesh, Frame::Identity(), looks);
        const auto in_fixture = fixture.closed ? fixture.mesh->deepest(*body.mesh, Frame::Identity(), looks)
                                               : std::optional<NearPlace>();
        const NearPlace deepest =
            std::max(in_table.value_or(NearPlace{}),
                     in_fixture.value_or(NearPlace{}),
                     [](const auto& a, const auto& b) { return a.distance < b.distance; });
        if (deepest.distance > standing) {
            const Vec3 at = deepest.place - machine.workpiece_origin();
            throw Error(
                fmt::format("{} lies {:.2f} mm deep in the machine's body \"{}\" at {:.2f} {:.2f} {:.2f}",
                            fixture.name,
                            deepest.distance,
                            body.name,
                            at.x(),
                            at.y(),
                            at.z()),
                {},
                "move it with @X,Y,Z behind the file, in workpiece coordinates");
        }
    }
}

} // namespace millwright::simulation
