#include "ui/render/bounds.h"

#include <glm/common.hpp>

namespace millwright::render {

bool is_empty(const Bounds& box) {
    return box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z;
}

glm::dvec3 center(const Bounds& box) {
    return 0.5 * (box.min + box.max);
}

std::array<glm::dvec3, 8> corners(const Bounds& box) {
    std::array<glm::dvec3, 8> all{};
    for (unsigned i = 0; i < 8; ++i) {
        all[i] = {(i & 1U) != 0U ? box.max.x : box.min.x,
                  (i & 2U) != 0U ? box.max.y : box.min.y,
                  (i & 4U) != 0U ? box.max.z : box.min.z};
    }
    return all;
}

Bounds united(const Bounds& a, const Bounds& b) {
    if (is_empty(a)) {
        return b;
    }
    if (is_empty(b)) {
        return a;
    }
    return {.min = glm::min(a.min, b.min), .max = glm::max(a.max, b.max)};
}

Bounds united(const Bounds& box, const glm::dvec3& point) {
    return united(box, Bounds{.min = point, .max = point});
}

} // namespace millwright::render
