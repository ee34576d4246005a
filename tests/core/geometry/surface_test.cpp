#include "core/geometry/surface.h"

#include "core/base/error.h"
#include "core/geometry/presets.h"

#include <gtest/gtest.h>

namespace millwright::geometry {
namespace {

BezierPatch lifted(const BezierPatch& patch, double z) {
    ControlNet net = patch.net();
    for (Vec3& point : net.points) {
        point.z() += z;
    }
    return BezierPatch(net);
}

TEST(Surface, HoldsSeveralPatchesAndTheirCommonBox) {
    const BezierPatch dome = surface_preset("dome").make().patch(PatchId{0});
    const Surface surface({dome, lifted(dome, 100.0)});
    EXPECT_EQ(surface.patch_count(), 2);
    EXPECT_DOUBLE_EQ(surface.control_box().max().z(), 190.0);
    EXPECT_DOUBLE_EQ(surface.control_box().min().z(), 1.0);
    EXPECT_THROW((void)surface.patch(PatchId{2}), Defect);
}

TEST(Surface, EditingOnePatchLeavesTheOriginalAndTheOthers) {
    const BezierPatch dome = surface_preset("dome").make().patch(PatchId{0});
    const Surface before({dome, dome});
    const Surface after = before.with_patch(PatchId{1}, lifted(dome, 1.0));
    EXPECT_EQ(after.patch(PatchId{0}), dome);
    EXPECT_NE(after, before);
    EXPECT_EQ(before.patch(PatchId{1}), dome);
}

TEST(Surface, NeedsAPatch) {
    EXPECT_THROW(Surface(std::vector<BezierPatch>{}), Error);
}

} // namespace
} // namespace millwright::geometry
