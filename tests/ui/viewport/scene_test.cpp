#include "ui/viewport/scene.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"
#include "tests/ui/viewport/scenes.h"
#include "ui/render/convert.h"

#include <gtest/gtest.h>

namespace millwright::viewport {
namespace {

TEST(ViewKinds, AreFoundByTheirIds) {
    for (int k = 0; k < view_kind_count; ++k) {
        const auto kind = static_cast<ViewKind>(k);
        EXPECT_EQ(view_kind(id(kind)), kind);
        EXPECT_FALSE(title(kind).empty());
    }
    EXPECT_FALSE(view_kind("Design"));
    EXPECT_FALSE(view_kind(""));
}

TEST(Scenes, AreEqualUntilSomethingThatIsSeenChanges) {
    const Scene scene = test::scene_of(test::dome, ViewKind::error);
    Scene other = scene;
    EXPECT_TRUE(scene == other);
    other.now = test::half_way(scene);
    EXPECT_FALSE(scene == other);
    Scene later = other;
    later.now->fraction = 0.5;
    EXPECT_FALSE(other == later);
    other = scene;
    other.selected = {{.i = 1, .j = 1}};
    EXPECT_FALSE(scene == other);
    other = scene;
    other.surface = std::make_shared<const geometry::Surface>(*scene.surface);
    EXPECT_FALSE(scene == other); // the same values, but another result
}

TEST(SceneFrame, IsTheWorkpiecesUnlessTheMachineIsShown) {
    Scene scene = test::scene_of(test::dome, ViewKind::error);
    EXPECT_TRUE(scene_from_workpiece(scene).isApprox(Frame::Identity()));
    scene.layers.machine.bodies = true;
    scene.now = test::half_way(scene);
    const Frame expected = kinematics::m_T_w(scene.cutting_setup->machine, scene.now->axes);
    EXPECT_TRUE(scene_from_workpiece(scene).isApprox(expected));
    scene.cutting_setup = nullptr;
    EXPECT_TRUE(scene_from_workpiece(scene).isApprox(Frame::Identity()));
}

TEST(PathView, ShowsAPlaceOnThePartWhereTheMachineHasBroughtIt) {
    Scene scene = test::scene_of(test::dome, ViewKind::machine);
    scene.now = test::half_way(scene);
    render::View view;
    view.view[3] = {0.0, 0.0, -500.0, 1.0};
    view.size = {640, 480};
    const Vec3 on_part(3.0, -4.0, 5.0);
    const Vec3 in_scene = kinematics::m_T_w(scene.cutting_setup->machine, scene.now->axes) * on_part;
    const auto expected = render::project(view, render::to_glm(in_scene));
    const auto found = render::project(path_view(view, scene), render::to_glm(on_part));
    ASSERT_TRUE(expected && found);
    EXPECT_NEAR(found->pixel.x, expected->pixel.x, 1e-9);
    EXPECT_NEAR(found->pixel.y, expected->pixel.y, 1e-9);
}

TEST(SceneAxes, StandAtTheStartOfThePathBeforeAnyMotion) {
    Scene scene = test::scene_of(test::dome, ViewKind::machine);
    EXPECT_EQ(axes_now(scene), scene.shown->axes.positions.front());
    scene.now = test::half_way(scene);
    EXPECT_EQ(axes_now(scene), scene.now->axes);
    scene.now.reset();
    scene.shown = nullptr;
    EXPECT_EQ(axes_now(scene).norm(), 0.0);
    EXPECT_EQ(axes_now(Scene{}).size(), 0);
}

TEST(ErrorColors, EndAtARoundNumberAboveTwiceTheMean) {
    const Scene scene = test::scene_of(test::dome, ViewKind::error);
    const double high = error_colors(scene, {}).high;
    EXPECT_GE(high, 2.0 * scene.shown->closest.mean);
    EXPECT_LE(high, 2.5 * 2.0 * scene.shown->closest.mean);
}

TEST(ErrorColors, EndAtTheToleranceWhereThereIsOne) {
    Scene scene = test::scene_of(test::dome, ViewKind::error);
    scene.error.high = 3.0;
    EXPECT_DOUBLE_EQ(error_colors(scene, {}).high, 3.0);
    EXPECT_FALSE(error_colors(scene, {}).limit);
    scene.error.limit = 0.05;
    EXPECT_DOUBLE_EQ(error_colors(scene, {}).high, 0.05);
    EXPECT_DOUBLE_EQ(error_colors(scene, {}).limit.value(), 0.05);
}

TEST(WeightColors, GoFromTheLeastToTheLargestInAnotherMapThanTheErrors) {
    Scene scene;
    scene.weight = std::make_shared<const plan::WeightMap>(
        plan::WeightMap{.rows = 2, .columns = 2, .values = {-1.0, 0.0, 0.0, 4.0}, .low = -1.0, .high = 4.0});
    const render::ColorScale scale = weight_colors(scene);
    EXPECT_DOUBLE_EQ(scale.low, -1.0);
    EXPECT_DOUBLE_EQ(scale.high, 4.0);
    EXPECT_FALSE(scale.limit);
    EXPECT_NE(scale.map, error_colors(scene, {}).map);
    EXPECT_THROW((void)weight_colors(Scene{}), Defect);
}

TEST(WeightColors, OfAConstantWeightHaveARangeForTheLegend) {
    Scene scene;
    scene.weight = std::make_shared<const plan::WeightMap>(
        plan::WeightMap{.rows = 2, .columns = 2, .values = {2.0, 2.0, 2.0, 2.0}, .low = 2.0, .high = 2.0});
    EXPECT_GT(weight_colors(scene).high, weight_colors(scene).low);
}

} // namespace
} // namespace millwright::viewport
