#include "ui/viewport/viewport.h"

#include "tests/ui/viewport/scenes.h"
#include "tests/ui/viewport/window.h"
#include "ui/render/convert.h"

#include <glm/geometric.hpp>

namespace millwright::viewport {
namespace {

using Stage = DragStage;

class ViewportTest : public test::Window {
protected:
    ViewportTest() { input.seconds = 1.0F / 60.0F; }

    void show(ViewKind kind, const test::Part& part = test::dome) {
        scene = test::scene_of(part, kind);
        frame();
        frame();
    }

    void move_to(const widgets::Point& at) { move(at.x, at.y); }

    [[nodiscard]] Vec3 point(int i, int j) const {
        return scene.surface->patch(geometry::PatchId{0}).net().point(i, j);
    }
};

TEST_F(ViewportTest, FitsItsContentAtFirst) {
    show(ViewKind::design);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const widgets::Point at =
                handle("control_point(" + std::to_string(i) + "," + std::to_string(j) + ")");
            EXPECT_TRUE(at.x > 0.0F && at.x < 640.0F && at.y > 0.0F && at.y < 480.0F) << i << j;
        }
    }
}

// The words of a gouge covered those of the singular point where the tool gouges.
TEST_F(ViewportTest, LabelsOfOnePlaceDoNotCoverEachOther) {
    show(ViewKind::design, test::two_bell);
    ASSERT_FALSE(scene.singular_points.empty());
    scene.layers = {.path = {.gouges = true}, .machine = {.singular_points = true}, .origin = false};
    scene.singular_points.resize(1);
    const Vec3 place = scene.singular_points.front().position;
    plan::CutStudy study;
    for (const bool by_holder : {false, true}) {
        study.bites.push_back({7, 9, by_holder, {.depth = 0.25, .uv = {0.5, 0.5}, .position = place}});
    }
    scene.cut = std::make_shared<const plan::CutStudy>(study);
    frame();
    std::vector<widgets::Rect> words;
    for (int n = 0; n < 3; ++n) {
        const auto at = ui().place("view/label_" + std::to_string(n));
        ASSERT_TRUE(at) << n;
        for (const widgets::Rect& other : words) {
            EXPECT_TRUE(at->y >= other.bottom() || at->bottom() <= other.y) << n;
        }
        words.push_back(*at);
    }
    test::keep(picture(), "labels-of-one-place");
    for (const bool in_sight : {true, false}) { // what is beside the picture has no words at its border
        render::CameraPose pose = viewport().camera().pose();
        pose.target = render::to_glm(place) + glm::dvec3(in_sight ? 0.0 : pose.distance, 0.0, 0.0);
        viewport().set_camera(render::Camera(pose));
        frame();
        EXPECT_EQ(ui().place("view/label_0").has_value(), in_sight);
    }
}

gcode::PreviewPath line(const Vec3& from, const Vec3& to) {
    gcode::PathChunker chunker;
    chunker.add({from, 0, gcode::PathKind::start}, 0.0);
    chunker.add({to, 0, gcode::PathKind::feed}, 0.0);
    return {{chunker.take_rest()}};
}

// The program of a plot that was moved is still where the plot was: for as long as the new one was made the
// view was fitted to both, and stayed so.
TEST_F(ViewportTest, FitsAPlotAndNotTheProgramThatIsPlayedOfIt) {
    auto plot = std::make_shared<plan::PlotResult>();
    plot->cuts.push_back({1, {}, line({400, 0, 0}, {500, 80, 0})});
    scene.plot = plot;
    frame();
    const render::CameraPose alone = viewport().camera().pose();
    auto program = std::make_shared<plan::OpenedProgram>();
    program->path = line({0, 0, 0}, {100, 80, 0});
    scene.opened = program;
    viewport().fit();
    frame();
    EXPECT_EQ(viewport().camera().pose(), alone);
    scene.plot.reset();
    viewport().fit();
    frame();
    EXPECT_LT(viewport().camera().pose().target.x, 100.0);
}

TEST_F(ViewportTest, SelectsTheControlPointThatIsClicked) {
    show(ViewKind::design);
    const widgets::Point at = handle("control_point(1,2)");
    click(at.x, at.y);
    const auto chosen = all<SelectControlPoints>();
    ASSERT_EQ(chosen.size(), 1U);
    EXPECT_EQ(chosen.front().points, (std::vector<ControlPointId>{{.i = 1, .j = 2}}));
    EXPECT_TRUE(all<MoveControlPoints>().empty());
}

TEST_F(ViewportTest, AddsAndTakesAwayWithCtrl) {
    show(ViewKind::design);
    scene.selected = {{.i = 1, .j = 1}, {.i = 1, .j = 2}};
    input.ctrl = true;
    widgets::Point at = handle("control_point(2,2)");
    click(at.x, at.y);
    at = handle("control_point(1,2)");
    click(at.x, at.y);
    const auto chosen = all<SelectControlPoints>();
    ASSERT_EQ(chosen.size(), 2U);
    EXPECT_EQ(chosen[0].points,
              (std::vector<ControlPointId>{{.i = 1, .j = 1}, {.i = 1, .j = 2}, {.i = 2, .j = 2}}));
    EXPECT_EQ(chosen[1].points, (std::vector<ControlPointId>{{.i = 1, .j = 1}}));
}

TEST_F(ViewportTest, ClearsTheSelectionByAClickOnNothing) {
    show(ViewKind::design);
    scene.selected = {{.i = 1, .j = 1}};
    click(20.0F, 60.0F);
    ASSERT_EQ(all<SelectControlPoints>().size(), 1U);
    EXPECT_TRUE(all<SelectControlPoints>().front().points.empty());
}

TEST_F(ViewportTest, DragsAControlPointInTheScreenPlane) {
    show(ViewKind::design);
    const widgets::Point at = handle("control_point(1,1)");
    move_to(at);
    press();
    input.mouse_x += 60.0F;
    input.mouse_y += 25.0F;
    frame();
    EXPECT_TRUE(viewport().dragging());
    release();
    EXPECT_FALSE(viewport().dragging());
    const auto moves = all<MoveControlPoints>();
    ASSERT_EQ(moves.size(), 2U);
    EXPECT_EQ(moves.front().stage, Stage::going_on);
    EXPECT_EQ(moves.back().stage, Stage::finished);
    const render::Camera& camera = viewport().camera();
    const render::View view = camera.view(size(), {});
    const double pixel = render::pixel_length(view, render::to_glm(point(1, 1)));
    const Vec3 expected =
        point(1, 1) + pixel * (60.0 * render::to_core(camera.right()) - 25.0 * render::to_core(camera.up()));
    EXPECT_LT((moves.back().points.front().position - expected).norm(), 1e-6);
    EXPECT_LT((moves.front().points.front().position - expected).norm(), 1e-6);
}

TEST_F(ViewportTest, DragsAlongAnAxisWhileItsKeyIsHeld) {
    show(ViewKind::design);
    const widgets::Point at = handle("control_point(1,1)");
    move_to(at);
    press();
    input.keys = {render::Key::z};
    input.mouse_y -= 40.0F;
    frame();
    release();
    const Vec3 moved = all<MoveControlPoints>().back().points.front().position - point(1, 1);
    EXPECT_GT(moved.z(), 1.0);
    EXPECT_LT(moved.head<2>().norm(), 1e-9);
}

TEST_F(ViewportTest, DragsAllThatIsSelected) {
    show(ViewKind::design);
    scene.selected = {{.i = 1, .j = 1}, {.i = 2, .j = 2}};
    const widgets::Point at = handle("control_point(1,1)");
    move_to(at);
    press();
    input.mouse_x += 30.0F;
    frame();
    release();
    const auto moves = all<MoveControlPoints>();
    ASSERT_EQ(moves.back().points.size(), 2U);
    const Vec3 first = moves.back().points[0].position - point(1, 1);
    const Vec3 second = moves.back().points[1].position - point(2, 2);
    EXPECT_LT((first - second).norm(), 1e-12);
    EXPECT_TRUE(all<SelectControlPoints>().empty());
}

TEST_F(ViewportTest, SelectsAPointThatIsDraggedWithoutBeingSelected) {
    show(ViewKind::design);
    scene.selected = {{.i = 2, .j = 2}};
    const widgets::Point at = handle("control_point(1,1)");
    move_to(at);
    press();
    input.mouse_x += 30.0F;
    frame();
    release();
    ASSERT_EQ(all<SelectControlPoints>().size(), 1U);
    EXPECT_EQ(all<SelectControlPoints>().front().points, (std::vector<ControlPointId>{{.i = 1, .j = 1}}));
    EXPECT_EQ(all<MoveControlPoints>().back().points.size(), 1U);
}

TEST_F(ViewportTest, TakesADragBackOnEscape) {
    show(ViewKind::design);
    const widgets::Point at = handle("control_point(1,1)");
    move_to(at);
    press();
    input.mouse_x += 30.0F;
    frame();
    input.keys = {render::Key::escape};
    frame();
    input.keys.clear();
    input.mouse_x += 30.0F;
    frame();
    release();
    const auto moves = all<MoveControlPoints>();
    ASSERT_EQ(moves.size(), 2U);
    EXPECT_EQ(moves.back().stage, Stage::cancelled);
}

TEST_F(ViewportTest, EndsADragWhoseReleaseItHasNotSeen) {
    show(ViewKind::design);
    move_to(handle("control_point(1,1)"));
    press();
    input.mouse_x += 30.0F;
    frame();
    scene.surface_tool.kind = SurfaceToolKind::brush; // the mouse is on the surface alone
    release();
    scene.surface_tool.kind = SurfaceToolKind::none;
    frame();
    EXPECT_FALSE(viewport().dragging());
    EXPECT_EQ(all<MoveControlPoints>().back().stage, Stage::finished);
}

TEST_F(ViewportTest, SelectsByABox) {
    show(ViewKind::design);
    const widgets::Point a = handle("control_point(1,1)");
    const widgets::Point b = handle("control_point(2,2)");
    move(std::min(a.x, b.x) - 100.0F, std::min(a.y, b.y) - 12.0F);
    press();
    input.mouse_x = std::max(a.x, b.x) + 12.0F;
    input.mouse_y = std::max(a.y, b.y) + 12.0F;
    frame();
    release();
    ASSERT_EQ(all<SelectControlPoints>().size(), 1U);
    const std::vector<ControlPointId> points = all<SelectControlPoints>().front().points;
    EXPECT_NE(std::ranges::find(points, ControlPointId{.i = 1, .j = 1}), points.end());
    EXPECT_NE(std::ranges::find(points, ControlPointId{.i = 2, .j = 2}), points.end());
    EXPECT_EQ(std::ranges::find(points, ControlPointId{.i = 0, .j = 0}), points.end());
}

TEST_F(ViewportTest, SelectsNothingByABoxIfTheSurfaceHasGoneMeanwhile) {
    show(ViewKind::design);
    move(20.0F, 60.0F);
    press();
    input.mouse_x += 300.0F;
    input.mouse_y += 300.0F;
    frame();
    scene.surface = nullptr;
    release();
    EXPECT_TRUE(events.empty());
}

TEST_F(ViewportTest, DragsNothingIfAnEditHasTakenThePointAwayMeanwhile) {
    show(ViewKind::design);
    move_to(handle("control_point(3,3)"));
    press();
    geometry::ControlNet smaller = geometry::ControlNet::sized(2, 2);
    smaller.points = {{0.0, 0.0, 0.0}, {0.0, 50.0, 0.0}, {50.0, 0.0, 0.0}, {50.0, 50.0, 0.0}};
    scene.surface = std::make_shared<const geometry::Surface>(
        std::vector<geometry::BezierPatch>{geometry::BezierPatch(smaller)});
    input.mouse_x += 30.0F;
    frame();
    EXPECT_FALSE(viewport().dragging());
    EXPECT_TRUE(all<MoveControlPoints>().empty());
}

TEST_F(ViewportTest, GoesToTheMoveThatIsClicked) {
    show(ViewKind::toolpath, test::two_bell);
    viewport().look_from(render::StandardView::top);
    frame();
    const auto& points = scene.shown->toolpath.points;
    const Vec2 uv = 0.75 * points[50].origin.uv + 0.25 * points[51].origin.uv;
    const Vec3 place = scene.cutting_setup->patch.position(uv.x(), uv.y());
    const render::View view = viewport().camera().view(size(), {});
    const glm::dvec2 pixel = render::project(view, render::to_glm(place)).value().pixel;
    click(static_cast<float>(pixel.x), static_cast<float>(pixel.y));
    ASSERT_EQ(all<GoToMove>().size(), 1U);
    EXPECT_EQ(all<GoToMove>().front().move, 50);
    EXPECT_NEAR(all<GoToMove>().front().fraction, 0.25, 0.1);
}

TEST_F(ViewportTest, TellsThePlaceUnderTheMouse) {
    show(ViewKind::error, test::two_bell);
    const Vec3 place = scene.cutting_setup->patch.position(0.4, 0.3);
    const render::View view = viewport().camera().view(size(), {});
    const glm::dvec2 pixel = render::project(view, render::to_glm(place)).value().pixel;
    move(static_cast<float>(pixel.x), static_cast<float>(pixel.y));
    ASSERT_TRUE(viewport().under_mouse().on_surface);
    EXPECT_LT((*viewport().under_mouse().on_surface - place).norm(), 0.5);
    EXPECT_LT((*viewport().under_mouse().uv - Vec2(0.4, 0.3)).norm(), 0.01);
    move(5.0F, 100.0F);
    EXPECT_FALSE(viewport().under_mouse().on_surface);
}

TEST_F(ViewportTest, OrbitsWithoutAskingForAnything) {
    show(ViewKind::design);
    const render::CameraPose before = viewport().camera().pose();
    move_to(handle("control_point(1,1)"));
    press(2);
    input.mouse_x += 40.0F;
    frame();
    release(2);
    EXPECT_NE(viewport().camera().pose().yaw, before.yaw);
    EXPECT_TRUE(events.empty());
}

TEST_F(ViewportTest, KeepsTheCameraUntilItIsAskedToFit) {
    show(ViewKind::design);
    const render::CameraPose fitted = viewport().camera().pose();
    move(300.0F, 200.0F);
    input.wheel = 3.0F;
    frame();
    frame();
    EXPECT_NE(viewport().camera().pose(), fitted);
    viewport().fit();
    frame();
    EXPECT_NEAR(viewport().camera().pose().distance, fitted.distance, 1e-9);
}

TEST_F(ViewportTest, FitsByAKeyAndADoubleClickOnNothing) {
    show(ViewKind::design);
    const double fitted = viewport().camera().pose().distance;
    move(60.0F, 100.0F);
    input.wheel = -4.0F;
    frame();
    tap(render::Key::f);
    EXPECT_NEAR(viewport().camera().pose().distance, fitted, 1e-9);
    input.wheel = -4.0F;
    frame();
    for (int k = 0; k < 2; ++k) {
        press();
        release();
    }
    frame();
    EXPECT_NEAR(viewport().camera().pose().distance, fitted, 1e-9);
}

TEST_F(ViewportTest, TurnsToTheSidesByKeys) {
    show(ViewKind::design);
    move(60.0F, 100.0F);
    tap(render::Key::digit_2);
    EXPECT_NEAR(viewport().camera().backward().z, 1.0, 1e-12);
    tap(render::Key::digit_1);
    EXPECT_NEAR(viewport().camera().backward().y, -1.0, 1e-12);
    tap(render::Key::p);
    EXPECT_EQ(viewport().camera().pose().projection, render::Projection::orthographic);
}

TEST_F(ViewportTest, TurnsToASideByAClickOnTheEndOfAnAxis) {
    show(ViewKind::design);
    const widgets::Point middle = ui().place("view/axes").value().centre();
    const glm::dvec3 right = viewport().camera().right();
    const glm::dvec3 up = viewport().camera().up();
    click(middle.x + 30.0F * static_cast<float>(right.x), middle.y - 30.0F * static_cast<float>(up.x));
    frame();
    EXPECT_NEAR(viewport().camera().backward().x, 1.0, 1e-12);
    EXPECT_TRUE(events.empty());
}

TEST_F(ViewportTest, KeepsACameraForTheMachineOfItsOwn) {
    show(ViewKind::design);
    const render::CameraPose part = viewport().camera().pose();
    show(ViewKind::machine);
    EXPECT_GT(viewport().camera().pose().distance, 2.0 * part.distance);
    show(ViewKind::design);
    EXPECT_EQ(viewport().camera().pose(), part);
}

TEST_F(ViewportTest, ShowsFourSidesAtOnce) {
    show(ViewKind::design);
    viewport().set_arrangement(Arrangement::four);
    frame();
    frame();
    for (const char* side : {"top", "front", "right", "iso"}) {
        const widgets::Point at = handle(std::string(side) + "/control_point(1,1)");
        EXPECT_TRUE(at.x > 0.0F && at.x < 640.0F && at.y > 0.0F && at.y < 480.0F) << side;
    }
    const widgets::Point at = handle("front/control_point(1,1)");
    move_to(at);
    press();
    input.mouse_y -= 20.0F;
    frame();
    release();
    const Vec3 moved = all<MoveControlPoints>().back().points.front().position - point(1, 1);
    EXPECT_GT(moved.z(), 1.0);
    EXPECT_LT(moved.head<2>().norm(), 1e-9); // straight up in a picture from the front
    test::keep(picture(), "window-four");
}

TEST_F(ViewportTest, DrawsTheSameTwice) {
    show(ViewKind::error);
    const render::Picture once = picture();
    frame();
    EXPECT_EQ(picture(), once);
    test::keep(once, "window-error");
}

TEST_F(ViewportTest, IsRoughWhileItIsTurnedAndSmoothAtRest) {
    show(ViewKind::design);
    move(300.0F, 240.0F);
    press(2);
    input.mouse_x += 40.0F;
    frame();
    const render::Picture turning = picture();
    frame();
    EXPECT_EQ(picture(), turning); // a hand that rests is still turning
    EXPECT_FALSE(ui().next_change());
    release(2);
    frame();
    const render::Picture at_rest = picture();
    EXPECT_NE(at_rest, turning);
    EXPECT_FALSE(ui().next_change());
    frame();
    EXPECT_EQ(picture(), at_rest);
}

TEST_F(ViewportTest, IsSmoothSoonAfterTheWheelHasStopped) {
    show(ViewKind::design);
    move(300.0F, 240.0F);
    input.wheel = 2.0F;
    frame();
    const render::Picture zooming = picture();
    ASSERT_TRUE(ui().next_change());
    EXPECT_GT(*ui().next_change(), 0.0);
    input.seconds = 1.0F;
    frame();
    input.seconds = 1.0F / 60.0F;
    EXPECT_NE(picture(), zooming);
    EXPECT_FALSE(ui().next_change());
}

TEST_F(ViewportTest, ASingleChangeIsSmoothAtOnce) {
    show(ViewKind::design);
    frame();
    scene.layers.design.lines = !scene.layers.design.lines;
    frame();
    const render::Picture changed = picture();
    frame();
    EXPECT_EQ(picture(), changed);
}

TEST_F(ViewportTest, SurvivesAPaneWithoutRoom) {
    scene = test::scene_of(test::dome, ViewKind::error);
    const widgets::Rect nothing = {10.0F, 10.0F, 0.0F, 0.0F};
    input.mouse_x = 10.0F;
    EXPECT_NO_THROW(frame_in(nothing)); // before it was fitted
    frame();
    EXPECT_NO_THROW(frame_in(nothing));
}

} // namespace
} // namespace millwright::viewport
