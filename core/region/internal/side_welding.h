// Which sides of faces are the same border, and the points that they share there.
#pragma once

#include "core/region/face_mesh.h"
#include "core/region/internal/side_curve.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace millwright::region {

struct WeldedSides {
    std::vector<Vec3> points; ///< those of the corners first
    std::vector<FaceBorder> borders;
    /// Per face: the points at the start of each side. Two are the same where a side is one point.
    std::vector<std::array<int, 4>> corners;
};

/// `spacing`: of the points along a border, mm. Throws as `face_mesh`.
[[nodiscard]] WeldedSides
weld_sides(std::span<const ExactFace> faces, double tolerance, double spacing, const Progress& progress);

/// "x 1.000, y 2.000, z 3.000 mm".
[[nodiscard]] std::string place_text(const Vec3& at);

} // namespace millwright::region
