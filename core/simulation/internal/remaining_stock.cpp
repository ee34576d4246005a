#include "core/simulation/internal/remaining_stock.h"

#include "core/simulation/collision_bodies.h"
#include "core/simulation/cut_mesh.h"
#include "core/simulation/internal/stock_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace millwright::simulation {

namespace {

constexpr std::size_t most_triangles = 400'000;

std::shared_ptr<const CollisionMesh> moved_mesh(CollisionTriangles surface, const Vec3& origin) {
    if (surface.triangles.empty()) {
        return nullptr;
    }
    for (Vec3& point : surface.points) {
        point += origin;
    }
    return std::make_shared<const CollisionMesh>(std::move(surface));
}

} // namespace

RemainingStock::RemainingStock(const SimulationInput& input, const Progress& progress)
    : origin_(input.machine.workpiece_origin()),
      simulator_(input, Rewind::none, progress), surface_{moved_mesh(surface_of(input.stock), origin_),
                                                          versions()},
      blocks_(surface_) {}

RemainingStock::Versions RemainingStock::versions() const {
    Versions found;
    for (int k = 0; k < 3; ++k) {
        for (const Tile& tile : simulator_.field().tiles(k)) {
            found.at(static_cast<std::size_t>(k)).push_back(tile.version);
        }
    }
    return found;
}

bool RemainingStock::is_current_near(const Vec3& place, Shape shape) const {
    const DexelField& field = simulator_.field();
    const Made& made = shape == Shape::surface ? surface_ : blocks_;
    const double around = 2.0 * made.stride; // cells: a corner of the mesh is made of lines beside it
    const auto tiles_at = [&](int axis, int count) {
        const double at = (place[axis] - field.box().min()[axis]) / field.cell()[axis];
        const double last = count - 1;
        return std::array<int, 2>{
            static_cast<int>(std::clamp(std::floor((at - around) / Tile::side), 0.0, last)),
            static_cast<int>(std::clamp(std::floor((at + around) / Tile::side), 0.0, last))};
    };
    for (int k = 0; k < 3; ++k) {
        const auto [columns, rows] = field.tile_count(k);
        const auto [i0, i1] = tiles_at((k + 1) % 3, columns);
        const auto [j0, j1] = tiles_at((k + 2) % 3, rows);
        const auto& known = made.versions.at(static_cast<std::size_t>(k));
        for (int j = j0; j <= j1; ++j) {
            for (int i = i0; i <= i1; ++i) {
                const std::size_t number = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                                           static_cast<std::size_t>(i);
                if (known[number] != field.tile(k, i, j).version) {
                    return false;
                }
            }
        }
    }
    return true;
}

void RemainingStock::renew(Shape shape, const Progress& progress) {
    const DexelField& field = simulator_.field();
    if (shape == Shape::surface) {
        CutMesh made = mesh_of(field, most_triangles, progress);
        surface_ = {moved_mesh({std::move(made.points), std::move(made.triangles)}, origin_),
                    versions(),
                    made.stride};
    } else {
        StockBlocks made = blocks_of(field, most_triangles, blocks_.stride, progress);
        blocks_ = {moved_mesh(std::move(made.surface), origin_), versions(), made.stride};
    }
}

} // namespace millwright::simulation
