#include "core/exchange/surface_file.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/exchange/mesh_file.h"
#include "core/geometry/glb.h"
#include "core/geometry/presets.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::exchange {
namespace {

using geometry::BezierPatch;
using geometry::PatchId;
using geometry::Surface;

Surface preset(std::string_view id) {
    return geometry::surface_preset(id).make();
}

/// The largest distance between the triangles of equal steps and the patch at their parameters, by brute
/// force.
double chord_error(const BezierPatch& patch, const Steps& steps) {
    double worst = 0.0;
    constexpr int inside = 6;
    for (int i = 0; i < steps.u; ++i) {
        for (int j = 0; j < steps.v; ++j) {
            const auto at = [&](double a, double b) {
                return patch.position((i + a) / steps.u, (j + b) / steps.v);
            };
            for (int k = 0; k <= inside; ++k) {
                for (int m = 0; m <= inside - k; ++m) {
                    const double s = static_cast<double>(k) / inside;
                    const double t = static_cast<double>(m) / inside;
                    const Vec3 flat = at(0, 0) + s * (at(1, 0) - at(0, 0)) + t * (at(0, 1) - at(0, 0));
                    worst = std::max(worst, (flat - at(s, t)).norm());
                }
            }
        }
    }
    return worst;
}

TEST(SurfaceFile, StepsKeepTheTolerance) {
    for (const auto& known : geometry::surface_presets()) {
        const BezierPatch patch = known.make().patch(PatchId{0});
        for (const double tolerance : {0.5, 0.05}) {
            const double error = chord_error(patch, steps_within(patch, tolerance));
            EXPECT_LE(error, tolerance) << known.id;
        }
    }
}

TEST(SurfaceFile, TrianglesComeBack) {
    const test::ScratchFolder folder;
    const Surface dome = preset("dome");
    const Steps steps = steps_within(dome.patch(PatchId{0}), 0.1);
    for (const char* name : {"dome.stl", "dome.obj", "dome.PLY"}) {
        write_surface(dome, folder / name, 0.1, {});
        const MeshFile back = read_mesh(folder / name, 1.0, {});
        EXPECT_EQ(back.mesh.triangles.size(), static_cast<std::size_t>(2 * steps.u * steps.v)) << name;
        const BezierPatch& patch = dome.patch(PatchId{0});
        double nearest = 1e9;
        for (const Vec3& point : back.mesh.points) {
            nearest = std::min(nearest, (point - patch.position(1.0, 1.0)).norm());
        }
        EXPECT_LT(nearest, 1e-3) << name;
    }
}

TEST(SurfaceFile, GlbHasOneBodyAPatch) {
    const test::ScratchFolder folder;
    const BezierPatch patch = preset("dome").patch(PatchId{0});
    write_surface(Surface({patch, patch}), folder / "two.glb", 0.1, {});
    const auto bodies = geometry::parse_glb(read_file(folder / "two.glb"), "two.glb");
    ASSERT_EQ(bodies.size(), 2u);
    EXPECT_EQ(bodies[1].name, "patch 2");
}

TEST(SurfaceFile, WritingCanBeCancelledAndLeavesTheFile) {
    const test::ScratchFolder folder;
    write_file(folder / "dome.stl", "as it was");
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(write_surface(preset("dome"), folder / "dome.stl", 0.1, Progress({}, stop.get_token())),
                 Cancelled);
    EXPECT_EQ(read_file(folder / "dome.stl"), "as it was");
}

TEST(SurfaceFile, UnknownKindIsRefusedAndNothingWritten) {
    const test::ScratchFolder folder;
    EXPECT_THROW(write_surface(preset("dome"), folder / "dome.dwg", 0.1, {}), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "dome.dwg"));
}

} // namespace
} // namespace millwright::exchange
