// The only place where the core's vectors become the view's, and back.
#pragma once

#include "core/geometry/vectors.h"
#include "ui/render/bounds.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace millwright::render {

[[nodiscard]] inline glm::dvec3 to_glm(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}
[[nodiscard]] inline glm::vec3 to_float(const Vec3& p) {
    return {to_glm(p)};
}
[[nodiscard]] inline Vec3 to_core(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

[[nodiscard]] inline glm::dmat4 to_glm(const Frame& frame) {
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            matrix[column][row] = frame.matrix()(row, column);
        }
    }
    return matrix;
}

[[nodiscard]] inline Bounds to_glm(const Box3& box) {
    return box.isEmpty() ? Bounds{} : Bounds{.min = to_glm(Vec3(box.min())), .max = to_glm(Vec3(box.max()))};
}

} // namespace millwright::render
