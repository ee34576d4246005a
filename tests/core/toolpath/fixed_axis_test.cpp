#include "core/base/error.h"
#include "core/geometry/presets.h"
#include "core/toolpath/kinematic_error.h"
#include "core/toolpath/tool_poses.h"
#include "tests/support/machines.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace millwright::toolpath {
namespace {

const Vec3 slope = Vec3(1, 0, 2).normalized();

TEST(FixedAxis, LeavesThePosesOfAMachineThatTurns) {
    const auto pose = pose_on(test::machine("ac-table"), {Vec3(1, 2, 3), slope});
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->axis, slope);
}

TEST(FixedAxis, KeepsTheToolUprightAndTheTipInItsPlace) {
    const auto pose = pose_on(test::machine("router-xyz"), {Vec3(1, 2, 3), slope});
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->axis, Vec3::UnitZ());
    EXPECT_EQ(pose->tip, Vec3(1, 2, 3));
}

TEST(FixedAxis, RefusesAnUndercutWithItsNode) {
    EXPECT_FALSE(pose_on(test::machine("router-xyz"), {Vec3::Zero(), -slope}));
    Toolpath path;
    path.points.push_back({{Vec3::Zero(), -slope}, MoveKind::start, {2, 3, Vec2::Zero()}});
    try {
        (void)on_machine(test::machine("router-xyz"), path);
        FAIL() << "an undercut";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("node 2,3"), std::string::npos) << error.what();
    }
}

/// On a machine that goes straight, the error of a move is that of a chord of its curve.
TEST(FixedAxis, MakesTheErrorOfAMoveThatOfItsChord) {
    const geometry::Surface surface = geometry::surface_preset("dome").make();
    const geometry::BezierPatch& patch = surface.patch(geometry::PatchId{0});
    const KinematicError error(patch, test::machine("router-xyz"), false);
    const Vec2 a(0.3, 0.2);
    const Vec2 b(0.3, 0.4);
    const grid::MoveError found = error.move(a, b, grid::fine);
    const Vec3 begin = patch.position(a.x(), a.y());
    const Vec3 way = patch.position(b.x(), b.y()) - begin;
    double chord = 0.0;
    for (int k = 0; k <= 2000; ++k) {
        const Vec2 uv = a + k / 2000.0 * (b - a);
        const Vec3 off = patch.position(uv.x(), uv.y()) - begin;
        chord = std::max(chord, (off - off.dot(way) / way.squaredNorm() * way).norm());
    }
    EXPECT_GT(chord, 0.01);
    EXPECT_NEAR(found.tip, chord, 0.02 * chord);
}

} // namespace
} // namespace millwright::toolpath
