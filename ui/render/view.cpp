#include "ui/render/view.h"

#include "core/base/error.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <cmath>

namespace millwright::render {

namespace {

glm::dvec3 unprojected(const glm::dmat4& scene_from_clip, const glm::dvec3& device) {
    const glm::dvec4 point = scene_from_clip * glm::dvec4(device, 1.0);
    return glm::dvec3(point) / point.w;
}

/// Row of the view's matrix: 0 right, 1 up, 2 backward.
glm::dvec3 picture_axis(const View& view, int row) {
    return {view.view[0][row], view.view[1][row], view.view[2][row]};
}

/// Whether the picture's axes are not at right angles to the depth.
bool is_sheared(const View& view) {
    constexpr double right_angle = 1e-9; // cosine
    return std::abs(glm::dot(picture_axis(view, 0), picture_axis(view, 2))) > right_angle;
}

} // namespace

std::optional<Projected> project(const View& view, const glm::dvec3& point) {
    const glm::dvec4 clip = view.projection * (view.view * glm::dvec4(point, 1.0));
    if (!(clip.w > 0.0)) {
        return std::nullopt;
    }
    const glm::dvec3 device = glm::dvec3(clip) / clip.w;
    return Projected{
        .pixel = {0.5 * (device.x + 1.0) * view.size.width, 0.5 * (1.0 - device.y) * view.size.height},
        .depth = 0.5 * (device.z + 1.0)};
}

Ray ray(const View& view, const glm::dvec2& pixel) {
    expects(view.size.width > 0 && view.size.height > 0, "a view has an area");
    const double x = 2.0 * pixel.x / view.size.width - 1.0;
    const double y = 1.0 - 2.0 * pixel.y / view.size.height;
    const glm::dmat4 scene_from_clip = glm::inverse(view.projection * view.view);
    const glm::dvec3 near_point = unprojected(scene_from_clip, {x, y, -1.0});
    const glm::dvec3 far_point = unprojected(scene_from_clip, {x, y, 1.0});
    return {.origin = near_point, .direction = glm::normalize(far_point - near_point)};
}

glm::dmat4 unsheared(const View& view) {
    glm::dmat4 plain = view.view;
    if (is_sheared(view)) {
        const glm::dvec3 backward = picture_axis(view, 2);
        for (const int row : {0, 1}) {
            const double shear = glm::dot(picture_axis(view, row), backward) / glm::dot(backward, backward);
            for (int column = 0; column < 4; ++column) {
                plain[column][row] -= shear * plain[column][2];
            }
        }
    }
    return plain;
}

glm::dvec3 looking_along(const View& view) {
    return is_sheared(view) ? glm::normalize(glm::inverse(glm::dmat3(view.view)) * glm::dvec3(0.0, 0.0, -1.0))
                            : -picture_axis(view, 2);
}

double pixel_length(const View& view, const glm::dvec3& point) {
    const glm::dvec4 clip = view.projection * (view.view * glm::dvec4(point, 1.0));
    return 2.0 * std::abs(clip.w) / (view.projection[1][1] * view.size.height);
}

std::optional<glm::dvec3> meet_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal) {
    const double approach = glm::dot(ray.direction, normal);
    const double along = glm::dot(point - ray.origin, normal) / approach;
    constexpr double grazing = 1e-9; // as sine of the angle; closer to parallel, the meeting point is noise
    if (!(std::abs(approach) > grazing * glm::length(normal)) || along < 0.0) {
        return std::nullopt;
    }
    return ray.origin + along * ray.direction;
}

} // namespace millwright::render
