// The elliptic grid and the harmonic map: nodes that follow a weight.
#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/grid/elliptic_adaptation.h"
#include "core/project/grid_methods/chosen_weight.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/setting_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::project {

namespace {

/// Of the elliptic grid, or of the harmonic map.
grid::EllipticAdaptationSettings
adaptation_settings(GridMethod method, const GridInput& input, const geometry::ParametricSurface& patch) {
    grid::EllipticAdaptationSettings settings =
        method == GridMethod::harmonic ? grid::harmonic_settings() : grid::EllipticAdaptationSettings{};
    if (method == GridMethod::elliptic) {
        settings.method = input.elliptic.solver;
        settings.functional = {.adaptation = input.elliptic.adaptation,
                               .orthogonality = input.elliptic.orthogonality};
    }
    settings.direction = input.direction;
    settings.region = region_weight(input, patch);
    settings.boundary = input.elliptic.sliding_boundary ? grid::Boundary::sliding : grid::Boundary::fixed;
    settings.relaxation = input.elliptic.relaxation;
    settings.tolerance = input.elliptic.tolerance;
    settings.max_iterations = input.elliptic.max_iterations;
    settings.max_rounds = input.elliptic.max_rounds;
    settings.error_change = input.elliptic.error_change;
    settings.iterations_per_step = input.elliptic.iterations_per_step;
    return settings;
}

std::unique_ptr<grid::GridOptimiser> make_adaptation(GridMethod method,
                                                     const GridInput& input,
                                                     const toolpath::KinematicError& error,
                                                     const grid::Grid& start) {
    const grid::EllipticAdaptationSettings settings = adaptation_settings(method, input, error.patch());
    if (input.elliptic.weight == WeightSource::error) {
        return std::make_unique<grid::EllipticAdaptation>(error, start, settings);
    }
    if (!needs_error(input.elliptic)) {
        return std::make_unique<grid::EllipticAdaptation>(
            error, start, settings, chosen_weight(input, error.patch(), nullptr));
    }
    return std::make_unique<grid::EllipticAdaptation>(
        error, start, settings, [input, patch = error.patch().shared()](const grid::WeightPtr& density) {
            return chosen_weight(input, *patch, density);
        });
}

/// Throws Error for a solver that needs more nodes than the grid has.
void expect_enough_nodes(const GridInput& input) {
    const grid::EllipticMethod solver = input.elliptic.solver;
    const bool has_stencil =
        solver == grid::EllipticMethod::reference || solver == grid::EllipticMethod::multigrid;
    constexpr int fewest = 3;
    if (has_stencil && std::min(input.nu, input.nv) < fewest) {
        throw Error(fmt::format("the solver \"{}\" needs at least {} x {} nodes, but the grid has {} x {}",
                                row_of(elliptic_solvers(), solver).label,
                                fewest,
                                fewest,
                                input.nu,
                                input.nv),
                    {},
                    "use more nodes, or the minimiser (grid/elliptic/solver)");
    }
}

/// Throws Error where nodes are to slide along sides that `start` does not
/// have.
void expect_straight_sides(const GridInput& input, const grid::Grid& start) {
    if (!input.elliptic.sliding_boundary) {
        return;
    }
    const auto is = [](double value, double wanted) { return exactly_equal(value, wanted); };
    const int last_u = start.nu() - 1, last_v = start.nv() - 1;
    bool straight = true;
    for (int i = 0; i <= last_u; ++i) {
        straight = straight && is(start.node(i, 0).y(), 0.0) && is(start.node(i, last_v).y(), 1.0);
    }
    for (int j = 0; j <= last_v; ++j) {
        straight = straight && is(start.node(0, j).x(), 0.0) && is(start.node(last_u, j).x(), 1.0);
    }
    if (!straight) {
        throw Error("the boundary of the start grid is not the boundary of the surface, so its nodes cannot "
                    "slide along it",
                    {},
                    "fix the boundary: set grid/elliptic/sliding_boundary to false");
    }
}

/// For the harmonic map, which has no LV, no LO and its own solver.
bool same_metric(EllipticInput a, const EllipticInput& b) {
    a.solver = b.solver;
    a.adaptation = b.adaptation;
    a.orthogonality = b.orthogonality;
    return a == b;
}

std::unique_ptr<grid::GridOptimiser> elliptic_grid(GridStart from) {
    expect_enough_nodes(from.input);
    expect_straight_sides(from.input, from.start);
    return make_adaptation(GridMethod::elliptic, from.input, from.error, from.start);
}

std::unique_ptr<grid::GridOptimiser> harmonic_map(GridStart from) {
    expect_straight_sides(from.input, from.start);
    return make_adaptation(GridMethod::harmonic, from.input, from.error, from.start);
}

} // namespace

constinit const GridMethodRow elliptic_row{
    .id = "elliptic",
    .label = "Elliptic",
    .tip = "Brackbill-Saltzman elliptic grid, weighted by the error",
    .report_key = "adapted",
    .short_name = "Elliptic",
    .caption = "adapted",
    .title = "Adapting the elliptic grid",
    .share = 0.4,
    .compared = true,
    .uses_weight = true,
    .same_settings = [](const GridInput& a, const GridInput& b) { return a.elliptic == b.elliptic; },
    .memory =
        [](const GridInput& input) { return grid::memory_bytes(input.elliptic.solver, input.nu, input.nv); },
    .grid_name = "elliptic grid",
    .optimiser = elliptic_grid};

constinit const GridMethodRow harmonic_row{
    .id = "harmonic",
    .label = "Harmonic map",
    .tip = "Uses the weight as a metric along the tracks; the tracks move together less than their nodes do",
    .report_key = "harmonic",
    .short_name = "Harmonic",
    .caption = "harmonic map",
    .title = "Computing the harmonic map",
    .share = 0.4,
    .uses_weight = true,
    .same_settings = [](const GridInput& a,
                        const GridInput& b) { return same_metric(a.elliptic, b.elliptic); },
    .memory =
        [](const GridInput& input) {
            return grid::memory_bytes(grid::EllipticMethod::harmonic, input.nu, input.nv);
        },
    .grid_name = "harmonic map",
    .optimiser = harmonic_map};

} // namespace millwright::project
