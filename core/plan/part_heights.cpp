#include "core/plan/part_heights.h"

#include "core/base/parallel.h"

namespace millwright::plan {

PartHeights::PartHeights(const CuttingSetup& cutting_setup)
    : cutting_setup_(cutting_setup), search_(cutting_setup_.patch) {}

std::optional<double> PartHeights::at(const Vec3& point) const {
    const geometry::ClosestPoint near = search_.closest(point);
    const Vec2& uv = near.parameters;
    const std::optional<Vec3> normal = cutting_setup_.patch.unit_normal(uv.x(), uv.y());
    if (!normal || (!cutting_setup_.trim.everything() && !cutting_setup_.trim.contains(uv))) {
        return std::nullopt;
    }
    const Vec3 away = point - near.position;
    const double height = (cutting_setup_.flipped ? -1.0 : 1.0) * away.dot(*normal);
    const double aside = (away - away.dot(*normal) * *normal).norm();
    // Inside of the face the way to the closest point is the normal; from its border it leads beside it.
    constexpr double most_aside = 0.1, always = 1e-3; // share of the distance; mm
    return aside <= most_aside * near.distance + always ? std::optional(height) : std::nullopt;
}

std::vector<std::optional<double>> PartHeights::of(const simulation::CutMesh& mesh,
                                                   const Progress& progress) const {
    std::vector<std::optional<double>> heights(mesh.points.size());
    constexpr std::ptrdiff_t points_per_chunk = 256;
    parallel_for(std::ssize(heights), points_per_chunk, [&](std::ptrdiff_t n) {
        const auto k = static_cast<std::size_t>(n);
        if (n % points_per_chunk == 0) {
            progress.check();
        }
        const std::optional<double> height = at(mesh.points[k]);
        const bool underside = mesh.moves[k] == simulation::stock_surface && height && *height < 0.0;
        heights[k] = underside ? std::nullopt : height;
    });
    return heights;
}

} // namespace millwright::plan
