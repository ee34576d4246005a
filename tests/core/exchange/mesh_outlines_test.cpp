#include "core/base/error.h"
#include "core/exchange/internal/visible_side.h"
#include "core/exchange/patch_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace millwright::exchange {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Inside = std::function<bool(double, double)>;

/// The cells of a raster of 100 x 100 mm whose middles lie inside; `height`: of all of them, mm.
TriangleMesh cells(const Inside& inside, int steps = 50, double height = 0.0) {
    const double cell = 100.0 / steps;
    TriangleMesh mesh;
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; j <= steps; ++j) {
            mesh.points.emplace_back(cell * i, cell * j, height + 3.0 * std::sin(cell * i / 30.0));
        }
    }
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const int a = i * (steps + 1) + j;
            const int b = a + steps + 1;
            if (inside(cell * (i + 0.5), cell * (j + 0.5))) {
                mesh.triangles.push_back({a, b, b + 1});
                mesh.triangles.push_back({a, b + 1, a + 1});
            }
        }
    }
    return mesh;
}

Inside around(double radius) {
    return [radius](double x, double y) { return std::hypot(x - 50.0, y - 50.0) > radius; };
}

bool is_l_shaped(double x, double y) {
    return x < 50.0 || y < 50.0;
}

bool is_u_shaped(double x, double y) {
    return x < 30.0 || x > 70.0 || y < 40.0;
}

bool is_everywhere(double, double) {
    return true;
}

TEST(MeshOutlines, CountCorners) {
    EXPECT_EQ(outlines_of(cells(is_everywhere), Vec3::UnitZ()).corners, 4);
    EXPECT_EQ(outlines_of(cells(is_l_shaped), Vec3::UnitZ()).corners, 6);
    EXPECT_EQ(outlines_of(cells(is_u_shaped), Vec3::UnitZ()).corners, 8);
    EXPECT_EQ(outlines_of(cells([](double x, double y) { return x + y < 100.0; }), Vec3::UnitZ()).corners, 3);
}

TEST(MeshOutlines, FindHolesWithTheirWidths) {
    EXPECT_THAT(outlines_of(cells(is_everywhere), Vec3::UnitZ()).holes, IsEmpty());
    EXPECT_THAT(outlines_of(cells(is_u_shaped), Vec3::UnitZ()).holes, IsEmpty());
    const MeshOutlines round = outlines_of(cells(around(17.5), 200), Vec3::UnitZ());
    EXPECT_EQ(round.corners, 4);
    EXPECT_THAT(round.holes, ElementsAre(::testing::DoubleNear(35.0, 0.6)));
    const auto two = [](double x, double y) {
        return std::max(std::abs(x - 20.0), std::abs(y - 20.0)) > 8.0 && y < 80.0;
    };
    const auto more = [&](double x, double y) { return two(x, y) && around(8.0)(x, y); };
    const auto holes = outlines_of(cells(more, 100), Vec3::UnitZ()).holes;
    ASSERT_EQ(holes.size(), 2U);
    EXPECT_NEAR(holes[0], 16.0 * std::sqrt(2.0), 0.1); // across the corners of the square one
    EXPECT_NEAR(holes[1], 16.0, 1.3);
}

TEST(MeshOutlines, TheFloorOfAPocketIsNoHole) {
    TriangleMesh mesh = cells(around(20.0));
    const TriangleMesh floor = cells([](double x, double y) { return !around(20.0)(x, y); }, 50, -10.0);
    const int first = static_cast<int>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), floor.points.begin(), floor.points.end());
    for (std::array<int, 3> triangle : floor.triangles) {
        for (int& corner : triangle) {
            corner += first;
        }
        mesh.triangles.push_back(triangle);
    }
    EXPECT_THAT(outlines_of(mesh, Vec3::UnitZ()).holes, IsEmpty());
}

TEST(MeshOutlines, AGapBetweenTrianglesIsNoHole) {
    TriangleMesh mesh = cells(is_everywhere);
    const int split = static_cast<int>(mesh.points.size());
    mesh.points.push_back(mesh.points[25 * 51 + 25] + Vec3(0.05, 0.0, 0.0)); // a vertex that came apart
    for (auto& triangle : mesh.triangles) {
        if (triangle[0] == 25 * 51 + 25) {
            triangle[0] = split;
        }
    }
    EXPECT_THAT(outlines_of(mesh, Vec3::UnitZ()).holes, IsEmpty());
}

TEST(MeshOutlines, APatchKnowsTheHolesThatItGoesAcross) {
    const MeshFit fit = fit_patch(cells(around(17.5)), {}, {});
    EXPECT_FALSE(fit.follows_outline);
    ASSERT_EQ(fit.holes.size(), 1U);
    EXPECT_NEAR(fit.holes.front(), 35.0, 3.0);
    EXPECT_GT(fit.deviation.patch_max, 15.0); // from its middle to the rim
    EXPECT_THAT(fit_patch(cells(is_everywhere), {}, {}).holes, IsEmpty());
}

/// It was said to fold over itself, and to want another degree.
TEST(MeshOutlines, AnOutlineThatIsNoneOfAPatchIsNamedWhereAPatchTurnsOver) {
    const auto is_thin = [](double x, double y) { return x < 12.0 || y < 12.0; };
    const auto is_thin_u = [](double x, double y) { return x < 12.0 || x > 88.0 || y < 12.0; };
    int refused = 0;
    for (int degree = 2; degree <= 6; ++degree) {
        for (const auto& [shape, corners] :
             {std::pair<Inside, int>{is_thin, 6}, {is_thin_u, 8}, {is_l_shaped, 6}}) {
            try {
                const MeshFit fit = fit_patch(cells(shape, 25), {.degree_u = degree, .degree_v = degree}, {});
                EXPECT_EQ(fit.outline_corners, corners);
            } catch (const Error& error) {
                ++refused;
                const std::string text = to_text(error.diagnostic());
                EXPECT_THAT(text,
                            HasSubstr("corners and a patch has four: following it, the patch turns over"));
                EXPECT_THAT(text, HasSubstr("cut the mesh into parts with four sides"));
            }
        }
    }
    EXPECT_GT(refused, 0);
}

} // namespace
} // namespace millwright::exchange
