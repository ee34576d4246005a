#include "core/plan/finish_check.h"

#include "core/base/progress.h"
#include "core/mesh_finish/finish_program.h"
#include "core/mesh_finish/finishing.h"
#include "core/mesh_finish/mesh_inspection.h"
#include "core/toolpath/cutter.h"
#include "tests/core/mesh_finish/made_meshes.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <optional>

namespace millwright::plan {
namespace {

using mesh_finish::FinishPass;
using mesh_finish::FinishPath;

/// Two levels, 6 mm apart, on the table of the router.
exchange::TriangleMesh step() {
    exchange::TriangleMesh mesh = test::step_mesh(12.0, 6.0);
    for (Vec3& point : mesh.points) {
        point += Vec3(50.0, 50.0, -20.0);
    }
    return mesh;
}

/// The findings where the program knows of `planned` mm of material around the mesh, and there are `real`.
std::size_t rapids(std::optional<double> planned, std::optional<double> real) {
    const exchange::TriangleMesh mesh = step();
    const kinematics::MachineModel router = test::machine("router-xyz");
    const toolpath::Profile ball =
        *toolpath::body_of(toolpath::CutterShape{.kind = toolpath::CutterKind::ball, .diameter = 4.0});
    const mesh_finish::FinishSettings settings{.step_over = 1.5, .allowance = planned};
    const mesh_finish::DropTree tree(mesh, mesh_finish::inspect(mesh, Progress()).open, Progress());
    const FinishPath path = mesh_finish::finish(tree, mesh_finish::CutterOutline(ball), settings, Progress());
    const program::Program made = mesh_finish::finish_program(router, path, {}, {}, Progress());
    const PartSurface part = part_surface(mesh, "step", Progress());
    const FinishCheck check = check_finish({.tree = tree,
                                            .part = part,
                                            .program = made,
                                            .machine = router,
                                            .cutter = ball,
                                            .allowance = real,
                                            .most_bytes = 1UL << 27},
                                           Progress());
    EXPECT_LT(check.gouge ? check.gouge->distance : 0.0, 0.01);
    return check.rapids.size();
}

TEST(FinishCheck, FindsRapidMovesThroughTheAllowance) {
    EXPECT_EQ(rapids(4.0, 4.0), 0U);
    EXPECT_EQ(rapids(0.0, 0.0), 0U);
    EXPECT_GT(rapids(0.0, 4.0), 3U); // links 2 mm above the mesh
    EXPECT_EQ(rapids(0.0, std::nullopt), 0U);
}

TEST(FinishCheck, KnowsHowMuchMemoryItTakes) {
    const exchange::TriangleMesh mesh =
        test::graph_mesh({0, 20, 0, 20}, 200, 200, [](double x, double) { return 0.1 * x; });
    const PartSurface part = part_surface(mesh, "slope", Progress());
    const std::size_t takes = part.points.capacity() * sizeof(simulation::PartPoint) +
                              part.corners.capacity() * sizeof(Vec3) +
                              part.point_of_corner.capacity() * sizeof(int) +
                              part.triangles.capacity() * sizeof(std::array<int, 3>);
    const std::size_t known = finish_check_memory(mesh.triangles.size());
    EXPECT_GE(known, takes + part.points.size() * sizeof(simulation::Deviation));
    EXPECT_LT(known, 2 * takes);
}

} // namespace
} // namespace millwright::plan
