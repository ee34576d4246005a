#include "core/base/error.h"
#include "core/base/files.h"
#include "core/geometry/glb.h"
#include "core/geometry/solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace millwright::geometry {
namespace {

SolidMesh plate() {
    return hull_of(
        std::vector<Circle>{{{0.0, 0.0}, 50.0}, {{200.0, 40.0}, 30.0}}, {-10.0, 20.0, 2.0}, Vec3::Ones());
}

TEST(ClosedSolid, AHullIsClosed) {
    EXPECT_TRUE(is_closed(plate()));
}

TEST(ClosedSolid, ABodyThatLacksATriangleIsNot) {
    SolidMesh mesh = plate();
    mesh.triangles.erase(mesh.triangles.begin() + 17);
    EXPECT_FALSE(is_closed(mesh));
}

TEST(ClosedSolid, ABodyTurnedInsideOutIsNot) {
    SolidMesh mesh = plate();
    for (auto& triangle : mesh.triangles) {
        std::swap(triangle[0], triangle[1]);
    }
    EXPECT_FALSE(is_closed(mesh));
}

TEST(ClosedSolid, ABodyOfNoTrianglesIsNot) {
    EXPECT_FALSE(is_closed(SolidMesh()));
}

TEST(ClosedSolid, AnIndexOutsideIsADefect) {
    SolidMesh mesh = plate();
    mesh.triangles.front()[2] = static_cast<int>(mesh.positions.size());
    EXPECT_THROW((void)is_closed(mesh), Defect);
}

TEST(ClosedSolid, EveryBodyThatShipsIs) {
    int bodies = 0;
    for (const auto* folder : {"assets/arms", "assets/machines"}) {
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() != ".glb") {
                continue;
            }
            for (const SolidBody& body : parse_glb(read_file(entry.path()), entry.path())) {
                ++bodies;
                EXPECT_TRUE(std::ranges::all_of(body.meshes, is_closed)) << entry.path() << " " << body.name;
            }
        }
    }
    EXPECT_GT(bodies, 20);
}

} // namespace
} // namespace millwright::geometry
