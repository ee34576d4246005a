// What a part is cut from, as it lies in part coordinates. Lengths mm.
#pragma once

#include "core/geometry/vectors.h"
#include "core/simulation/interval.h"

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace millwright::simulation {

struct BoxStock {
    Vec3 low = Vec3::Zero();
    Vec3 high = Vec3::Ones();
};

/// Solid, or a tube where `bore` is above 0. From `base` along a coordinate axis.
struct CylinderStock {
    Vec3 base = Vec3::Zero(); ///< the middle of the lower end
    int axis = 2;             ///< 0 to 2: along X, Y or Z
    double diameter = 1.0;
    double bore = 0.0; ///< its diameter
    double length = 1.0;
};

/// A closed surface of triangles that look outwards.
struct MeshStock {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles; ///< indices
    bool is_checked = false;                   ///< fault_of() has found nothing
};

using Stock = std::variant<BoxStock, CylinderStock, std::shared_ptr<const MeshStock>>;

/// What is wrong with it, as a sentence with the place; empty if nothing is. Of a mesh: edges without a
/// neighbour, and a volume that is not above 0. That it does not cross itself is found by ray.
[[nodiscard]] std::string fault_of(const Stock& stock);

[[nodiscard]] Box3 bounds(const Stock& stock);
/// In closed form, mm^3.
[[nodiscard]] double volume(const Stock& stock);

/// The material along lines of a grid that are parallel to coordinate axis `k`.
struct RayGrid {
    int k = 2;
    Vec3 first = Vec3::Zero(); ///< coordinate k does not count
    Vec3 pitch = Vec3::Ones();
    std::array<int, 2> count{}; ///< along axes (k+1)%3 and (k+2)%3
};
/// One list a line, the first axis fastest; each in order, without gaps of no length. Throws Error, with the
/// place, where a mesh crosses itself.
[[nodiscard]] std::vector<std::vector<Interval>> material_along(const Stock& stock, const RayGrid& grid);

/// "box 100 x 60 x 20 mm from 0, 0, -20".
[[nodiscard]] std::string to_text(const Stock& stock);

} // namespace millwright::simulation
