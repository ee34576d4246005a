#include "ui/viewport/point_drag.h"

#include "core/base/error.h"
#include "tests/ui/viewport/views.h"
#include "ui/render/camera.h"
#include "ui/render/convert.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::viewport {
namespace {

using test::exact_mm;
using test::pixel_of;
using test::view_size;

const Vec3 grabbed(12.0, -7.0, 30.0);

render::Bounds around() {
    return {.min = glm::dvec3(-60.0), .max = glm::dvec3(60.0)};
}

render::Camera camera(render::Projection projection) {
    return render::Camera(
        {.target = {5.0, 5.0, 5.0}, .distance = 250.0, .yaw = -0.6, .pitch = 0.5, .projection = projection});
}

render::View seen(render::Projection projection) {
    return camera(projection).view(view_size, around());
}

PointDrag drag_of(const render::View& view, const Frame& s_T_w = Frame::Identity()) {
    return {{{.id = {}, .position = grabbed}}, 0, s_T_w, pixel_of(view, s_T_w * grabbed)};
}

TEST(PointDrag, MovesInTheScreenPlaneByThePixelsTimesTheirLength) {
    for (const auto projection : {render::Projection::orthographic, render::Projection::perspective}) {
        const render::View view = seen(projection);
        const render::Camera eye = camera(projection);
        PointDrag drag = drag_of(view);
        const glm::dvec2 way = {37.0, -81.0};
        drag.move_to(view, pixel_of(view, grabbed) + way, {});
        const double pixel = render::pixel_length(view, render::to_glm(grabbed));
        const Vec3 expected =
            pixel * (way.x * render::to_core(eye.right()) - way.y * render::to_core(eye.up()));
        EXPECT_LT((drag.moved() - expected).norm(), exact_mm);
        EXPECT_LT((drag.points().front().position - grabbed - expected).norm(), exact_mm);
    }
}

TEST(PointDrag, KeepsTheGrabbedPointUnderTheMouseAlongAnAxis) {
    const render::View view = seen(render::Projection::perspective);
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 wanted = grabbed + 17.5 * Vec3::Unit(axis);
        PointDrag drag = drag_of(view);
        drag.move_to(view, pixel_of(view, wanted), {.axis = axis});
        EXPECT_LT((drag.points().front().position - wanted).norm(), exact_mm) << axis;
    }
}

TEST(PointDrag, StaysOnTheAxisWhereverTheMouseGoes) {
    const render::View view = seen(render::Projection::perspective);
    PointDrag drag = drag_of(view);
    drag.move_to(view, {600.0, 20.0}, {.axis = 2});
    EXPECT_LT(drag.moved().head<2>().norm(), exact_mm);
    EXPECT_GT(drag.moved().norm(), 1.0);
}

TEST(PointDrag, CountsFromTheBeginningWhenAnAxisIsHeldLater) {
    const render::View view = seen(render::Projection::perspective);
    const Vec3 wanted = grabbed + 9.0 * Vec3::UnitX();
    PointDrag drag = drag_of(view);
    drag.move_to(view, {10.0, 400.0}, {});
    drag.move_to(view, pixel_of(view, wanted), {.axis = 0});
    EXPECT_LT((drag.points().front().position - wanted).norm(), exact_mm);
}

TEST(PointDrag, GoesATenthOfTheWayWhenFine) {
    const render::View view = seen(render::Projection::orthographic);
    const glm::dvec2 start = pixel_of(view, grabbed);
    PointDrag whole = drag_of(view);
    whole.move_to(view, start + glm::dvec2(50.0, 20.0), {});
    PointDrag fine = drag_of(view);
    fine.move_to(view, start + glm::dvec2(50.0, 20.0), {.axis = {}, .fine = true});
    EXPECT_LT((10.0 * fine.moved() - whole.moved()).norm(), 10.0 * exact_mm);
}

TEST(PointDrag, DoesNotJumpWhenFineIsPressedMidway) {
    const render::View view = seen(render::Projection::orthographic);
    const glm::dvec2 there = pixel_of(view, grabbed) + glm::dvec2(50.0, 20.0);
    PointDrag drag = drag_of(view);
    drag.move_to(view, there, {});
    const Vec3 before = drag.moved();
    drag.move_to(view, there, {.axis = {}, .fine = true});
    EXPECT_LT((drag.moved() - before).norm(), exact_mm);
}

TEST(PointDrag, SnapsTheGrabbedPointToRoundCoordinates) {
    const render::View view = camera(render::Projection::orthographic)
                                  .seen_from(render::StandardView::top)
                                  .view(view_size, around());
    const double step = snap_step(view, grabbed);
    PointDrag drag = drag_of(view);
    drag.move_to(view, pixel_of(view, grabbed) + glm::dvec2(93.0, 41.0), {.axis = {}, .snap = true});
    const Vec3 at = drag.points().front().position;
    for (const int k : {0, 1}) {
        EXPECT_NEAR(std::remainder(at[k], step), 0.0, exact_mm) << k;
    }
    EXPECT_NEAR(at.z(), grabbed.z(), exact_mm); // it does not move there
}

TEST(PointDrag, StepsOfSnappingAreRoundAndAboutEightPixels) {
    const render::View view = seen(render::Projection::orthographic);
    const double step = snap_step(view, grabbed);
    const double pixels = step / render::pixel_length(view, render::to_glm(grabbed));
    EXPECT_LE(pixels, 8.0);
    EXPECT_GT(pixels, 8.0 / 2.5 - 1e-9);
    const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(mantissa - 1.0) < 1e-9 || std::abs(mantissa - 2.0) < 1e-9 ||
                std::abs(mantissa - 5.0) < 1e-9)
        << step;
}

TEST(PointDrag, MovesAllPointsByTheSameWay) {
    const render::View view = seen(render::Projection::perspective);
    const MovedControlPoint other = {.id = {.i = 1, .j = 2}, .position = {1.0, 2.0, 3.0}};
    PointDrag drag({other, {.id = {}, .position = grabbed}}, 1, Frame::Identity(), pixel_of(view, grabbed));
    drag.move_to(view, {333.0, 111.0}, {});
    const auto points = drag.points();
    EXPECT_EQ(points[0].id, other.id);
    EXPECT_LT((points[0].position - other.position - drag.moved()).norm(), exact_mm);
    EXPECT_LT((points[1].position - grabbed - drag.moved()).norm(), exact_mm);
}

TEST(PointDrag, AxesAreTheWorkpiecesAlsoWhereTheWorkpieceIsTurned) {
    const render::View view = seen(render::Projection::perspective);
    Frame s_T_w = Frame::Identity();
    s_T_w.rotate(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 0.5).normalized()));
    s_T_w.translation() = Vec3(-4.0, 11.0, 6.0);
    const Vec3 wanted = grabbed - 8.0 * Vec3::UnitY();
    PointDrag drag = drag_of(view, s_T_w);
    drag.move_to(view, pixel_of(view, s_T_w * wanted), {.axis = 1});
    EXPECT_LT((drag.points().front().position - wanted).norm(), exact_mm);
}

TEST(PointDrag, RefusesToDragWhatIsNotThere) {
    EXPECT_THROW(PointDrag({}, 0, Frame::Identity(), {}), Defect);
}

} // namespace
} // namespace millwright::viewport
