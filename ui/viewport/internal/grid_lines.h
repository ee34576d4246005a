// Which lines of a grid a picture has room for: those of 500 x 500 nodes would be one dark area.
#pragma once

#include "ui/render/view.h"
#include "ui/viewport/scene.h"

#include <glm/mat4x4.hpp>

#include <string>
#include <vector>

namespace millwright::viewport {

/// Every n-th line of the grid, by what stays the same on it; first and last are always among them.
struct GridLines {
    int each_row = 1;
    int each_column = 1;

    [[nodiscard]] bool all() const { return each_row == 1 && each_column == 1; }
    friend bool operator==(const GridLines&, const GridLines&) = default;
};

/// So many that neighbours are `least_gap_px` (content scale 1) apart in the mean. `s_T_w`: workpiece to
/// scene.
inline constexpr double least_gap_px = 6.0;
[[nodiscard]] GridLines readable_lines(const grid::NodeArray& nodes,
                                       const geometry::ParametricSurface& patch,
                                       const render::View& view,
                                       const glm::dmat4& s_T_w);

/// 0, each, 2 each ... and `count` - 1.
[[nodiscard]] std::vector<int> line_numbers(int count, int each);

/// The nodes of the grid that the scene shows; null where it shows none.
[[nodiscard]] const grid::NodeArray* shown_nodes(const Scene& scene);

/// "51 x 51 of 500 x 500 grid lines are drawn"; empty where all of them are.
[[nodiscard]] std::string grid_lines_note(const Scene& scene, const render::View& view);

} // namespace millwright::viewport
