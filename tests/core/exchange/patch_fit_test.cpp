#include "core/exchange/patch_fit.h"

#include "core/base/error.h"
#include "core/exchange/cloud_fit.h"
#include "core/geometry/closest_point.h"
#include "core/geometry/mesh.h"
#include "core/geometry/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace millwright::exchange {
namespace {

using geometry::BezierPatch;

TriangleMesh mesh_of(const BezierPatch& patch, int steps) {
    const geometry::Mesh mesh = geometry::tessellate(patch, steps, steps);
    return {mesh.positions, mesh.triangles};
}

TriangleMesh moved(TriangleMesh mesh, const Frame& frame) {
    for (Vec3& point : mesh.points) {
        point = frame * point;
    }
    return mesh;
}

Frame somewhere() {
    Frame frame = Frame::Identity();
    frame.linear() = Eigen::AngleAxisd(0.7, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    frame.translation() = Vec3(300.0, -40.0, 12.0);
    return frame;
}

BezierPatch dome() {
    return geometry::surface_preset("dome").make().patch(geometry::PatchId{0});
}

/// A height field z = f(x, y) over [0, 60] x [0, 40].
template <typename Height> TriangleMesh sheet(Height height) {
    constexpr int nx = 60;
    constexpr int ny = 40;
    TriangleMesh mesh;
    for (int i = 0; i <= nx; ++i) {
        for (int j = 0; j <= ny; ++j) {
            mesh.points.emplace_back(i, j, height(i, j));
        }
    }
    for (int i = 0; i < nx; ++i) {
        for (int j = 0; j < ny; ++j) {
            const int a = i * (ny + 1) + j;
            const int b = a + ny + 1;
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
        }
    }
    return mesh;
}

TEST(PatchFit, FindsTheSurfaceThatTheMeshWasMadeFrom) {
    const TriangleMesh mesh = mesh_of(dome(), 60);
    const MeshFit fit = fit_patch(mesh, {.degree_u = 3, .degree_v = 3}, {});
    EXPECT_TRUE(fit.follows_outline);
    EXPECT_LT(fit.deviation.max, 0.06); // the triangles themselves are up to 0.05 mm off
    EXPECT_LT(fit.deviation.rms, 0.02);
    EXPECT_EQ(fit.left_out_area, 0.0);
    EXPECT_EQ(fit.deviation.at_points.size(), mesh.points.size());
}

TEST(PatchFit, DoesNotCareWhereTheMeshLies) {
    const TriangleMesh mesh = mesh_of(dome(), 60);
    const FitSettings settings{.degree_u = 3, .degree_v = 3};
    const MeshFit here = fit_patch(mesh, settings, {});
    const MeshFit there = fit_patch(moved(mesh, somewhere()), settings, {});
    EXPECT_NEAR(there.deviation.max, here.deviation.max, 1e-3);
    EXPECT_NEAR(there.deviation.rms, here.deviation.rms, 1e-3);
}

TEST(PatchFit, OfAPlaneIsThePlane) {
    const MeshFit fit = fit_patch(sheet([](int i, int j) { return 0.3 * i - 0.1 * j + 5.0; }), {}, {});
    EXPECT_LT(fit.deviation.max, 1e-7);
    const auto normal = fit.patch.unit_normal(0.5, 0.5);
    ASSERT_TRUE(normal);
    EXPECT_LT((*normal - Vec3(-0.3, 0.1, 1.0).normalized()).norm(), 1e-7);
    // The corners of the patch are those of the sheet.
    EXPECT_LT((fit.patch.position(0.0, 0.0) - Vec3(0.0, 0.0, 5.0)).norm(), 1e-6);
    EXPECT_LT((fit.patch.position(1.0, 1.0) - Vec3(60.0, 40.0, 19.0)).norm(), 1e-6);
}

// Brute force: no point of a fine raster of the patch may be nearer than what is said.
TEST(PatchFit, DeviationIsTheDistanceToThePatch) {
    const auto bump = [](int i, int j) {
        return 4.0 * std::exp(-0.05 * (std::pow(i - 20.0, 2) + std::pow(j - 25.0, 2)));
    };
    const MeshFit fit = fit_patch(sheet(bump), {.degree_u = 3, .degree_v = 4}, {});
    EXPECT_GT(fit.deviation.max, 0.5);
    constexpr int raster = 200;
    double max = 0.0;
    for (std::size_t n = 0; n < fit.side.points.size(); n += 97) {
        double nearest = 1e9;
        double cell = 0.0; // diagonal of the raster there
        for (int i = 0; i < raster; ++i) {
            for (int j = 0; j < raster; ++j) {
                const auto at = [&](int di, int dj) {
                    return fit.patch.position((i + di) / double{raster}, (j + dj) / double{raster});
                };
                const double distance = (at(0, 0) - fit.side.points[n]).norm();
                if (distance < nearest) {
                    nearest = distance;
                    cell = (at(1, 1) - at(0, 0)).norm();
                }
            }
        }
        const double said = std::abs(fit.deviation.at_points[n]);
        EXPECT_LE(said, nearest + 1e-9) << n;
        EXPECT_GT(said, nearest - cell) << n;
        max = std::max(max, said);
    }
    EXPECT_LE(max, fit.deviation.max);
    // The sheet stands out above the patch at the top of the bump: the sign says so.
    const std::size_t top = 20 * 41 + 25;
    EXPECT_GT(fit.deviation.at_points[top], 0.5);
}

TEST(PatchFit, HigherDegreesComeNearer) {
    const auto wave = [](int i, int j) { return 3.0 * std::sin(0.12 * i) * std::cos(0.1 * j); };
    double last = 1e9;
    for (const int degree : {2, 4, 6}) {
        const MeshFit fit = fit_patch(sheet(wave), {.degree_u = degree, .degree_v = degree}, {});
        EXPECT_LT(fit.deviation.rms, 0.5 * last) << degree;
        last = fit.deviation.rms;
    }
    EXPECT_LT(last, 0.01);
}

// Points that slid along the sides turned a corner of degree 4 over: its second control point went to
// y = -4.9.
TEST(PatchFit, DoesNotFoldAtItsCorners) {
    const auto wave = [](int i, int j) { return 3.0 * std::sin(0.12 * i) * std::cos(0.1 * j); };
    for (const int degree : {2, 3, 4, 5, 6}) {
        const BezierPatch patch = fit_patch(sheet(wave), {.degree_u = degree, .degree_v = degree}, {}).patch;
        for (int i = 0; i <= 60; ++i) {
            for (int j = 0; j <= 60; ++j) {
                const auto normal = patch.unit_normal(i / 60.0, j / 60.0);
                EXPECT_TRUE(normal && normal->z() > 0.0) << degree << ": " << i << ", " << j;
            }
        }
    }
}

TEST(PatchFit, OfAClosedBodyTakesTheTop) {
    TriangleMesh box;
    for (int n = 0; n < 8; ++n) {
        box.points.emplace_back(
            (n & 1) != 0 ? 30.0 : 0.0, (n & 2) != 0 ? 20.0 : 0.0, (n & 4) != 0 ? 10.0 : 0.0);
    }
    box.triangles = {{0, 2, 1},
                     {1, 2, 3},
                     {4, 5, 6},
                     {5, 7, 6},
                     {0, 1, 4},
                     {1, 5, 4},
                     {2, 6, 3},
                     {3, 6, 7},
                     {0, 4, 2},
                     {2, 4, 6},
                     {1, 3, 5},
                     {3, 7, 5}};
    const MeshFit fit = fit_patch(box, {.degree_u = 2, .degree_v = 2}, {});
    EXPECT_EQ(fit.along, Vec3(Vec3::UnitZ()));
    EXPECT_EQ(fit.side.triangles.size(), 2u);
    EXPECT_NEAR(fit.left_out_area, 600.0 + 2.0 * (300.0 + 200.0), 1e-9);
    EXPECT_LT(fit.deviation.max, 1e-7);
    EXPECT_NEAR(fit.patch.position(0.5, 0.5).z(), 10.0, 1e-7);

    const MeshFit bottom = fit_patch(box, {.degree_u = 2, .degree_v = 2, .along = Vec3(-Vec3::UnitZ())}, {});
    EXPECT_NEAR(bottom.patch.position(0.5, 0.5).z(), 0.0, 1e-7);
}

TEST(PatchFit, EmptyCornersStayTame) {
    TriangleMesh disk;
    disk.points.emplace_back(0.0, 0.0, 3.0);
    constexpr int around = 90;
    for (int n = 0; n < around; ++n) {
        const double angle = 2.0 * std::numbers::pi * n / around;
        disk.points.emplace_back(20.0 * std::cos(angle), 20.0 * std::sin(angle), 0.0);
        disk.triangles.push_back({0, 1 + n, 1 + (n + 1) % around});
    }
    const MeshFit fit = fit_patch(disk, {.degree_u = 6, .degree_v = 6}, {});
    EXPECT_FALSE(fit.follows_outline);
    const Box3 box = fit.patch.control_box();
    EXPECT_LT(box.max().cwiseAbs().maxCoeff(), 60.0);
    EXPECT_LT(box.min().cwiseAbs().maxCoeff(), 60.0);
    EXPECT_LT(fit.deviation.rms, 0.3);
}

/// 18 triangles for 36 control points: the net went as far as 30 mm beyond a part of 60 mm.
TEST(PatchFit, KeepsTheNetNearACoarseMesh) {
    TriangleMesh mesh;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const bool inner_u = i == 1 || i == 2, inner_v = j == 1 || j == 2;
            mesh.points.emplace_back(
                20.0 * i - 30.0, 20.0 * j - 30.0, (inner_u ? 7.0 : 0.0) + (inner_v ? 7.0 : 0.0));
        }
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const int a = 4 * i + j;
            mesh.triangles.push_back({a, a + 4, a + 5});
            mesh.triangles.push_back({a, a + 5, a + 1});
        }
    }
    const MeshFit fit = fit_patch(mesh, {}, {});
    EXPECT_TRUE(stays_near(fit.patch, mesh.points, 0.25))
        << fit.patch.control_box().min().transpose() << " to " << fit.patch.control_box().max().transpose();
    EXPECT_LT(fit.deviation.max, 1.3);
}

TEST(PatchFit, SaysWhatIsWrong) {
    TriangleMesh wall;
    wall.points = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 1.0}};
    wall.triangles = {{0, 1, 2}};
    EXPECT_THROW((void)fit_patch(wall, {.along = Vec3(Vec3::UnitZ())}, {}), Error);
    EXPECT_THROW((void)fit_patch(wall, {.degree_u = 0}, {}), Defect);
    EXPECT_THROW((void)fit_patch(wall, {.degree_v = max_fit_degree + 1}, {}), Defect);
}

TEST(PatchFit, CanBeCancelled) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)fit_patch(mesh_of(dome(), 20), {}, Progress({}, stop.get_token())), Cancelled);
}

TEST(PatchFit, SameBytesOnAnyNumberOfThreads) {
    const auto wave = [](int i, int j) { return 3.0 * std::sin(0.12 * i) * std::cos(0.1 * j); };
    const MeshFit one = fit_patch(sheet(wave), {}, {});
    const MeshFit again = fit_patch(sheet(wave), {}, {});
    EXPECT_EQ(one.patch, again.patch);
    EXPECT_EQ(one.deviation.at_points, again.deviation.at_points);
}

} // namespace
} // namespace millwright::exchange
