// Parts on machines, carried to their errors, as scenes for tests of the 3D view.
#pragma once

#include "core/geometry/presets.h"
#include "core/plan/evaluation.h"
#include "tests/support/machines.h"
#include "ui/viewport/scene.h"

#include <cmath>
#include <memory>
#include <string>

namespace millwright::test {

struct Part {
    std::string preset = "dome";
    std::string machine = "rotary-tilt-listing";
    int nodes = 12;
};

inline const Part dome{};
inline const Part two_bell{"two-bell", "ac-table", 12};

inline plan::CuttingSetup cutting_setup(const Part& part) {
    return {.patch = geometry::surface_preset(part.preset).make().patch(geometry::PatchId{0}),
            .machine = machine(part.machine)};
}

/// A grid with its nodes drawn towards the borders, where the uniform one has none.
inline grid::Grid bent_grid(int nodes) {
    grid::NodeArray array(nodes, nodes);
    const auto bent = [nodes](int k) {
        const double t = static_cast<double>(k) / (nodes - 1);
        return t - 0.12 * std::sin(4.0 * std::acos(0.0) * t);
    };
    for (int i = 0; i < nodes; ++i) {
        for (int j = 0; j < nodes; ++j) {
            array.at(i, j) = {bent(i), bent(j)};
        }
    }
    return grid::Grid(array);
}

inline std::shared_ptr<const plan::Evaluation> evaluation(const plan::CuttingSetup& cutting_setup,
                                                          grid::Grid grid) {
    return std::make_shared<const plan::Evaluation>(
        plan::evaluate(cutting_setup, {.grid = std::move(grid), .note = {}}, {8}, Progress()));
}

/// Everything there is, on the uniform grid.
inline viewport::Scene scene_of(const Part& part, viewport::ViewKind kind) {
    viewport::Scene scene;
    const plan::CuttingSetup made = cutting_setup(part);
    scene.layers = viewport::layers_of(kind);
    scene.surface = std::make_shared<const geometry::Surface>(geometry::surface_preset(part.preset).make());
    scene.singular_points = toolpath::singular_points(made.patch, made.machine);
    scene.shown = evaluation(made, grid::Grid::uniform(part.nodes, part.nodes));
    scene.start = scene.shown;
    scene.cutting_setup = std::make_shared<const plan::CuttingSetup>(made);
    return scene;
}

/// Half way through the path.
inline viewport::Moment half_way(const viewport::Scene& scene) {
    const auto& positions = scene.shown->axes.positions;
    const std::size_t middle = positions.size() / 2;
    return {.axes = positions[middle], .move = static_cast<int>(middle), .fraction = 0.0};
}

} // namespace millwright::test
