#include "core/simulation/cut_mesh.h"

#include "core/base/units.h"
#include "core/geometry/solid.h"
#include "core/simulation/removal.h"
#include "core/toolpath/cutter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace millwright::simulation {
namespace {

constexpr std::size_t mesh_bytes = 500'000'000;

DexelField slotted_block() {
    DexelField field(BoxStock{{0.0, 0.0, -8.0}, {30.0, 20.0, 0.0}}, 0.5, mesh_bytes, Progress());
    const CuttingBody ball(
        *toolpath::body_of({.kind = toolpath::CutterKind::ball, .diameter = 6.0, .length = 30.0}));
    std::vector<CutStep> steps;
    divide(ball,
           {Vec3(-5.0, 10.0, -4.0), Vec3::UnitZ()},
           {Vec3(20.0, 10.0, -4.0), Vec3::UnitZ()},
           7,
           false,
           steps);
    Removal(field).remove(steps, Progress());
    return field;
}

geometry::SolidMesh solid_of(const CutMesh& mesh) {
    geometry::SolidMesh solid;
    solid.positions = mesh.points;
    solid.triangles = mesh.triangles;
    return solid;
}

double volume_of(const CutMesh& mesh) {
    double six = 0.0;
    for (const auto& t : mesh.triangles) {
        six += mesh.points[static_cast<std::size_t>(t[0])].dot(
            mesh.points[static_cast<std::size_t>(t[1])].cross(mesh.points[static_cast<std::size_t>(t[2])]));
    }
    return six / 6.0;
}

TEST(CutMesh, IsClosedAndLooksOutwards) {
    const DexelField field = slotted_block();
    for (const std::size_t most : {std::size_t{1'000'000}, std::size_t{4'000}}) {
        const CutMesh mesh = mesh_of(field, most, Progress());
        EXPECT_TRUE(geometry::is_closed(solid_of(mesh)));
        EXPECT_LE(mesh.triangles.size(), most);
        EXPECT_NEAR(volume_of(mesh), field.volume(), 0.02 * field.volume());
    }
}

TEST(CutMesh, LiesOnTheSurfaceAndKnowsWhatMadeIt) {
    const DexelField field = slotted_block();
    const CutMesh mesh = mesh_of(field, 1'000'000, Progress());
    EXPECT_EQ(mesh.stride, 1);
    int of_slot = 0, of_stock = 0;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
        const Vec3& p = mesh.points[n];
        const double off_ball = std::abs(std::hypot(p.y() - 10.0, p.z() + 1.0) - 3.0);
        if (p.x() > 1.0 && p.x() < 19.0 && std::abs(p.y() - 10.0) < 2.5 && p.z() < -1.5 && p.z() > -7.0) {
            EXPECT_EQ(mesh.moves[n], 7);
            EXPECT_LT(off_ball, 0.03); // of cells of 0.5 mm
            ++of_slot;
        } else if (p.z() < -7.5) {
            EXPECT_EQ(mesh.moves[n], stock_surface);
            ++of_stock;
        }
    }
    EXPECT_GT(of_slot, 100);
    EXPECT_GT(of_stock, 100);
}

TEST(CutMesh, FilesHaveEveryTriangle) {
    const CutMesh mesh = mesh_of(slotted_block(), 4'000, Progress());
    const std::string stl = stl_of(mesh);
    ASSERT_EQ(stl.size(), 84 + 50 * mesh.triangles.size());
    std::uint32_t count = 0;
    std::memcpy(&count, stl.data() + 80, sizeof(count));
    EXPECT_EQ(count, mesh.triangles.size());
    const std::string ply = ply_of(
        mesh.points, mesh.triangles, std::vector<std::array<std::uint8_t, 3>>(mesh.points.size(), {1, 2, 3}));
    const std::size_t header = ply.find("end_header\n") + 11;
    EXPECT_EQ(ply.size(), header + 15 * mesh.points.size() + 13 * mesh.triangles.size());
}

} // namespace
} // namespace millwright::simulation
