#include "core/geometry/self_crossing.h"

#include "core/geometry/presets.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace millwright::geometry {
namespace {

/// A cubic curve of X and Z, drawn out straight by 120 mm along Y.
BezierPatch drawn_out(const std::array<Vec2, 4>& curve) {
    ControlNet net = ControlNet::sized(4, 4);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const Vec2& p = curve[static_cast<std::size_t>(i)];
            net.point(i, j) = {p.x(), 40.0 * j, p.y()};
        }
    }
    return BezierPatch(net);
}

TEST(SelfCrossing, IsNotInTheShapesToBeginWith) {
    for (const SurfacePreset& preset : surface_presets()) {
        const Surface surface = preset.make();
        EXPECT_FALSE(self_crossing(surface.patch(PatchId{0}))) << preset.id;
    }
}

// x of the curve is 50 at u = 0.5 -+ d with 420 d^2 = 15: there its two arms meet, at one height.
TEST(SelfCrossing, OfALoopIsWhereItsArmsMeet) {
    const BezierPatch loop =
        drawn_out({Vec2(0.0, 0.0), Vec2(120.0, 100.0), Vec2(-20.0, 100.0), Vec2(100.0, 0.0)});
    const auto found = self_crossing(loop);
    ASSERT_TRUE(found);
    constexpr double cell = 1.0 / 24.0;
    const Vec3 at = loop.position(found->first.x(), found->first.y());
    const Vec3 other = loop.position(found->second.x(), found->second.y());
    EXPECT_LT((at - other).norm(), 3.0 * 120.0 * cell);
    EXPECT_GT(std::abs(found->first.x() - found->second.x()), 4.0 * cell);
    EXPECT_NEAR(found->first.x() + found->second.x(), 1.0, 3.0 * cell);
}

TEST(SelfCrossing, OfAFoldThatLiesOnItselfIsTold) {
    EXPECT_TRUE(self_crossing(drawn_out({Vec2(0.0, 0.0), Vec2(80.0, 0.0), Vec2(80.0, 0.0), Vec2(0.0, 0.0)})));
}

TEST(SelfCrossing, IsNotWhereSidesAloneTouch) {
    EXPECT_FALSE(
        self_crossing(drawn_out({Vec2(0.0, 0.0), Vec2(100.0, 100.0), Vec2(-100.0, 100.0), Vec2(0.0, 0.0)})))
        << "a tube";
    ControlNet pole = surface_preset("dome").make().patch(PatchId{0}).net();
    for (int j = 0; j < pole.columns; ++j) {
        pole.point(0, j) = pole.point(0, 0);
    }
    EXPECT_FALSE(self_crossing(BezierPatch(pole))) << "a pole";
}

TEST(SelfCrossing, IsNotSoughtWhereThePatchShrinksToALine) {
    ControlNet line = ControlNet::sized(4, 4);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            line.point(i, j) = {10.0 * i, 0.0, 0.0};
        }
    }
    EXPECT_FALSE(self_crossing(BezierPatch(line)));
    line.points.assign(line.points.size(), Vec3(1.0, 2.0, 3.0));
    EXPECT_FALSE(self_crossing(BezierPatch(line))) << "a point";
}

} // namespace
} // namespace millwright::geometry
