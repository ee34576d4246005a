#include "ui/viewport/internal/error_surface.h"

#include "ui/viewport/internal/value_surface.h"

#include <algorithm>
#include <vector>

namespace millwright::viewport {

namespace {

/// [nu x nv], row-major like the grid.
std::vector<double> node_errors(const plan::Evaluation& shown) {
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

} // namespace

render::MeshBuffer error_surface(const plan::CuttingSetup& cutting_setup, const plan::Evaluation& shown) {
    return value_surface(
        cutting_setup.patch, cutting_setup.trim, shown.outcome.grid.array(), node_errors(shown));
}

} // namespace millwright::viewport
