#include "core/region/face_mesh.h"

#include "core/base/error.h"
#include "core/geometry/closest_point.h"
#include "tests/support/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace millwright::region {
namespace {

using geometry::BezierPatch;
using test::faces_of;
using test::rectangle;

FaceMesh mesh_of(const std::vector<BezierPatch>& patches, double tolerance = 0.01) {
    return face_mesh(faces_of(patches), {.tolerance = tolerance, .triangles = 2000}, Progress());
}

std::string refusal(const std::vector<BezierPatch>& patches, double tolerance = 0.01) {
    try {
        (void)mesh_of(patches, tolerance);
    } catch (const Error& error) {
        return error.diagnostic().message;
    }
    return "taken";
}

void expect_has(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

Vec3 area_vector(const FaceMesh& mesh, const FaceTriangle& triangle) {
    const auto point = [&](std::size_t k) {
        return mesh.points[static_cast<std::size_t>(triangle.corners[k])];
    };
    return 0.5 * (point(1) - point(0)).cross(point(2) - point(0));
}

TEST(FaceMesh, RemembersFaceAndParametersOfEveryCorner) {
    const std::vector<ExactFace> faces = faces_of(test::quarters(test::patch_of("dome"), 0.4, 0.7));
    const FaceMesh mesh = face_mesh(faces, {}, Progress());
    EXPECT_GT(mesh.triangles.size(), 6000U);
    EXPECT_LT(mesh.triangles.size(), 12000U);
    for (const FaceTriangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2& uv = triangle.parameters[k];
            const Vec3 exact =
                faces[static_cast<std::size_t>(triangle.face)].surface.position(uv.x(), uv.y());
            EXPECT_LT((exact - mesh.points[static_cast<std::size_t>(triangle.corners[k])]).norm(), 1e-9);
        }
    }
}

TEST(FaceMesh, IsOneDiscWithTheBoundaryOfTheUndividedPatch) {
    const FaceMesh mesh = mesh_of(test::quarters(test::patch_of("two-bell"), 0.5, 0.5));
    std::map<std::pair<int, int>, int> edges;
    for (const FaceTriangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++edges[std::minmax(triangle.corners[k], triangle.corners[(k + 1) % 3])];
        }
    }
    const auto once = std::ranges::count_if(edges, [](const auto& edge) { return edge.second == 1; });
    EXPECT_EQ(once, std::ssize(mesh.boundary));
    EXPECT_TRUE(std::ranges::all_of(edges, [](const auto& edge) { return edge.second <= 2; }));
    EXPECT_EQ(std::ssize(mesh.points) - std::ssize(edges) + std::ssize(mesh.triangles), 1);
    EXPECT_EQ(std::ranges::count_if(mesh.borders, [](const FaceBorder& b) { return b.sides.size() == 2; }),
              4);
    EXPECT_EQ(mesh.borders.size(), 12U);
    const BezierPatch whole = test::patch_of("two-bell");
    for (const int n : mesh.boundary) {
        const geometry::ClosestPoint at =
            geometry::ClosestPointSearch(whole).closest(mesh.points[static_cast<std::size_t>(n)]);
        const double to_side = std::min(at.parameters.minCoeff(), 1.0 - at.parameters.maxCoeff());
        EXPECT_LT(to_side, 1e-6);
        EXPECT_LT(at.distance, 1e-9);
    }
}

TEST(FaceMesh, TurnsOverWhatLooksToTheOtherSide) {
    std::vector<BezierPatch> patches = test::quarters(test::patch_of("dome"), 0.5, 0.5);
    patches[2] = test::swapped(patches[2]);
    const FaceMesh mesh = mesh_of(patches);
    EXPECT_EQ(mesh.turned_over, (std::vector<bool>{false, false, true, false}));
    const double first = area_vector(mesh, mesh.triangles.front()).z();
    const auto agrees = [&](const FaceTriangle& triangle) {
        return area_vector(mesh, triangle).z() * first > 0.0; // a height over the plane
    };
    EXPECT_TRUE(std::ranges::all_of(mesh.triangles, agrees));
}

TEST(FaceMesh, WeldsAHalfToTwoQuarters) {
    const auto [low, high] = geometry::split(test::patch_of("dome"), geometry::Parameter::u, 0.5);
    const auto [before, behind] = geometry::split(high, geometry::Parameter::v, 0.3);
    const FaceMesh mesh = mesh_of({low, before, behind});
    EXPECT_EQ(std::ranges::count_if(mesh.borders, [](const FaceBorder& b) { return b.sides.size() == 2; }),
              3);
}

TEST(FaceMesh, WeldsWhatIsApartByLessThanTheTolerance) {
    const std::vector<BezierPatch> patches{rectangle(0, 0, 10, 10), rectangle(10.02, 0, 10, 10, 0.01)};
    EXPECT_EQ(refusal(patches, 0.05), "taken");
    expect_has(refusal(patches, 0.005), "faces 1 and 2 do not touch: they are 0.02236 mm apart, at x 10.000");
}

TEST(FaceMesh, NamesTheGapOfABorderThatOnlyMeetsAtItsEnds) {
    geometry::ControlNet bulged = geometry::ControlNet::sized(3, 2);
    for (int i = 0; i < 3; ++i) {
        bulged.point(i, 0) = {5.0 * i, 10.0 + (i == 1 ? 0.4 : 0.0), 0.0};
        bulged.point(i, 1) = {5.0 * i, 20.0, 0.0};
    }
    expect_has(refusal({rectangle(0, 0, 10, 10), BezierPatch(bulged)}),
               "the borders of faces 1 and 2 are 0.2000 mm apart, at x 5.000");
}

TEST(FaceMesh, RefusesFacesThatLieOnOneAnother) {
    expect_has(refusal({test::patch_of("dome"), test::patch_of("dome")}), "faces 1 and 2 lie on one another");
    expect_has(refusal({rectangle(0, 0, 10, 10),
                        rectangle(10, 0, 10, 10),
                        rectangle(20, 0, 10, 10),
                        rectangle(24, 1, 20, 20)}),
               "do not touch");
    expect_has(refusal({rectangle(0, 0, 10, 10),
                        rectangle(10, 0, 10, 10),
                        test::bilinear({10, 10, 0}, {20, 10, 0}, {2, 4, 0}, {15, 20, 0})}),
               "overlap or touch within a face");
}

TEST(FaceMesh, RefusesThreeFacesAtOneBorder) {
    expect_has(refusal({rectangle(0, 0, 10, 10),
                        rectangle(10, 0, 10, 10),
                        test::bilinear({10, 0, 0}, {10, 0, 8}, {10, 10, 0}, {10, 10, 8})}),
               "more than two faces meet along one border: 1, 2, 3, at x 10.000, y 5.000");
}

TEST(FaceMesh, RefusesAFaceThatIsNarrowerThanTheTolerance) {
    const std::vector<BezierPatch> patches{
        rectangle(0, 0, 10, 10), rectangle(10, 0, 0.005, 10), rectangle(10.005, 0, 10, 10)};
    expect_has(refusal(patches), "face 2 is narrower than the tolerance of 0.01 mm, at x 10.00");
    EXPECT_EQ(refusal(patches, 0.001), "taken");
}

/// Pieces of a ring of radius 30, straight between lines of length 10 that turn by `twist` once around.
std::vector<BezierPatch> ring(double twist) {
    constexpr int count = 12;
    const auto end = [&](int n, double along) {
        const double around = 2.0 * std::numbers::pi * n / count, turn = twist * n / count;
        const double out = 30.0 + 5.0 * along * std::cos(turn);
        return Vec3(out * std::cos(around), out * std::sin(around), 5.0 * along * std::sin(turn));
    };
    std::vector<BezierPatch> patches;
    for (int n = 0; n < count; ++n) {
        patches.push_back(test::bilinear(end(n, -1.0), end(n, 1.0), end(n + 1, -1.0), end(n + 1, 1.0)));
    }
    return patches;
}

TEST(FaceMesh, RefusesRingsAndStripsWithASingleSide) {
    expect_has(refusal(ring(0.0)), "form a ring: a second boundary");
    expect_has(refusal(ring(std::numbers::pi)), "single side, like a Moebius strip");
}

TEST(FaceMesh, RefusesAHoleWithItsPlace) {
    std::vector<BezierPatch> patches;
    for (int n = 0; n < 9; ++n) {
        if (n != 4) {
            patches.push_back(rectangle(10.0 * (n / 3), 10.0 * (n % 3), 10, 10));
        }
    }
    const std::string text = refusal(patches);
    expect_has(text, "a second boundary of 40.000 mm, at x 1");
}

TEST(FaceMesh, RefusesAClosedShell) {
    const auto corner = [](int x, int y, int z) { return Vec3(10.0 * x, 10.0 * y, 10.0 * z); };
    std::vector<BezierPatch> cube;
    for (const int end : {0, 1}) {
        cube.push_back(
            test::bilinear(corner(end, 0, 0), corner(end, 1, 0), corner(end, 0, 1), corner(end, 1, 1)));
        cube.push_back(
            test::bilinear(corner(0, end, 0), corner(0, end, 1), corner(1, end, 0), corner(1, end, 1)));
        cube.push_back(
            test::bilinear(corner(0, 0, end), corner(1, 0, end), corner(0, 1, end), corner(1, 1, end)));
    }
    expect_has(refusal(cube), "closed shell without a boundary");
    cube.pop_back();
    EXPECT_EQ(refusal(cube), "taken");
}

TEST(FaceMesh, RefusesFacesThatTouchAtAPointAlone) {
    expect_has(refusal({rectangle(0, 0, 10, 10), rectangle(10, 10, 10, 10)}),
               "faces 1 and 2 touch at a point alone, at x 10.000, y 10.000");
    expect_has(refusal({rectangle(0, 0, 10, 10),
                        rectangle(10, 0, 10, 10),
                        rectangle(20, 0, 10, 10),
                        rectangle(20, 10, 10, 10),
                        test::bilinear({20, 10, 0}, {20, 20, 0}, {10, 10, 0}, {10, 20, 0}),
                        rectangle(0, 10, 10, 10, 0.0)}),
               "taken");
    expect_has(refusal({rectangle(0, 0, 10, 10),
                        rectangle(10, 0, 10, 10),
                        rectangle(20, 0, 10, 10),
                        rectangle(20, 10, 10, 10),
                        rectangle(20, 20, 10, 10),
                        rectangle(10, 20, 10, 10),
                        rectangle(0, 10, 10, 10)}),
               "touch at a point alone, at x 10.000, y 20.000");
}

TEST(FaceMesh, TakesASideThatIsOnePoint) {
    const Vec3 tip(0, 0, 0);
    const FaceMesh mesh = mesh_of(
        {test::bilinear(tip, tip, {10, 0, 0}, {8, 8, 0}), test::bilinear(tip, tip, {8, 8, 0}, {0, 10, 0})});
    double area = 0.0;
    for (const FaceTriangle& triangle : mesh.triangles) {
        area += area_vector(mesh, triangle).norm();
    }
    EXPECT_NEAR(area, 80.0, 1e-9);
}

TEST(FaceMesh, RefusesNoFaceSliversAndTooMany) {
    EXPECT_EQ(refusal({}), "no face is chosen");
    expect_has(refusal({rectangle(0, 0, 0.004, 0.004), rectangle(10, 0, 10, 10)}),
               "face 1 is no larger than the tolerance of 0.01 mm, at x 0.000");
    std::vector<BezierPatch> many;
    for (int n = 0; n <= most_region_faces; ++n) {
        many.push_back(rectangle(n, 0, 1, 1));
    }
    EXPECT_EQ(refusal(many), "201 faces are too many for one region: the maximum is 200");
}

} // namespace
} // namespace millwright::region
