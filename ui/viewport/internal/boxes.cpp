#include "ui/viewport/internal/boxes.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace millwright::viewport {

std::vector<glm::dvec3> moved(std::span<const Vec3> points, const Frame& motion) {
    std::vector<glm::dvec3> scene;
    for (const Vec3& point : points) {
        scene.push_back(render::to_glm(motion * point));
    }
    return scene;
}

std::vector<glm::dvec3> moved_corners(const Box3& box, const Frame& motion) {
    std::vector<glm::dvec3> scene;
    for (const glm::dvec3& corner : corners(render::to_glm(box))) {
        scene.push_back(render::to_glm(motion * render::to_core(corner)));
    }
    return scene;
}

double radius(const render::Bounds& box) {
    return is_empty(box) ? 0.0 : 0.5 * glm::length(box.max - box.min);
}

double origin_axis_length(const render::Bounds& content) {
    constexpr double share = 0.22; // of the content's radius
    return share * radius(content);
}

double round_length(double length) {
    const double power = std::pow(10.0, std::floor(std::log10(length)));
    const double mantissa = length / power;
    return power * (mantissa < 2.0 ? 1.0 : (mantissa < 5.0 ? 2.0 : 5.0));
}

} // namespace millwright::viewport
