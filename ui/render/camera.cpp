#include "ui/render/camera.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"

#include <glm/common.hpp>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::render {

namespace {

constexpr double nearest_mm = 1e-3; // closer, single precision vertices of a 1 m scene visibly jump
constexpr double farthest_mm = 1e7;
constexpr double fit_margin = 1.08;             // part of the picture left free around a fitted box
constexpr double depth_margin = 0.02;           // of the scene's depth, so that no plane cuts its border
constexpr double nearest_to_far = 1.0 / 5000.0; // keeps a 24-bit depth buffer finer than a pixel
const glm::dvec2 oblique_shift{std::cos(pi / 6.0), std::sin(pi / 6.0)}; // of a depth of 1
const double tan_half_field = std::tan(0.5 * Camera::field_of_view);

bool finite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

CameraPose held(CameraPose pose) {
    pose.distance = std::clamp(pose.distance, nearest_mm, farthest_mm);
    pose.yaw = std::remainder(pose.yaw, 2.0 * pi);
    pose.pitch = std::clamp(pose.pitch, -0.5 * pi, 0.5 * pi);
    return pose;
}

/// Distances from the eye along the line of sight that enclose the scene and the target.
std::pair<double, double> depth_range(const Camera& camera, const Bounds& scene) {
    double low = camera.pose().distance;
    double high = low;
    if (!is_empty(scene)) {
        for (const glm::dvec3& corner : corners(scene)) {
            const double depth = glm::dot(camera.eye() - corner, camera.backward());
            low = std::min(low, depth);
            high = std::max(high, depth);
        }
    }
    const double margin = depth_margin * (high - low) + 0.1 * camera.pose().distance;
    return {low - margin, high + margin};
}

/// What a point's place in the picture goes by: right and up, to which an oblique projection adds the depth.
struct PictureAxes {
    glm::dvec3 x, y;
};

PictureAxes picture_axes(const Camera& camera) {
    if (camera.pose().projection != Projection::oblique) {
        return {camera.right(), camera.up()};
    }
    return {camera.right() - oblique_shift.x * camera.backward(),
            camera.up() - oblique_shift.y * camera.backward()};
}

/// The target plane stays where it is.
glm::dmat4 scene_to_eye(const Camera& camera) {
    const auto [x, y] = picture_axes(camera);
    const glm::dvec3 z = camera.backward();
    const glm::dvec3 eye = camera.eye();
    const glm::dvec3 in_picture =
        camera.pose().projection == Projection::oblique ? camera.pose().target : eye;
    return {{x.x, y.x, z.x, 0.0},
            {x.y, y.y, z.y, 0.0},
            {x.z, y.z, z.z, 0.0},
            {-glm::dot(x, in_picture), -glm::dot(y, in_picture), -glm::dot(z, eye), 1.0}};
}

glm::dmat4 eye_to_clip(const Camera& camera, double width_to_height, const Bounds& scene) {
    const auto [low, high] = depth_range(camera, scene);
    if (camera.pose().projection != Projection::perspective) {
        const double half = half_height(camera);
        return glm::ortho(-half * width_to_height, half * width_to_height, -half, half, low, high);
    }
    const double near_plane = std::max(low, high * nearest_to_far);
    return glm::perspective(Camera::field_of_view, width_to_height, near_plane, high);
}

/// How long a pixel is in the target plane, mm.
double target_pixel(const Camera& camera, const PixelSize& size) {
    return 2.0 * half_height(camera) / std::max(size.height, 1);
}

struct Extent {
    double low = 0.0;
    double high = 0.0;

    [[nodiscard]] double size() const { return high - low; }
    [[nodiscard]] double middle() const { return 0.5 * (low + high); }
};

/// Of the points along `direction`, each slid along a side of the picture, which leans by `tangent`, to where
/// the plane through the origin across `backward` meets it.
Extent extent(std::span<const glm::dvec3> points,
              const glm::dvec3& direction,
              const glm::dvec3& backward,
              double tangent) {
    Extent found = {.low = infinity, .high = -infinity};
    for (const glm::dvec3& point : points) {
        const double along = glm::dot(point, direction);
        const double slid = tangent * glm::dot(point, backward);
        found.low = std::min(found.low, along - slid);
        found.high = std::max(found.high, along + slid);
    }
    return found;
}

} // namespace

bool operator==(const CameraPose& a, const CameraPose& b) {
    return exactly_equal(a.target.x, b.target.x) && exactly_equal(a.target.y, b.target.y) &&
           exactly_equal(a.target.z, b.target.z) && exactly_equal(a.distance, b.distance) &&
           exactly_equal(a.yaw, b.yaw) && exactly_equal(a.pitch, b.pitch) && a.projection == b.projection;
}

double half_height(const Camera& camera) {
    return camera.pose().distance * tan_half_field;
}

Camera::Camera(const CameraPose& pose) : pose_(held(pose)) {
    expects(finite(pose.target) && std::isfinite(pose.distance) && std::isfinite(pose.yaw) &&
                std::isfinite(pose.pitch),
            "a camera's position is finite");
    expects(pose.distance > 0.0, "a camera is away from its target");
}

glm::dvec3 Camera::backward() const {
    return {std::cos(pose_.pitch) * std::cos(pose_.yaw),
            std::cos(pose_.pitch) * std::sin(pose_.yaw),
            std::sin(pose_.pitch)};
}

glm::dvec3 Camera::right() const {
    return {-std::sin(pose_.yaw), std::cos(pose_.yaw), 0.0};
}

glm::dvec3 Camera::up() const {
    return {-std::sin(pose_.pitch) * std::cos(pose_.yaw),
            -std::sin(pose_.pitch) * std::sin(pose_.yaw),
            std::cos(pose_.pitch)};
}

glm::dvec3 Camera::eye() const {
    return pose_.target + pose_.distance * backward();
}

View Camera::view(const PixelSize& size, const Bounds& scene, double content_scale) const {
    return {.view = scene_to_eye(*this),
            .projection = eye_to_clip(*this, aspect(size), scene),
            .size = {std::max(size.width, 1), std::max(size.height, 1)},
            .content_scale = content_scale};
}

Camera Camera::orbited(double yaw, double pitch) const {
    CameraPose pose = pose_;
    pose.yaw += yaw;
    pose.pitch += pitch;
    return Camera(pose);
}

Camera Camera::orbited(const glm::dvec2& drag_px, const PixelSize& size) const {
    const double radians_per_pixel = pi / std::max(size.height, 1);
    return orbited(-drag_px.x * radians_per_pixel, drag_px.y * radians_per_pixel);
}

Camera Camera::panned(const glm::dvec2& drag_px, const PixelSize& size) const {
    CameraPose pose = pose_;
    pose.target += target_pixel(*this, size) * (-drag_px.x * right() + drag_px.y * up());
    return Camera(pose);
}

Camera Camera::zoomed(double factor, const glm::dvec2& pixel, const PixelSize& size) const {
    expects(factor > 0.0 && std::isfinite(factor), "a zoom factor is positive");
    CameraPose pose = pose_;
    pose.distance = std::clamp(pose_.distance * factor, nearest_mm, farthest_mm);
    const glm::dvec2 from_center = {pixel.x - 0.5 * size.width, 0.5 * size.height - pixel.y};
    const glm::dvec3 at_cursor = target_pixel(*this, size) * (from_center.x * right() + from_center.y * up());
    pose.target += (1.0 - pose.distance / pose_.distance) * at_cursor;
    return Camera(pose);
}

Camera Camera::fitted(const Bounds& box, double aspect) const {
    return is_empty(box) ? *this : fitted(corners(box), aspect);
}

Camera Camera::fitted(std::span<const glm::dvec3> points, double aspect) const {
    if (points.empty()) {
        return *this;
    }
    const double tan_up = tan_half_field / fit_margin;
    const bool perspective = pose_.projection == Projection::perspective;
    const auto [x, y] = picture_axes(*this);
    const Extent across = extent(points, x, backward(), perspective ? tan_up * aspect : 0.0);
    const Extent upright = extent(points, y, backward(), perspective ? tan_up : 0.0);
    const Extent depth = extent(points, backward(), right(), 0.0);
    const double needed = std::max(across.size() / (tan_up * aspect), upright.size() / tan_up) * 0.5;
    CameraPose pose = pose_;
    // In perspective the sides of the picture meet at the eye, otherwise they are `needed` apart at the
    // target.
    pose.distance = perspective ? needed - depth.middle() : needed;
    const glm::dvec2 shift = pose_.projection == Projection::oblique ? oblique_shift : glm::dvec2(0.0);
    pose.target = (across.middle() + depth.middle() * shift.x) * right() +
                  (upright.middle() + depth.middle() * shift.y) * up() + depth.middle() * backward();
    pose.distance = pose.distance > 0.0 ? pose.distance : pose_.distance;
    return Camera(pose);
}

Camera Camera::seen_from(StandardView side) const {
    CameraPose pose = pose_;
    pose.pitch = 0.0;
    pose.yaw = -0.5 * pi;
    if (pose.projection == Projection::oblique) {
        pose.projection = Projection::orthographic;
    }
    switch (side) {
    case StandardView::front:
        break;
    case StandardView::oblique:
        pose.projection = Projection::oblique;
        break;
    case StandardView::top:
        pose.pitch = 0.5 * pi;
        break;
    case StandardView::bottom:
        pose.pitch = -0.5 * pi;
        break;
    case StandardView::back:
        pose.yaw = 0.5 * pi;
        break;
    case StandardView::left:
        pose.yaw = pi;
        break;
    case StandardView::right:
        pose.yaw = 0.0;
        break;
    case StandardView::iso:
        pose.yaw = CameraPose{}.yaw;
        pose.pitch = CameraPose{}.pitch;
        break;
    }
    return Camera(pose);
}

Camera Camera::with(Projection projection) const {
    CameraPose pose = pose_;
    pose.projection = projection;
    return Camera(pose);
}

} // namespace millwright::render
