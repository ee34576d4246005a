#include "core/geometry/patch_refinement.h"

#include "core/base/error.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::geometry {
namespace {

BezierPatch rational_patch(int rows, int columns, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off(-1.0, 1.0), weight(0.3, 3.0);
    ControlNet net = ControlNet::sized(rows, columns);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            net.point(i, j) = Vec3(10.0 * i + off(random), 10.0 * j + off(random), 5.0 * off(random));
            net.weight(i, j) = weight(random);
        }
    }
    return BezierPatch(net);
}

TEST(PatchRefinement, ElevatedIsTheSameSurface) {
    const BezierPatch patch = rational_patch(3, 4, 1);
    const BezierPatch higher = elevated(patch, 5, 4);
    EXPECT_EQ(higher.degree_u(), 5);
    EXPECT_EQ(higher.degree_v(), 4);
    for (double u = 0.0; u <= 1.0; u += 0.125) {
        for (double v = 0.0; v <= 1.0; v += 0.125) {
            EXPECT_NEAR((patch.position(u, v) - higher.position(u, v)).norm(), 0.0, 1e-12);
        }
    }
    EXPECT_THROW((void)elevated(patch, 1, 4), Defect);
}

TEST(PatchRefinement, HalvesAreTheSameSurface) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const BezierPatch patch =
            rational_patch(2 + static_cast<int>(seed % 4), 2 + static_cast<int>(seed % 5), seed);
        const double at = 0.05 + 0.045 * seed;
        const auto along_u = split(patch, Parameter::u, at);
        const auto along_v = split(patch, Parameter::v, at);
        EXPECT_EQ(along_u.first.degree_u(), patch.degree_u());
        EXPECT_EQ(along_v.second.degree_v(), patch.degree_v());
        for (double s = 0.0; s <= 1.0; s += 0.125) {
            for (double t = 0.0; t <= 1.0; t += 0.125) {
                const double before = at * s, behind = at + (1.0 - at) * s;
                const auto apart =
                    [&](const BezierPatch& half, double u, double v, double whole_u, double whole_v) {
                        return (half.position(u, v) - patch.position(whole_u, whole_v)).norm();
                    };
                EXPECT_NEAR(apart(along_u.first, s, t, before, t), 0.0, 1e-11);
                EXPECT_NEAR(apart(along_u.second, s, t, behind, t), 0.0, 1e-11);
                EXPECT_NEAR(apart(along_v.first, t, s, t, before), 0.0, 1e-11);
                EXPECT_NEAR(apart(along_v.second, t, s, t, behind), 0.0, 1e-11);
            }
        }
    }
}

TEST(PatchRefinement, IsSplitInside) {
    const test::WithoutTraps nan_is_handed_in;
    const BezierPatch patch = rational_patch(3, 3, 1);
    EXPECT_THROW((void)split(patch, Parameter::u, 0.0), Defect);
    EXPECT_THROW((void)split(patch, Parameter::v, 1.0), Defect);
    EXPECT_THROW((void)split(patch, Parameter::v, std::nan("")), Defect);
}

} // namespace
} // namespace millwright::geometry
