#include "ui/viewport/machine_sight.h"

#include "tests/ui/viewport/scenes.h"
#include "ui/render/convert.h"

#include <gtest/gtest.h>

namespace millwright::viewport {
namespace {

Scene machine_scene(const test::Part& part) {
    Scene scene = test::scene_of(part, ViewKind::machine);
    scene.now = test::half_way(scene);
    return scene;
}

TEST(PartSeen, IsNothingFromBelowTheTable) {
    Scene scene = machine_scene(test::two_bell);
    scene.now->axes.setZero(); // the table lies level
    EXPECT_EQ(part_seen(scene, -Vec3::UnitZ()), 0.0);
    EXPECT_GT(part_seen(scene, Vec3(0.0, -0.6, 0.8)), 0.3);
}

TEST(PartInSight, SeesNearlyAsMuchAsFromAnywhere) {
    for (const auto& part : {test::dome, test::two_bell}) {
        const Scene scene = machine_scene(part);
        const render::Camera camera;
        const double seen = part_seen(scene, render::to_core(part_in_sight(scene, camera).backward()));
        EXPECT_GT(seen, 0.0);
        for (int k = 0; k < 12; ++k) {
            const Vec3 to_eye = render::to_core(camera.orbited(k * 0.5236, 0.0).backward());
            EXPECT_GE(seen, 0.79 * part_seen(scene, to_eye)) << part.preset << k;
        }
    }
}

TEST(PartInSight, TurnsAboutTheVerticalOnly) {
    const Scene scene = machine_scene(test::dome);
    const render::Camera camera;
    const render::CameraPose turned = part_in_sight(scene, camera).pose();
    EXPECT_DOUBLE_EQ(turned.pitch, camera.pose().pitch);
    EXPECT_DOUBLE_EQ(turned.distance, camera.pose().distance);
}

} // namespace
} // namespace millwright::viewport
