#include "ui/viewport/internal/grid_lines.h"

#include "ui/render/convert.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace millwright::viewport {

namespace {

constexpr int samples = 12; // cells along each direction in which the picture of the grid is measured

/// The grid as it lies in the picture, px: its area, and the lengths of a row and of a column in the mean.
struct Measured {
    double area = 0.0;
    double row_length = 0.0;
    double column_length = 0.0;
};

using Pixels = std::optional<glm::dvec2>;

class Sampled {
public:
    Sampled(const grid::NodeArray& nodes,
            const geometry::ParametricSurface& patch,
            const render::View& view,
            const glm::dmat4& s_T_w) {
        for (int a = 0; a <= samples; ++a) {
            for (int b = 0; b <= samples; ++b) {
                const Vec2& uv = nodes.at(a * (nodes.rows - 1) / samples, b * (nodes.columns - 1) / samples);
                const glm::dvec4 place(render::to_glm(patch.position(uv.x(), uv.y())), 1.0);
                const auto seen = render::project(view, glm::dvec3(s_T_w * place));
                at(a, b) = seen ? Pixels(seen->pixel) : std::nullopt;
            }
        }
    }

    [[nodiscard]] Measured measured() const {
        Measured found;
        for (int a = 0; a < samples; ++a) {
            for (int b = 0; b < samples; ++b) {
                add_cell(found, at(a, b), at(a + 1, b), at(a, b + 1));
            }
        }
        found.row_length /= samples;
        found.column_length /= samples;
        return found;
    }

private:
    static void add_cell(Measured& found, const Pixels& corner, const Pixels& below, const Pixels& beside) {
        if (corner && below && beside) {
            const glm::dvec2 along_column = *below - *corner;
            const glm::dvec2 along_row = *beside - *corner;
            found.area += std::abs(along_column.x * along_row.y - along_column.y * along_row.x);
            found.column_length += glm::length(along_column);
            found.row_length += glm::length(along_row);
        }
    }

    [[nodiscard]] Pixels& at(int a, int b) { return seen_[static_cast<std::size_t>(a * (samples + 1) + b)]; }
    [[nodiscard]] const Pixels& at(int a, int b) const {
        return seen_[static_cast<std::size_t>(a * (samples + 1) + b)];
    }

    std::array<Pixels, (samples + 1) * (samples + 1)> seen_;
};

/// The least of 1, 2, 5, 10, 20 ... with which the lines are far enough apart.
int each_for(double area, double length, int lines, double least_gap) {
    const double gap = length > 0.0 ? area / (length * std::max(lines - 1, 1)) : least_gap;
    int power = 1;
    while (power < lines) {
        for (const int step : {1, 2, 5}) {
            if (step * power * gap >= least_gap) {
                return step * power;
            }
        }
        power *= 10;
    }
    return power;
}

} // namespace

GridLines readable_lines(const grid::NodeArray& nodes,
                         const geometry::ParametricSurface& patch,
                         const render::View& view,
                         const glm::dmat4& s_T_w) {
    const Measured found = Sampled(nodes, patch, view, s_T_w).measured();
    const double least = least_gap_px * view.content_scale;
    return {.each_row = each_for(found.area, found.row_length, nodes.rows, least),
            .each_column = each_for(found.area, found.column_length, nodes.columns, least)};
}

std::vector<int> line_numbers(int count, int each) {
    std::vector<int> numbers;
    for (int k = 0; k < count - 1; k += each) {
        numbers.push_back(k);
    }
    numbers.push_back(count - 1);
    return numbers;
}

const grid::NodeArray* shown_nodes(const Scene& scene) {
    if (!scene.layers.grid.shown || !scene.cutting_setup) {
        return nullptr;
    }
    if (scene.watched) {
        return &scene.watched->current;
    }
    return scene.shown ? &scene.shown->outcome.grid.array() : nullptr;
}

std::string grid_lines_note(const Scene& scene, const render::View& view) {
    const grid::NodeArray* nodes = shown_nodes(scene);
    if (nodes == nullptr) {
        return {};
    }
    const glm::dmat4 s_T_w = render::to_glm(scene_from_workpiece(scene));
    const GridLines lines = readable_lines(*nodes, scene.cutting_setup->patch, view, s_T_w);
    if (lines.all()) {
        return {};
    }
    const auto times = [](std::size_t a, std::size_t b) {
        return std::to_string(a) + " \u00D7 " + std::to_string(b);
    };
    return times(line_numbers(nodes->rows, lines.each_row).size(),
                 line_numbers(nodes->columns, lines.each_column).size()) +
           " of " + times(static_cast<std::size_t>(nodes->rows), static_cast<std::size_t>(nodes->columns)) +
           " grid lines are displayed";
}

} // namespace millwright::viewport
