#include "ui/viewport/internal/error_surface.h"

#include "core/base/numbers.h"
#include "ui/render/convert.h"

#include <algorithm>
#include <cmath>

namespace millwright::viewport {

namespace {

constexpr int most_cells = 30000; // of the mesh; about 40 ms without a graphics card
constexpr int most_per_grid_cell = 6;

/// [nu x nv], row-major like the grid.
std::vector<double> node_errors(const project::Evaluation& shown) {
    const grid::NodeArray& array = shown.outcome.grid.array();
    std::vector<double> errors(array.nodes.size(), 0.0);
    const auto& points = shown.toolpath.points;
    for (std::size_t move = 0; move < shown.field.moves.size(); ++move) {
        const toolpath::MoveDeviation& deviation = shown.field.moves[move];
        if (deviation.kind != toolpath::MoveKind::track) {
            continue;
        }
        for (const toolpath::GridOrigin& end : {points[move].origin, points[move + 1].origin}) {
            double& error = errors[array.index(end.i, end.j)];
            error = std::max(error, deviation.closest);
        }
    }
    return errors;
}

/// A mesh of `fine` x `fine` cells in every cell of the grid.
class Builder {
public:
    Builder(const project::Workpiece& workpiece, const project::Evaluation& shown)
        : workpiece_(workpiece), array_(shown.outcome.grid.array()), errors_(node_errors(shown)) {
        const int cells = std::max((array_.rows - 1) * (array_.columns - 1), 1);
        fine_ = std::clamp(static_cast<int>(std::sqrt(most_cells / cells)), 1, most_per_grid_cell);
    }

    [[nodiscard]] render::MeshBuffer build() {
        const int rows = (array_.rows - 1) * fine_ + 1;
        const int columns = (array_.columns - 1) * fine_ + 1;
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                vertices_.push_back(vertex(r, c));
            }
        }
        const auto at = [&](int r, int c) { return static_cast<std::uint32_t>(r * columns + c); };
        for (int r = 0; r + 1 < rows; ++r) {
            for (int c = 0; c + 1 < columns; ++c) {
                triangles_.insert(triangles_.end(), {at(r, c), at(r + 1, c), at(r + 1, c + 1)});
                triangles_.insert(triangles_.end(), {at(r, c), at(r + 1, c + 1), at(r, c + 1)});
            }
        }
        return {vertices_, triangles_};
    }

private:
    [[nodiscard]] render::MeshVertex vertex(int r, int c) {
        const int i = std::min(r / fine_, array_.rows - 2);
        const int j = std::min(c / fine_, array_.columns - 2);
        const double s = static_cast<double>(r - i * fine_) / fine_;
        const double t = static_cast<double>(c - j * fine_) / fine_;
        const Vec2 low = (1.0 - t) * array_.at(i, j) + t * array_.at(i, j + 1);
        const Vec2 high = (1.0 - t) * array_.at(i + 1, j) + t * array_.at(i + 1, j + 1);
        const Vec2 uv = (1.0 - s) * low + s * high;
        const double error = mix(mix(error_at(i, j), error_at(i, j + 1), t),
                                 mix(error_at(i + 1, j), error_at(i + 1, j + 1), t),
                                 s);
        normal_ = workpiece_.patch.unit_normal(uv.x(), uv.y()).value_or(normal_);
        return {.position = render::to_float(workpiece_.patch.position(uv.x(), uv.y())),
                .normal = render::to_float(normal_),
                .value = static_cast<float>(error)};
    }

    [[nodiscard]] double error_at(int i, int j) const { return errors_[array_.index(i, j)]; }

    const project::Workpiece& workpiece_;
    const grid::NodeArray& array_;
    std::vector<double> errors_;
    int fine_ = 1;
    Vec3 normal_ = Vec3::UnitZ(); ///< of the last vertex that had one
    std::vector<render::MeshVertex> vertices_;
    std::vector<std::uint32_t> triangles_;
};

} // namespace

render::MeshBuffer error_surface(const project::Workpiece& workpiece, const project::Evaluation& shown) {
    return Builder(workpiece, shown).build();
}

} // namespace millwright::viewport
