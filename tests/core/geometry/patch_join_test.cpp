#include "core/geometry/patch_join.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::geometry {
namespace {

/// A wavy patch over [x, x + 10 width] x [y, y + 10], every point moved by up to `noise`.
BezierPatch wavy(int rows, int columns, const Vec2& at, double width, double noise, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off(-noise, noise);
    ControlNet net = ControlNet::sized(rows, columns);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const double x = at.x() + 10.0 * width * i / (rows - 1);
            const double y = at.y() + 10.0 * j / (columns - 1);
            net.point(i, j) =
                Vec3(x + off(random), y + off(random), 2.0 * std::sin(0.3 * x + 0.2 * y) + off(random));
        }
    }
    return BezierPatch(net);
}

/// Rows and columns the other way round.
BezierPatch turned(const BezierPatch& patch) {
    const ControlNet& net = patch.net();
    ControlNet result = ControlNet::sized(net.columns, net.rows);
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            result.point(net.columns - 1 - j, i) = net.point(i, j);
        }
    }
    return BezierPatch(result);
}

/// From positions alone, by differences of fourth order; `to_inside` is the way of u.
Vec3 numeric_du(const BezierPatch& patch, double u, double v, double to_inside) {
    const double h = to_inside * 1e-3;
    const auto at = [&](double steps) { return patch.position(u + steps * h, v); };
    return (-25.0 * at(0) + 48.0 * at(1) - 36.0 * at(2) + 16.0 * at(3) - 3.0 * at(4)) / (12.0 * h);
}

TEST(PatchJoin, FindsTheSidesThatBelongTogether) {
    const std::vector patches{wavy(4, 4, {0, 0}, 1.0, 0.05, 1), turned(wavy(4, 4, {10, 0}, 1.0, 0.05, 2))};
    const auto seams = seams_of(patches, 0.5);
    ASSERT_EQ(seams.size(), 1U);
    EXPECT_EQ(seams[0].a, (PatchSide{0, Side::u_end}));
    EXPECT_EQ(seams[0].b, (PatchSide{1, Side::v_start}));
    EXPECT_TRUE(seams[0].reversed);
    EXPECT_LT(figures_of(patches, seams[0]).gap, 0.5);
    EXPECT_TRUE(seams_of(patches, 1e-6).empty());
}

TEST(PatchJoin, ASideThatFacesAnotherAcrossAGapIsAnOpenSeam) {
    // 10 wide and high each; the third one is 1.5 away from the second.
    const std::vector row{wavy(4, 4, {0, 0}, 1.0, 0.0, 1),
                          wavy(4, 4, {10, 0}, 1.0, 0.0, 1),
                          turned(wavy(4, 4, {21.5, 0}, 1.0, 0.0, 1))};
    const auto joined = seams_of(row, 0.5);
    ASSERT_EQ(joined.size(), 1U);
    const auto open = open_seams_of(row, joined);
    ASSERT_EQ(open.size(), 1U);
    EXPECT_EQ(open[0].a, (PatchSide{1, Side::u_end}));
    EXPECT_EQ(open[0].b, (PatchSide{2, Side::v_start}));
    EXPECT_TRUE(open[0].reversed);
    EXPECT_GE(figures_of(row, open[0]).gap, 1.5);
    EXPECT_TRUE(open_seams_of(row, seams_of(row, 3.0)).empty()) << "joined sides are not open";
    EXPECT_EQ(open_seams_of(row, {}).size(), 2U);
}

TEST(PatchJoin, SidesWithMoreThanAGapBetweenThemAreNoOpenSeam) {
    const std::vector far{wavy(4, 4, {0, 0}, 1.0, 0.0, 1), wavy(4, 4, {16, 0}, 1.0, 0.0, 1)};
    EXPECT_TRUE(open_seams_of(far, {}).empty());
    // The outer sides of three narrow strips are nearer to each other than they are long.
    const std::vector strips{
        wavy(4, 4, {0, 0}, 0.1, 0.0, 1), wavy(4, 4, {1, 0}, 0.1, 0.0, 1), wavy(4, 4, {2, 0}, 0.1, 0.0, 1)};
    const auto joined = seams_of(strips, 0.01);
    ASSERT_EQ(joined.size(), 2U);
    EXPECT_TRUE(open_seams_of(strips, joined).empty());
    // One over the other: both go the same way from the sides that are near.
    ControlNet above = far.front().net();
    for (Vec3& point : above.points) {
        point.z() += 2.0;
    }
    EXPECT_TRUE(open_seams_of({far.front(), BezierPatch(above)}, {}).empty());
}

/// Squares of 10 mm in `rows` x `rows` places, `step` from each other, standing up.
std::vector<BezierPatch> tiles(int rows, double step) {
    std::vector<BezierPatch> patches;
    for (int n = 0; n < rows * rows; ++n) {
        ControlNet net = ControlNet::sized(2, 2);
        for (int i = 0; i < 2; ++i) {
            for (int j = 0; j < 2; ++j) {
                net.point(i, j) = {3.0, step * (n / rows) + 10.0 * i, step * (n % rows) + 10.0 * j};
            }
        }
        patches.emplace_back(net);
    }
    return patches;
}

/// Three minutes where every pair of patches is looked at side by side.
TEST(PatchJoin, FindsEverySeamOfThousandsOfPatches) {
    constexpr int rows = 50, count = 2 * rows * (rows - 1);
    const std::vector<BezierPatch> near = tiles(rows, 10.02), far = tiles(rows, 12.0);
    const auto seams = seams_of(near, 0.1);
    EXPECT_EQ(std::ssize(seams), count);
    for (const Seam& seam : seams) {
        const int apart = seam.b.patch - seam.a.patch;
        EXPECT_TRUE(apart == (seam.a.side == Side::u_end ? rows : 1))
            << seam.a.patch << " - " << seam.b.patch;
        EXPECT_FALSE(seam.reversed);
    }
    EXPECT_TRUE(open_seams_of(near, seams).empty());
    EXPECT_TRUE(seams_of(far, 0.1).empty());
    EXPECT_EQ(std::ssize(open_seams_of(far, {})), count);
}

TEST(PatchJoin, TheLastSeamOfARingIsNamedWhereItStaysOpen) {
    std::vector<BezierPatch> ring;
    constexpr int count = 4;
    for (int k = 0; k < count; ++k) { // 3 mm short of a whole turn on a radius of 20
        ControlNet net = ControlNet::sized(4, 2);
        for (int i = 0; i < 4; ++i) {
            const double angle = (k + i / 3.0) / count * (2.0 * 3.141592653589793 - 3.0 / 20.0);
            for (int j = 0; j < 2; ++j) {
                net.point(i, j) = {20.0 * std::cos(angle), 20.0 * std::sin(angle), 15.0 * j};
            }
        }
        ring.emplace_back(net);
    }
    const auto joined = seams_of(ring, 1.0);
    ASSERT_EQ(joined.size(), 3U);
    const auto open = open_seams_of(ring, joined);
    ASSERT_EQ(open.size(), 1U);
    EXPECT_EQ(open[0].a, (PatchSide{0, Side::u_start}));
    EXPECT_EQ(open[0].b, (PatchSide{3, Side::u_end}));
    EXPECT_NEAR(figures_of(ring, open[0]).gap, 3.0, 0.01);
}

TEST(PatchJoin, TangentsAcrossTheSeamAreOneByDifferences) {
    const std::vector patches{wavy(4, 4, {0, 0}, 1.0, 0.4, 3), wavy(5, 6, {10, 0}, 0.7, 0.4, 4)};
    const auto seams = seams_of(patches, 2.0);
    ASSERT_EQ(seams.size(), 1U);
    EXPECT_GT(figures_of(patches, seams[0]).angle, 0.02);
    const Joined made = joined(patches, seams, Continuity::tangent);
    EXPECT_EQ(made.patches[0].degree_v(), 5) << "as its neighbour";
    double ratio = 0.0;
    for (double v = 0.0; v <= 1.0; v += 0.1) {
        EXPECT_NEAR((made.patches[0].position(1.0, v) - made.patches[1].position(0.0, v)).norm(), 0.0, 1e-11);
        const Vec3 out = numeric_du(made.patches[0], 1.0, v, -1.0);
        const Vec3 in = numeric_du(made.patches[1], 0.0, v, 1.0);
        EXPECT_NEAR(out.cross(in).norm() / (out.norm() * in.norm()), 0.0, 1e-8);
        EXPECT_GT(out.dot(in), 0.0);
        const double here = in.norm() / out.norm();
        EXPECT_NEAR(here, ratio > 0.0 ? ratio : here, 1e-7) << "the same along the whole seam";
        ratio = here;
    }
    EXPECT_GT(made.largest_move, 0.0);
    EXPECT_LT(made.largest_move, 1.5);
    EXPECT_NEAR(figures_of(made.patches, seams[0]).angle, 0.0, 1e-7);
}

TEST(PatchJoin, InPositionMovesOnlyTheEdgeRowsAndThoseHalfWay) {
    const std::vector patches{wavy(4, 4, {0, 0}, 1.0, 0.3, 5), wavy(4, 4, {10, 0}, 1.0, 0.3, 6)};
    const auto seams = seams_of(patches, 2.0);
    ASSERT_EQ(seams.size(), 1U);
    const Joined made = joined(patches, seams, Continuity::position);
    for (int j = 0; j < 4; ++j) {
        const Vec3 middle = 0.5 * (patches[0].net().point(3, j) + patches[1].net().point(0, j));
        EXPECT_NEAR((made.patches[0].net().point(3, j) - middle).norm(), 0.0, 1e-12);
        EXPECT_NEAR((made.patches[1].net().point(0, j) - middle).norm(), 0.0, 1e-12);
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(made.patches[0].net().point(i, j), patches[0].net().point(i, j));
        }
    }
}

/// Any other movement that fulfils the conditions is longer: the least one is square to all of those.
TEST(PatchJoin, NoOtherMovementIsShorter) {
    const std::vector patches{wavy(4, 3, {0, 0}, 1.0, 0.4, 7), wavy(4, 3, {10, 0}, 1.0, 0.4, 8)};
    const auto seams = seams_of(patches, 2.0);
    const Joined made = joined(patches, seams, Continuity::tangent);
    const auto sum_of_moves = [&](const std::vector<BezierPatch>& to) {
        double sum = 0.0;
        for (std::size_t n = 0; n < 2; ++n) {
            for (std::size_t k = 0; k < to[n].net().points.size(); ++k) {
                sum += (to[n].net().points[k] - patches[n].net().points[k]).squaredNorm();
            }
        }
        return sum;
    };
    const double least = sum_of_moves(made.patches);
    const Vec3 out = 3.0 * (made.patches[0].net().point(3, 1) - made.patches[0].net().point(2, 1));
    const Vec3 in = 3.0 * (made.patches[1].net().point(1, 1) - made.patches[1].net().point(0, 1));
    const double ratio = in.norm() / out.norm();
    for (const Vec3& by : {Vec3(0.01, 0, 0), Vec3(0, -0.01, 0), Vec3(0, 0, 0.01)}) {
        ControlNet a = made.patches[0].net();
        ControlNet b = made.patches[1].net();
        a.point(3, 1) += by; // still in line: what follows from the edge moves with it
        b.point(0, 1) += by;
        b.point(1, 1) += (1.0 + ratio) * by;
        EXPECT_GT(sum_of_moves({BezierPatch(a), BezierPatch(b)}), least);
    }
}

TEST(PatchJoin, FourPatchesMeetSmoothlyAtTheirCorner) {
    const std::vector patches{wavy(4, 4, {0, 0}, 1.0, 0.2, 11),
                              wavy(4, 4, {10, 0}, 1.4, 0.2, 12),
                              wavy(4, 4, {0, 10}, 1.0, 0.2, 13),
                              wavy(4, 4, {10, 10}, 1.4, 0.2, 14)};
    const auto seams = seams_of(patches, 1.5);
    ASSERT_EQ(seams.size(), 4U);
    const Joined made = joined(patches, seams, Continuity::tangent);
    EXPECT_LT(made.largest_move, 1.0) << "the net does not collapse at the corner";
    for (const Seam& seam : seams) {
        EXPECT_NEAR(figures_of(made.patches, seam).gap, 0.0, 1e-10);
        EXPECT_NEAR(figures_of(made.patches, seam).angle, 0.0, 1e-7);
    }
}

TEST(PatchJoin, RefusesWhatCannotBeJoined) {
    const BezierPatch flat = wavy(4, 4, {0, 0}, 1.0, 0.0, 1);
    ControlNet back = flat.net();
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            back.point(i, j).x() = flat.net().point(3 - i, j).x(); // lies on the first one
            back.point(i, j).z() = flat.net().point(3 - i, j).z();
        }
    }
    const std::vector folded{flat, BezierPatch(back)};
    const Seam seam{{0, Side::u_end}, {1, Side::u_start}, false};
    EXPECT_THROW((void)joined(folded, {seam}, Continuity::tangent), Error);
    ControlNet weighted = flat.net();
    weighted.weight(1, 1) = 2.0;
    EXPECT_THROW((void)joined({flat, BezierPatch(weighted)}, {seam}, Continuity::position), Error);
}

} // namespace
} // namespace millwright::geometry
