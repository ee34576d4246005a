#include "ui/viewport/picking.h"

#include "tests/ui/viewport/scenes.h"
#include "tests/ui/viewport/views.h"
#include "ui/render/camera.h"
#include "ui/render/convert.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace millwright::viewport {
namespace {

using test::pixel_of;
using test::view_size;

/// A plane sheet z = 0 over [0, 100] x [0, 100], as a patch of degree 3 with u along x.
std::shared_ptr<const geometry::Surface> sheet() {
    geometry::ControlNet net = geometry::ControlNet::sized(4, 4);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            net.point(i, j) = Vec3(i, j, 0.0) * (100.0 / 3.0);
        }
    }
    return std::make_shared<const geometry::Surface>(
        std::vector<geometry::BezierPatch>{geometry::BezierPatch(net)});
}

render::View part_from_above() {
    return render::Camera({.target = {50.0, 50.0, 0.0}, .distance = 300.0})
        .seen_from(render::StandardView::top)
        .view(view_size, {.min = glm::dvec3(-50.0), .max = glm::dvec3(150.0)});
}

TEST(PickControlPoint, FindsTheHandleWithinReachOnly) {
    const auto surface = sheet();
    const render::View view = part_from_above();
    const Vec3 point = surface->patch(geometry::PatchId{0}).net().point(2, 1);
    const glm::dvec2 pixel = pixel_of(view, point);
    const Frame here = Frame::Identity();
    const auto near = pick_control_point(*surface, here, view, pixel + glm::dvec2(5.0, 0.0), 9.0);
    ASSERT_TRUE(near);
    EXPECT_EQ(*near, (ControlPointId{.i = 2, .j = 1}));
    EXPECT_FALSE(pick_control_point(*surface, here, view, pixel + glm::dvec2(9.5, 0.0), 9.0));
}

TEST(PickControlPoint, TakesTheNearerOfTwoHandlesInOneLineOfSight) {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    net.point(0, 0) = {0.0, 0.0, 10.0};
    net.point(0, 1) = {0.0, 0.0, 40.0};
    net.point(1, 0) = {50.0, 0.0, 0.0};
    net.point(1, 1) = {50.0, 50.0, 0.0};
    const geometry::Surface surface({geometry::BezierPatch(net)});
    const render::View view =
        render::Camera({.distance = 300.0, .projection = render::Projection::orthographic})
            .seen_from(render::StandardView::top)
            .view(view_size, {.min = glm::dvec3(-50.0), .max = glm::dvec3(50.0)});
    const auto found =
        pick_control_point(surface, Frame::Identity(), view, pixel_of(view, net.point(0, 0)), 9.0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->j, 1);
}

TEST(ControlPointsIn, FindsThoseInsideWhicheverCornersAreGiven) {
    const auto surface = sheet();
    const render::View view = part_from_above();
    const geometry::ControlNet& net = surface->patch(geometry::PatchId{0}).net();
    const glm::dvec2 a = pixel_of(view, net.point(0, 0)) + glm::dvec2(-3.0, 3.0);
    const glm::dvec2 b = pixel_of(view, net.point(1, 2)) + glm::dvec2(3.0, -3.0);
    const auto found = control_points_in(*surface, Frame::Identity(), view, a, b);
    ASSERT_EQ(found.size(), 6U);
    EXPECT_EQ(found, control_points_in(*surface, Frame::Identity(), view, b, a));
    EXPECT_EQ(found.front(), (ControlPointId{.i = 0, .j = 0}));
    EXPECT_EQ(found.back(), (ControlPointId{.i = 1, .j = 2}));
}

TEST(SurfacePicker, FindsThePlaceAndItsParameters) {
    SurfacePicker picker;
    picker.follow(sheet());
    const render::View view = part_from_above();
    const Vec3 place(37.0, 81.0, 0.0);
    const auto hit = picker.hit(render::ray(view, pixel_of(view, place)), Frame::Identity());
    ASSERT_TRUE(hit);
    EXPECT_LT((hit->position - place).norm(), 1e-6);
    EXPECT_NEAR(hit->uv.x(), 0.37, 1e-8);
    EXPECT_NEAR(hit->uv.y(), 0.81, 1e-8);
}

TEST(SurfacePicker, MeetsAMovedSurfaceWhereItIs) {
    SurfacePicker picker;
    picker.follow(sheet());
    Frame s_T_w = Frame::Identity();
    s_T_w.translation() = Vec3(0.0, 0.0, 25.0);
    const render::View view = part_from_above();
    const Vec3 place_w(20.0, 30.0, 0.0);
    const auto hit = picker.hit(render::ray(view, pixel_of(view, s_T_w * place_w)), s_T_w);
    ASSERT_TRUE(hit);
    EXPECT_LT((hit->position - place_w).norm(), 1e-6);
}

TEST(SurfacePicker, MeetsEveryPlaceFromEverySide) {
    SurfacePicker picker;
    picker.follow(sheet());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> along(0.5, 99.5);
    std::uniform_real_distribution<double> tilt(-1.0, 1.0);
    for (int n = 0; n < 500; ++n) {
        const Vec3 place(along(random), along(random), 0.0);
        // Every fifth runs within a plane of two axes: such a direction has a zero.
        const Vec3 direction = Vec3(tilt(random), n % 5 == 0 ? 0.0 : tilt(random), -1.0).normalized();
        const Vec3 origin = place - 300.0 * direction;
        const auto hit = picker.hit(
            {.origin = render::to_glm(origin), .direction = render::to_glm(direction)}, Frame::Identity());
        ASSERT_TRUE(hit) << place.transpose() << " along " << direction.transpose();
        EXPECT_LT((hit->position - place).norm(), 1e-6);
        EXPECT_NEAR(hit->distance, 300.0, 1e-6);
    }
}

TEST(SurfacePicker, MeetsNothingBesideTheSurfaceOrWithoutOne) {
    SurfacePicker picker;
    const render::View view = part_from_above();
    const render::Ray through = render::ray(view, pixel_of(view, {50.0, 50.0, 0.0}));
    EXPECT_FALSE(picker.hit(through, Frame::Identity()));
    picker.follow(sheet());
    EXPECT_TRUE(picker.hit(through, Frame::Identity()));
    EXPECT_FALSE(picker.hit(render::ray(view, pixel_of(view, {103.0, 50.0, 0.0})), Frame::Identity()));
    picker.follow(nullptr);
    EXPECT_FALSE(picker.hit(through, Frame::Identity()));
}

/// Two triangles over the sheet's corner at different heights, of the faces 3 and 7.
plan::ReferenceMesh two_faces() {
    plan::ReferenceMesh reference;
    reference.rest.points = {{0, 0, 10}, {60, 0, 10}, {0, 60, 10}, {0, 0, 30}, {30, 0, 30}, {0, 30, 30}};
    reference.rest.triangles = {{0, 1, 2}, {3, 4, 5}};
    reference.faces = {3, 7};
    return reference;
}

TEST(PickFace, FindsTheNearestAndNoneBehindTheSurfaceOrBeside) {
    const render::View view = part_from_above();
    const Frame here = Frame::Identity();
    constexpr double any = std::numeric_limits<double>::infinity();
    const auto at = [&](const Vec3& place, double farthest) {
        return pick_face(two_faces(), render::ray(view, pixel_of(view, place)), here, farthest);
    };
    EXPECT_EQ(at({10.0, 10.0, 30.0}, any), 7);
    EXPECT_EQ(at({35.0, 15.0, 10.0}, any), 3);
    EXPECT_EQ(at({80.0, 80.0, 10.0}, any), std::nullopt);
    EXPECT_EQ(at({10.0, 10.0, 30.0}, 100.0), std::nullopt) << "a surface lies before it";
    Frame moved = Frame::Identity();
    moved.translation() = Vec3(40.0, 40.0, 0.0);
    EXPECT_EQ(pick_face(two_faces(), render::ray(view, pixel_of(view, {50.0, 50.0, 30.0})), moved, any), 7);
    plan::ReferenceMesh mesh = two_faces();
    mesh.faces.clear();
    EXPECT_EQ(pick_face(mesh, render::ray(view, pixel_of(view, {10.0, 10.0, 30.0})), here, any),
              std::nullopt);
}

TEST(PickMove, FindsEachMoveAtItsMiddle) {
    const Scene scene = test::scene_of(test::two_bell, ViewKind::toolpath);
    const render::View view =
        render::Camera()
            .seen_from(render::StandardView::top)
            .fitted(render::to_glm(scene.surface->control_box()), render::aspect(view_size))
            .view(view_size, render::to_glm(scene.surface->control_box()));
    const auto& points = scene.shown->toolpath.points;
    for (const std::size_t move : {0U, 17U, 64U, 130U}) {
        const Vec2 uv = 0.5 * (points[move].origin.uv + points[move + 1].origin.uv);
        const Vec3 middle = scene.cutting_setup->patch.position(uv.x(), uv.y());
        const auto hit = pick_move(scene, view, pixel_of(view, middle), 4.0, std::nullopt, 0.0);
        ASSERT_TRUE(hit) << move;
        EXPECT_EQ(hit->move, static_cast<int>(move));
        EXPECT_NEAR(hit->fraction, 0.5, 0.02);
    }
}

TEST(PickMove, FindsNothingBehindTheSurface) {
    const Scene scene = test::scene_of(test::two_bell, ViewKind::toolpath);
    const render::Bounds box = render::to_glm(scene.surface->control_box());
    const render::View view = render::Camera()
                                  .seen_from(render::StandardView::top)
                                  .fitted(box, render::aspect(view_size))
                                  .view(view_size, box);
    const Vec3 tip = scene.shown->toolpath.points[30].pose.tip;
    const glm::dvec2 pixel = pixel_of(view, tip);
    const render::Ray sight = render::ray(view, pixel);
    const double away = (tip - render::to_core(sight.origin)).norm();
    EXPECT_TRUE(pick_move(scene, view, pixel, 4.0, away, 1.0));
    EXPECT_FALSE(pick_move(scene, view, pixel, 4.0, away - 10.0, 1.0));
}

TEST(PickMove, FindsNothingWhereNoPathIsShown) {
    Scene scene = test::scene_of(test::two_bell, ViewKind::design);
    const render::View view = part_from_above();
    const glm::dvec2 pixel = pixel_of(view, scene.shown->toolpath.points[3].pose.tip);
    EXPECT_FALSE(pick_move(scene, view, pixel, 400.0, std::nullopt, 0.0));
    scene.layers.path.intended = true;
    EXPECT_TRUE(pick_move(scene, view, pixel, 400.0, std::nullopt, 0.0));
}

} // namespace
} // namespace millwright::viewport
