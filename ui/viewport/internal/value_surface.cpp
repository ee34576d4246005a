#include "ui/viewport/internal/value_surface.h"

#include "core/base/numbers.h"
#include "core/geometry/mesh.h"
#include "ui/render/convert.h"
#include "ui/viewport/internal/net_outline.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::viewport {

namespace {

constexpr int most_cells = 30000; // of the mesh; about 40 ms without a graphics card
constexpr int most_per_cell = 6;  // of the net

/// Of the values at the nodes, spread over the cell that `at` lies in, in the net's own parameters.
double value_on_net(const grid::NodeArray& nodes, std::span<const double> values, const Vec2& at) {
    const double row = at.x() * (nodes.rows - 1), column = at.y() * (nodes.columns - 1);
    const int i = std::clamp(static_cast<int>(row), 0, nodes.rows - 2);
    const int j = std::clamp(static_cast<int>(column), 0, nodes.columns - 2);
    const auto value = [&](int r, int c) { return values[nodes.index(r, c)]; };
    return mix(mix(value(i, j), value(i, j + 1), column - j),
               mix(value(i + 1, j), value(i + 1, j + 1), column - j),
               row - i);
}

} // namespace

render::MeshBuffer value_surface(const geometry::ParametricSurface& patch,
                                 const geometry::Trim& trim,
                                 const grid::NodeArray& nodes,
                                 std::span<const double> values) {
    const int rows = nodes.rows - 1, columns = nodes.columns - 1;
    const int fine =
        std::clamp(static_cast<int>(std::sqrt(most_cells / std::max(rows * columns, 1))), 1, most_per_cell);
    const geometry::TrimmedSquare square =
        geometry::trimmed_square(trim_on_net(trim, nodes, fine), rows * fine, columns * fine);
    std::vector<render::MeshVertex> vertices;
    Vec3 normal = Vec3::UnitZ(); // of the last vertex that had one
    for (const Vec2& at : square.places) {
        const Vec2 uv = place_on_net(nodes, at);
        normal = patch.unit_normal(uv.x(), uv.y()).value_or(normal);
        vertices.push_back({.position = render::to_float(patch.position(uv.x(), uv.y())),
                            .normal = render::to_float(normal),
                            .value = static_cast<float>(value_on_net(nodes, values, at))});
    }
    std::vector<std::uint32_t> triangles;
    for (const auto& corners : square.inside) {
        for (const int corner : corners) {
            triangles.push_back(static_cast<std::uint32_t>(corner));
        }
    }
    return {vertices, triangles};
}

} // namespace millwright::viewport
