#include "core/plan/weight_map.h"

#include "core/base/error.h"
#include "core/grid/elliptic_adaptation.h"
#include "core/plan/grids.h"
#include "core/project/grid_methods/chosen_weight.h"

#include <algorithm>
#include <utility>

namespace millwright::plan {

namespace {

constexpr int raster = 97; // points per side: finer than the eye asks of a smooth field

/// As solvers of the elliptic grid begin with it, but for the region.
grid::WeightPtr weight_at_start(const project::GridInput& input,
                                const CuttingSetup& cutting_setup,
                                const Progress& progress) {
    if (!needs_error(input.elliptic)) {
        return chosen_weight(input, cutting_setup.patch, nullptr);
    }
    const grid::EllipticAdaptationSettings settings{.direction = input.direction};
    const grid::Grid uniform = grid::Grid::uniform(input.nu, input.nv);
    const std::vector<grid::MoveError> moves =
        grid::measure(cutting_setup.error_model(), uniform, input.direction, settings.sampling, progress);
    std::vector<double> density = grid::error_density(uniform, input.direction, moves);
    if (input.elliptic.weight != project::WeightSource::error) {
        return chosen_weight(input, cutting_setup.patch, grid::weight_on(uniform, density));
    }
    return grid::weight_on(
        uniform, grid::scaled_weight(std::move(density), input.nu, input.nv, settings.error_weight));
}

/// The same where it counts.
grid::WeightPtr weight_in_region(const project::GridInput& input,
                                 const CuttingSetup& cutting_setup,
                                 const Progress& progress) {
    grid::WeightPtr weight = weight_at_start(input, cutting_setup, progress);
    const grid::WeightPtr share = region_weight(input, cutting_setup.patch);
    if (share == nullptr) {
        return weight;
    }
    const grid::NodeArray nodes =
        grid::to_solver_coordinates(grid::Grid::uniform(input.nu, input.nv).array());
    const double least = std::ranges::min(grid::weight_at_nodes(*weight, nodes));
    return grid::within(std::move(weight), share, least);
}

/// `rows` x `columns` places spread evenly over the solver coordinates of the grid.
WeightMap sampled(const grid::Weight& weight, const project::GridInput& input, int rows, int columns) {
    std::vector<Vec2> places;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const Vec2 uv(static_cast<double>(i) / (rows - 1), static_cast<double>(j) / (columns - 1));
            places.push_back(uv.cwiseProduct(Vec2(input.nu - 1, input.nv - 1)));
        }
    }
    WeightMap map{.rows = rows, .columns = columns, .values = std::vector<double>(places.size())};
    weight.values(places, map.values);
    const auto [least, largest] = std::ranges::minmax_element(map.values);
    map.low = *least;
    map.high = *largest;
    return map;
}

} // namespace

WeightMap
weight_map(const project::GridInput& input, const CuttingSetup& cutting_setup, const Progress& progress) {
    const grid::WeightPtr weight = weight_in_region(input, cutting_setup, progress);
    try {
        return sampled(*weight, input, raster, raster);
    } catch (const Error&) { // such as 1 / abs(u - 1/3): the grid may have no node there
        return sampled(*weight, input, input.nu, input.nv);
    }
}

} // namespace millwright::plan
