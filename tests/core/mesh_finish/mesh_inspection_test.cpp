#include "core/mesh_finish/mesh_inspection.h"

#include "core/base/error.h"
#include "tests/core/mesh_finish/made_meshes.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::mesh_finish {
namespace {

MeshInspection inspected(const exchange::TriangleMesh& mesh) {
    return inspect(mesh, Progress());
}

TEST(MeshInspection, CountsTheOpenEdgesOfASheet) {
    const exchange::TriangleMesh sheet =
        test::graph_mesh({0, 4, 0, 2}, 4, 2, [](double, double) { return 1.0; });
    const MeshInspection found = inspected(sheet);
    EXPECT_EQ(found.open_edges.count, 12);
    EXPECT_EQ(found.open_edges.first, Vec3(0.5, 0.0, 1.0));
    EXPECT_EQ(found.open.front(), 0b001);
    EXPECT_EQ(found.shared_by_many.count + found.turned_over.count + found.slivers.count, 0);
    ASSERT_EQ(remarks_of(found).size(), 1U);
    EXPECT_EQ(remarks_of(found).front(),
              "12 open edges (the mesh has a border), the first at 0.500 0.000 1.000");
}

TEST(MeshInspection, FindsNothingOddInABody) {
    exchange::TriangleMesh body{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    EXPECT_TRUE(remarks_of(inspected(body)).empty());
    body.triangles.back() = {0, 2, 3};
    EXPECT_EQ(inspected(body).turned_over.count, 3);
}

TEST(MeshInspection, FindsAnEdgeOfThreeTriangles) {
    const exchange::TriangleMesh fins{{{0, 0, 0}, {10, 0, 0}, {0, 9, 0}, {0, -9, 0}, {0, 0, 9}},
                                      {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    const MeshInspection found = inspected(fins);
    EXPECT_EQ(found.shared_by_many.count, 1);
    EXPECT_EQ(found.shared_by_many.first, Vec3(5, 0, 0));
}

TEST(MeshInspection, FindsSlivers) {
    const exchange::TriangleMesh thin{{{0, 0, 0}, {30, 0, 0}, {15, 0.02, 0}}, {{0, 1, 2}}};
    EXPECT_EQ(inspected(thin).slivers.count, 1);
}

TEST(MeshInspection, RefusesWhatCannotBeComputedWith) {
    EXPECT_THROW(expect_usable({}), Error);
    exchange::TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    EXPECT_NO_THROW(expect_usable(mesh));
    mesh.points[1].x() = 2e5;
    try {
        expect_usable(mesh);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().message,
                  "the point 200000 0 0 mm is farther than 100000 mm from the origin");
    }
    const test::WithoutTraps without_traps;
    mesh.points[1].x() = std::nan("");
    EXPECT_THROW(expect_usable(mesh), Error);
}

} // namespace
} // namespace millwright::mesh_finish
