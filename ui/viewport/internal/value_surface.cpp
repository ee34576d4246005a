#include "ui/viewport/internal/value_surface.h"

#include "core/base/numbers.h"
#include "ui/render/convert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace millwright::viewport {

namespace {

constexpr int most_cells = 30000; // of the mesh; about 40 ms without a graphics card
constexpr int most_per_cell = 6;  // of the net

/// A mesh of `fine` x `fine` cells in every cell of the net.
class Builder {
public:
    Builder(const geometry::BezierPatch& patch,
            const geometry::Trim& trim,
            const grid::NodeArray& nodes,
            std::span<const double> values)
        : patch_(patch), trim_(trim), array_(nodes), values_(values) {
        const int cells = std::max((array_.rows - 1) * (array_.columns - 1), 1);
        fine_ = std::clamp(static_cast<int>(std::sqrt(most_cells / cells)), 1, most_per_cell);
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
                add({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
                add({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
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
        places_.push_back(uv);
        const double value = mix(mix(value_at(i, j), value_at(i, j + 1), t),
                                 mix(value_at(i + 1, j), value_at(i + 1, j + 1), t),
                                 s);
        normal_ = patch_.unit_normal(uv.x(), uv.y()).value_or(normal_);
        return {.position = render::to_float(patch_.position(uv.x(), uv.y())),
                .normal = render::to_float(normal_),
                .value = static_cast<float>(value)};
    }

    void add(const std::array<std::uint32_t, 3>& corners) {
        const Vec2 middle = (places_[corners[0]] + places_[corners[1]] + places_[corners[2]]) / 3.0;
        if (trim_.contains(middle)) {
            triangles_.insert(triangles_.end(), corners.begin(), corners.end());
        }
    }

    [[nodiscard]] double value_at(int i, int j) const { return values_[array_.index(i, j)]; }

    const geometry::BezierPatch& patch_;
    const geometry::Trim& trim_;
    const grid::NodeArray& array_;
    std::span<const double> values_;
    int fine_ = 1;
    Vec3 normal_ = Vec3::UnitZ(); ///< of the last vertex that had one
    std::vector<Vec2> places_;    ///< in the parameters, one a vertex
    std::vector<render::MeshVertex> vertices_;
    std::vector<std::uint32_t> triangles_;
};

} // namespace

render::MeshBuffer value_surface(const geometry::BezierPatch& patch,
                                 const geometry::Trim& trim,
                                 const grid::NodeArray& nodes,
                                 std::span<const double> values) {
    return Builder(patch, trim, nodes, values).build();
}

} // namespace millwright::viewport
