#include "core/project/internal/region_area.h"

#include "core/geometry/mesh.h"

namespace millwright::project {

bool encloses_area(const std::vector<Vec2>& outline) {
    constexpr double least = 1e-9; // of the square: a thirty-thousandth of it each way, which no one draws
    const geometry::TrimmedSquare square = geometry::trimmed_square({.loops = {outline}}, 1, 1);
    double area = 0.0;
    for (const auto& [a, b, c] : square.inside) {
        const Vec2& corner = square.places[static_cast<std::size_t>(a)];
        const Vec2 p = square.places[static_cast<std::size_t>(b)] - corner;
        const Vec2 q = square.places[static_cast<std::size_t>(c)] - corner;
        area += 0.5 * (p.x() * q.y() - p.y() * q.x());
    }
    return area >= least;
}

} // namespace millwright::project
