#include "core/region/flattening.h"

#include "core/base/error.h"
#include "core/region/internal/distortion.h"
#include "tests/support/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace millwright::region {
namespace {

using geometry::BezierPatch;
using test::faces_of;
using test::rectangle;

FaceMesh sheet(const std::vector<BezierPatch>& patches) {
    return face_mesh(faces_of(patches), {.tolerance = 0.01, .triangles = 2000}, Progress());
}

const Vec3& corner_point(const FaceMesh& mesh, int corner) {
    return mesh.points[static_cast<std::size_t>(mesh.boundary[static_cast<std::size_t>(corner)])];
}

/// A quarter of a cylinder of radius 20 and height 30 by rational arcs, in two faces.
std::vector<BezierPatch> cylinder() {
    geometry::ControlNet net = geometry::ControlNet::sized(3, 2);
    for (int j = 0; j < 2; ++j) {
        net.point(0, j) = {20.0, 0.0, 30.0 * j};
        net.point(1, j) = {20.0, 20.0, 30.0 * j};
        net.point(2, j) = {0.0, 20.0, 30.0 * j};
        net.weight(1, j) = std::numbers::sqrt2 / 2.0;
    }
    auto [low, high] = geometry::split(BezierPatch(net), geometry::Parameter::u, 0.3);
    return {low, high};
}

TEST(Flattening, ConformalUnrollsACylinderWithoutDistortion) {
    const FaceMesh mesh = sheet(cylinder());
    const Flattening flat = conformal(mesh);
    EXPECT_TRUE(flat.injective());
    EXPECT_LT(flat.distortion, 1.0002);
    EXPECT_LT(flat.area_ratio, 1.005);
    const auto along = [&](std::size_t from, std::size_t to) {
        return (flat.places[static_cast<std::size_t>(mesh.boundary[from])] -
                flat.places[static_cast<std::size_t>(mesh.boundary[to])])
            .norm();
    };
    double widest = 0.0;
    for (std::size_t n = 1; n < mesh.boundary.size(); ++n) {
        widest = std::max(widest, along(0, n));
    }
    EXPECT_NEAR(widest, std::hypot(30.0, 10.0 * std::numbers::pi), 0.05);
}

TEST(Flattening, HarmonicFindsTheCornersOfARectangle) {
    const FaceMesh mesh = sheet({rectangle(0, 0, 12, 20), rectangle(12, 0, 28, 20)});
    const SheetCorners corners = proposed_corners(mesh, Progress());
    EXPECT_LT((corner_point(mesh, corners[0]) - Vec3(0, 0, 0)).norm(), 1e-9);
    EXPECT_LT((corner_point(mesh, corners[1]) - Vec3(40, 0, 0)).norm(), 1e-9);
    EXPECT_LT((corner_point(mesh, corners[2]) - Vec3(40, 20, 0)).norm(), 1e-9);
    EXPECT_LT((corner_point(mesh, corners[3]) - Vec3(0, 20, 0)).norm(), 1e-9);
    for (const Flattening& flat : {harmonic(mesh, corners), mean_value(mesh, corners)}) {
        EXPECT_TRUE(flat.injective());
        EXPECT_NEAR(flat.distortion, 1.0, 1e-9) << name_of(flat.method);
        for (std::size_t n = 0; n < mesh.points.size(); ++n) {
            const Vec2 exact(mesh.points[n].x() / 40.0, mesh.points[n].y() / 20.0);
            EXPECT_LT((flat.places[n] - exact).norm(), 1e-9);
        }
    }
    EXPECT_LT((extent_of(mesh, harmonic(mesh, corners).places) - Vec2(40, 20)).norm(), 1e-6);
}

// An L has six corners: the four that are found distort it less than those of its arms.
TEST(Flattening, SearchedCornersDistortLessThanOthers) {
    const FaceMesh mesh =
        sheet({rectangle(0, 0, 20, 20), rectangle(20, 0, 20, 20), rectangle(0, 20, 20, 20)});
    const Flattening found = harmonic(mesh, proposed_corners(mesh, Progress()));
    EXPECT_TRUE(found.injective());
    const std::array<Vec3, 4> others{Vec3(0, 0, 0), Vec3(20, 0, 0), Vec3(40, 0, 0), Vec3(20, 20, 0)};
    const Flattening worse = harmonic(mesh, corners_near(mesh, others));
    EXPECT_LT(found.distortion, 0.8 * worse.distortion);
}

TEST(Flattening, CornersAreEditedByPlaces) {
    const FaceMesh mesh = sheet({rectangle(0, 0, 20, 20)});
    const SheetCorners corners =
        corners_near(mesh, {Vec3(20.3, 20, 0), Vec3(20, -1, 0), Vec3(0, 20, 0.5), Vec3(0.1, 0, 0)});
    EXPECT_LT((corner_point(mesh, corners[0]) - Vec3(20, 20, 0)).norm(), 1e-9);
    EXPECT_LT((corner_point(mesh, corners[1]) - Vec3(0, 20, 0)).norm(), 1e-9) << "counter-clockwise";
    EXPECT_LT((corner_point(mesh, corners[3]) - Vec3(20, 0, 0)).norm(), 1e-9);
    const std::array<Vec3, 4> twice{Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(20, 20, 0), Vec3(0, 20, 0)};
    EXPECT_THROW((void)corners_near(mesh, twice), Error);
    EXPECT_THROW((void)harmonic(mesh, {0, 2, 1, 3}), Defect);
}

TEST(Flattening, ReportsFoldsWithTheirPlaces) {
    const FaceMesh mesh = sheet({rectangle(0, 0, 20, 20)});
    Flattening flat = harmonic(mesh, proposed_corners(mesh, Progress()));
    ASSERT_TRUE(flat.injective());
    const auto inside = static_cast<std::size_t>(mesh.triangles[mesh.triangles.size() / 3].corners[0]);
    flat.places[inside] += Vec2(0.2, 0.0);
    measure(mesh, flat);
    ASSERT_FALSE(flat.injective());
    EXPECT_TRUE(std::isinf(flat.distortion));
    for (const Vec3& fold : flat.folds) {
        EXPECT_LT((fold - mesh.points[inside]).norm(), 2.0);
    }
}

/// With u and v changed for each other and u the other way.
BezierPatch turned_quarter(const BezierPatch& patch) {
    const geometry::ControlNet& own = patch.net();
    geometry::ControlNet net = geometry::ControlNet::sized(own.columns, own.rows);
    for (int i = 0; i < own.rows; ++i) {
        for (int j = 0; j < own.columns; ++j) {
            net.point(own.columns - 1 - j, i) = own.point(i, j);
        }
    }
    return BezierPatch(std::move(net));
}

TEST(Flattening, OwnParametersOfADividedPatchAreThoseOfThePatch) {
    std::vector<BezierPatch> patches = test::quarters(test::patch_of("two-bell"), 0.3, 0.6);
    patches[1] = turned_quarter(patches[1]);
    patches[3] = turned_quarter(turned_quarter(patches[3]));
    const FaceMesh mesh = sheet(patches);
    const auto flat = own_parameters(faces_of(patches), mesh);
    ASSERT_TRUE(flat);
    EXPECT_TRUE(flat->injective());
    const BezierPatch whole = test::patch_of("two-bell");
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
        const Vec2& at = flat->places[n];
        EXPECT_LT((whole.position(at.x(), at.y()) - mesh.points[n]).norm(), 1e-6) << at.transpose();
    }
    EXPECT_EQ(flattened(faces_of(patches), mesh, std::nullopt, Progress()).method,
              FlatteningMethod::own_parameters);
}

TEST(Flattening, FacesThatDoNotContinueOneAnotherHaveNoParametersInCommon) {
    const auto own = [](const std::vector<BezierPatch>& patches) {
        return own_parameters(faces_of(patches), sheet(patches));
    };
    EXPECT_FALSE(own({rectangle(0, 0, 20, 20), rectangle(20, 0, 20, 20), rectangle(0, 20, 20, 20)}))
        << "an L";
    EXPECT_FALSE(own({rectangle(0, 0, 20, 10), rectangle(0, 10, 10, 10), rectangle(10, 10, 10, 10)}))
        << "a half beside two quarters";
    EXPECT_FALSE(
        own({rectangle(0, 0, 20, 20), test::bilinear({20, 0, 0}, {40, 9, 0}, {20, 20, 0}, {40, 29, 0})}))
        << "a bend";
    EXPECT_TRUE(own({rectangle(0, 0, 20, 20), rectangle(20, 0, 5, 20)}));
}

TEST(Flattening, IsHarmonicWhereNothingFolds) {
    const std::vector<BezierPatch> patches = cylinder();
    const FaceMesh mesh = sheet(patches);
    const SheetCorners corners = proposed_corners(mesh, Progress());
    const Flattening taken = flattened(faces_of(patches), mesh, corners, Progress());
    EXPECT_EQ(taken.method, FlatteningMethod::harmonic);
    EXPECT_EQ(taken.corners, corners);
}

// The map belongs to the surface: another division of it changes the distortion by little.
TEST(Flattening, HarmonicHardlyDependsOnTheMesh) {
    const BezierPatch dome = test::patch_of("dome");
    const std::array<Vec3, 4> ends{
        dome.position(0, 0), dome.position(1, 0), dome.position(1, 1), dome.position(0, 1)};
    const FaceMesh one = sheet({dome}), four = sheet(test::quarters(dome, 0.4, 0.7));
    EXPECT_NEAR(harmonic(one, corners_near(one, ends)).distortion,
                harmonic(four, corners_near(four, ends)).distortion,
                1e-3);
}

/// 60 mm long; two of its sides are points.
BezierPatch lens(double width) {
    geometry::ControlNet net = geometry::ControlNet::sized(3, 2);
    for (int j = 0; j < 2; ++j) {
        net.point(0, j) = {0, 0, 0};
        net.point(1, j) = {30, (j - 0.5) * 2.0 * width, 6};
        net.point(2, j) = {60, 0, 0};
    }
    return BezierPatch(std::move(net));
}

// Its triangles have to be as wide as they are long all the same.
TEST(Flattening, SpreadsOutALens) {
    const FaceMesh mesh = sheet({lens(12.0)});
    const Flattening free = conformal(mesh);
    EXPECT_TRUE(free.injective());
    EXPECT_LT(free.distortion, 1.02);
    EXPECT_TRUE(harmonic(mesh, proposed_corners(mesh, Progress())).injective());
}

TEST(Flattening, IsByMeanValuesWhereTheHarmonicMapFolds) {
    const std::vector<ExactFace> faces = faces_of({lens(4.0)});
    const FaceMesh mesh = face_mesh(faces, {.tolerance = 0.01, .triangles = 300}, Progress());
    ASSERT_GT(mesh.boundary.size(), 100U);
    const SheetCorners beside_the_tip{3, 12, 36, 49};
    ASSERT_FALSE(harmonic(mesh, beside_the_tip).injective());
    const Flattening taken = flattened(faces, mesh, beside_the_tip, Progress());
    EXPECT_EQ(taken.method, FlatteningMethod::mean_value);
    EXPECT_TRUE(taken.injective());
}

TEST(Flattening, RefusesCornersByWhichEachWayFolds) {
    const std::vector<ExactFace> faces = faces_of({lens(4.0)});
    const FaceMesh mesh = face_mesh(faces, {.tolerance = 0.01, .triangles = 300}, Progress());
    try {
        (void)flattened(faces, mesh, SheetCorners{1, 3, 77, 83}, Progress());
        FAIL() << "taken";
    } catch (const Error& error) {
        const std::string& text = error.diagnostic().message;
        EXPECT_EQ(text.find("the faces fold in "), 0U) << text;
        EXPECT_NE(text.find(", the first at x "), std::string::npos) << text;
    }
}

} // namespace
} // namespace millwright::region
