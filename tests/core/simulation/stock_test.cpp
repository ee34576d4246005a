#include "core/simulation/stock.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/simulation/dexel_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace millwright::simulation {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t stock_bytes = 500'000'000;

/// A box whose faces are two triangles each, outwards.
MeshStock box_mesh(const Vec3& low, const Vec3& high) {
    MeshStock mesh;
    for (int n = 0; n < 8; ++n) {
        mesh.points.emplace_back((n & 1) != 0 ? high.x() : low.x(),
                                 (n & 2) != 0 ? high.y() : low.y(),
                                 (n & 4) != 0 ? high.z() : low.z());
    }
    for (const std::array<int, 4>& face : {std::array{0, 2, 3, 1},
                                           std::array{4, 5, 7, 6},
                                           std::array{0, 1, 5, 4},
                                           std::array{2, 6, 7, 3},
                                           std::array{0, 4, 6, 2},
                                           std::array{1, 3, 7, 5}}) {
        mesh.triangles.push_back({face[0], face[1], face[2]});
        mesh.triangles.push_back({face[0], face[2], face[3]});
    }
    return mesh;
}

Stock stock_of(MeshStock mesh) {
    return std::make_shared<const MeshStock>(std::move(mesh));
}

/// Both in one mesh.
MeshStock together(MeshStock a, const MeshStock& b) {
    const int shift = static_cast<int>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const auto& t : b.triangles) {
        a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    }
    return a;
}

/// A ball of triangles.
MeshStock ball_mesh(double radius, int rows) {
    MeshStock mesh;
    const int columns = 2 * rows;
    mesh.points.emplace_back(0.0, 0.0, radius);
    for (int i = 1; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const double a = pi * i / rows, b = 2.0 * pi * j / columns;
            mesh.points.emplace_back(
                radius * std::sin(a) * std::cos(b), radius * std::sin(a) * std::sin(b), radius * std::cos(a));
        }
    }
    mesh.points.emplace_back(0.0, 0.0, -radius);
    const auto at = [&](int i, int j) { return 1 + (i - 1) * columns + j % columns; };
    const int last = static_cast<int>(mesh.points.size()) - 1;
    for (int j = 0; j < columns; ++j) {
        mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
        mesh.triangles.push_back({last, at(rows - 1, j + 1), at(rows - 1, j)});
        for (int i = 1; i + 1 < rows; ++i) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

TEST(Stock, BoundsAndVolumesAreThoseOfTheShapes) {
    const Stock box = BoxStock{{1.0, 2.0, 3.0}, {4.0, 6.0, 8.0}};
    EXPECT_DOUBLE_EQ(volume(box), 60.0);
    const Stock tube =
        CylinderStock{.base = {10.0, 0.0, 0.0}, .axis = 0, .diameter = 20.0, .bore = 10.0, .length = 30.0};
    EXPECT_NEAR(volume(tube), pi * 75.0 * 30.0, 1e-9);
    EXPECT_EQ(bounds(tube).min(), Vec3(10.0, -10.0, -10.0));
    EXPECT_EQ(bounds(tube).max(), Vec3(40.0, 10.0, 10.0));
    EXPECT_NEAR(volume(stock_of(box_mesh({1.0, 2.0, 3.0}, {4.0, 6.0, 8.0}))), 60.0, 1e-12);
}

TEST(Stock, UncutFieldsHaveTheVolumeOfTheStock) {
    const auto share = [](const Stock& stock, double pitch) {
        return DexelField(stock, pitch, stock_bytes, Progress()).volume() / volume(stock);
    };
    EXPECT_NEAR(share(BoxStock{{-1.0, 0.0, 0.0}, {6.3, 4.7, 2.9}}, 0.5), 1.0, 1e-6);
    for (const int axis : {0, 1, 2}) {
        const CylinderStock tube{
            .base = {1.0, 2.0, 3.0}, .axis = axis, .diameter = 20.0, .bore = 9.0, .length = 31.0};
        EXPECT_NEAR(share(tube, 0.2), 1.0, 2e-4) << axis;
    }
    EXPECT_NEAR(share(stock_of(box_mesh({-1.0, 0.0, 0.0}, {6.3, 4.7, 2.9})), 0.5), 1.0, 1e-6);
    EXPECT_NEAR(share(stock_of(ball_mesh(10.0, 40)), 0.2), 1.0, 2e-4);
}

TEST(Stock, LinesThroughEdgesAndCornersOfAMeshAreCounted) {
    // A cube whose faces' diagonals pass exactly through the lines.
    const Stock cube = stock_of(box_mesh(Vec3::Zero(), Vec3::Constant(8.0)));
    const DexelField field(cube, 1.0, stock_bytes, Progress());
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 8; ++j) {
                ASSERT_EQ(field.line(k, i, j).size(), 1U) << k << ' ' << i << ' ' << j;
                EXPECT_EQ(field.line(k, i, j)[0], (Dexel{0.0F, 8.0F}));
            }
        }
    }
}

TEST(Stock, MeshesWithAHollowKeepIt) {
    MeshStock hollow = box_mesh(Vec3::Zero(), Vec3::Constant(10.0));
    MeshStock inside = box_mesh(Vec3::Constant(3.0), Vec3::Constant(7.0));
    for (auto& triangle : inside.triangles) {
        std::swap(triangle[0], triangle[1]);
    }
    const Stock stock = stock_of(together(hollow, inside));
    EXPECT_THAT(fault_of(stock), IsEmpty());
    EXPECT_NEAR(DexelField(stock, 0.23, stock_bytes, Progress()).volume(), 1000.0 - 64.0, 0.9);
}

TEST(Stock, RefusesAnOpenMeshWithThePlace) {
    MeshStock open = box_mesh(Vec3::Zero(), Vec3::Constant(5.0));
    open.triangles.pop_back();
    EXPECT_THAT(fault_of(stock_of(open)),
                HasSubstr("is open: 3 edges belong to one triangle, the first from"));
    EXPECT_THROW(DexelField(stock_of(open), 1.0, stock_bytes, Progress()), Error);
}

TEST(Stock, RefusesAMeshThatCrossesItselfWithThePlace) {
    const MeshStock a = box_mesh(Vec3::Zero(), Vec3::Constant(5.0));
    const Stock both = stock_of(together(a, box_mesh(Vec3::Constant(2.0), Vec3::Constant(8.0))));
    EXPECT_THAT(fault_of(both), IsEmpty()); // every edge has two triangles
    try {
        const DexelField field(both, 0.5, stock_bytes, Progress());
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.diagnostic().message, HasSubstr("crosses itself"));
        EXPECT_THAT(error.diagnostic().message, HasSubstr("near 2"));
    }
}

TEST(Stock, RefusesWhatIsInsideOutEmptyOrNotFinite) {
    MeshStock mesh = box_mesh(Vec3::Zero(), Vec3::Constant(5.0));
    for (auto& triangle : mesh.triangles) {
        std::swap(triangle[0], triangle[1]);
    }
    EXPECT_THAT(fault_of(stock_of(mesh)), HasSubstr("look inwards"));
    EXPECT_THAT(fault_of(stock_of({})), HasSubstr("no triangles"));
    mesh.points[0].x() = std::numeric_limits<double>::infinity();
    EXPECT_THAT(fault_of(stock_of(mesh)), HasSubstr("not finite"));
    EXPECT_THAT(fault_of(BoxStock{Vec3::Zero(), Vec3(1.0, 0.0, 1.0)}), HasSubstr("longer than 0"));
    EXPECT_THAT(fault_of(CylinderStock{.diameter = 5.0, .bore = 5.0}), HasSubstr("does not fit"));
    EXPECT_THAT(fault_of(CylinderStock{.diameter = 0.0}), HasSubstr("above 0"));
}

TEST(DexelField, RefusesWhatDoesNotFitIntoMemoryWithNumbers) {
    const Stock box = BoxStock{Vec3::Zero(), Vec3::Constant(100.0)};
    try {
        const DexelField field(box, 0.01, 100'000'000, Progress());
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.diagnostic().message, HasSubstr("0.01 mm asks for 300000000 lines"));
        EXPECT_THAT(error.diagnostic().message, HasSubstr("100 MB may be used"));
        EXPECT_THAT(error.diagnostic().hint, HasSubstr("mm fits"));
    }
    const double fits = pitch_within(bounds(box), 100'000'000);
    EXPECT_LE(field_size(bounds(box), 1.01 * fits).bytes, 100'000'000U);
    EXPECT_GT(field_size(bounds(box), 0.97 * fits).bytes, 100'000'000U);
}

TEST(DexelField, ForecastIsNotBelowWhatAnUncutFieldTakes) {
    const Stock box = BoxStock{Vec3::Zero(), {60.0, 50.0, 20.0}};
    const DexelField field(box, 0.5, stock_bytes, Progress());
    EXPECT_LE(field.bytes(), field_size(bounds(box), 0.5).bytes);
    EXPECT_GT(2 * field.bytes(), field_size(bounds(box), 0.5).bytes);
}

} // namespace
} // namespace millwright::simulation
