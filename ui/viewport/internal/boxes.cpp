#include "ui/viewport/internal/boxes.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace millwright::viewport {

render::Bounds transformed(const Box3& box, const Frame& motion) {
    return box.isEmpty() ? render::Bounds{} : render::to_glm(box.transformed(motion));
}

double radius(const render::Bounds& box) {
    return is_empty(box) ? 0.0 : 0.5 * glm::length(box.max - box.min);
}

double round_length(double length) {
    const double power = std::pow(10.0, std::floor(std::log10(length)));
    const double mantissa = length / power;
    return power * (mantissa < 2.0 ? 1.0 : (mantissa < 5.0 ? 2.0 : 5.0));
}

} // namespace millwright::viewport
