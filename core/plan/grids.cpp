#include "core/plan/grids.h"

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/numbers.h"
#include "core/base/sentences.h"
#include "core/grid/chain_optimiser.h"
#include "core/grid/elliptic_adaptation.h"
#include "core/grid/expression_weight.h"
#include "core/grid/redistribution.h"
#include "core/grid/track_optimiser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::plan {

namespace {

int nodes_per_track(const project::GridInput& input) {
    return input.direction == grid::TrackDirection::along_v ? input.nv : input.nu;
}

grid::TrackSettings track_settings(const project::GridInput& input, Effort effort) {
    grid::TrackSettings settings =
        effort == Effort::live ? grid::quick_track_settings() : grid::TrackSettings{};
    settings.error_exponent = input.tracks.error_exponent;
    settings.axis_weight_mm_per_deg = input.tracks.axis_weight;
    if (effort == Effort::full) {
        settings.lattice = input.tracks.lattice;
        settings.polish_sweeps = input.tracks.polish_sweeps;
    }
    if (settings.lattice > 0) {
        settings.lattice = std::max(settings.lattice, nodes_per_track(input));
    }
    return settings;
}

grid::ChainSettings chain_settings(const project::GridInput& input) {
    grid::ChainSettings settings;
    settings.tracks.error_exponent = input.tracks.error_exponent;
    settings.tracks.axis_weight_mm_per_deg = input.tracks.axis_weight;
    settings.tracks.polish_sweeps = input.tracks.polish_sweeps;
    settings.tracks.gap_allowance = input.chain.gap_percent / 100.0;
    settings.tracks.lattice =
        input.tracks.lattice > 0 ? std::max(input.tracks.lattice, nodes_per_track(input)) : 0;
    settings.first_descent = input.chain.first_iterations;
    settings.later_descents = input.chain.later_iterations;
    return settings;
}

using PatchPtr = std::shared_ptr<const geometry::BezierPatch>;

grid::WeightPtr
weight_of_formula(const project::GridInput& input, const PatchPtr& patch, const grid::WeightPtr& error) {
    try {
        return grid::expression_weight(input.elliptic.expression, input.nu, input.nv, {patch, error});
    } catch (const Error& fault) {
        Diagnostic found = fault.diagnostic();
        found.message = "grid/elliptic/expression, character " + std::to_string(found.place.column) + ": " +
                        found.message;
        found.place = {}; // it counts in the formula, not in a file
        throw Error(std::move(found));
    }
}

grid::WeightPtr
mixed_weight_of(const project::GridInput& input, const PatchPtr& patch, const grid::WeightPtr& error) {
    const grid::MixSettings& mix = input.elliptic.mix;
    grid::MixedReasons reasons;
    reasons.error = error;
    if (mix.curvature > 0.0) {
        reasons.curvature = grid::curvature_weight(*patch, input.nu, input.nv);
    }
    if (mix.painted > 0.0) {
        reasons.painted = input.elliptic.painted
                              ? grid::field_weight(*input.elliptic.painted, input.nu, input.nv)
                              : grid::constant_weight(0.0);
    }
    if (mix.expression > 0.0) {
        reasons.expression = weight_of_formula(input, patch, error);
    }
    return grid::mixed_weight(reasons, mix, input.nu, input.nv);
}

/// Of the elliptic grid, or of the harmonic map.
grid::EllipticAdaptationSettings adaptation_settings(project::GridMethod method,
                                                     const project::GridInput& input,
                                                     const geometry::BezierPatch& patch) {
    grid::EllipticAdaptationSettings settings = method == project::GridMethod::harmonic
                                                    ? grid::harmonic_settings()
                                                    : grid::EllipticAdaptationSettings{};
    if (method == project::GridMethod::elliptic) {
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

std::unique_ptr<grid::GridImprover> make_adaptation(project::GridMethod method,
                                                    const project::GridInput& input,
                                                    const toolpath::KinematicError& error,
                                                    const grid::Grid& start) {
    const grid::EllipticAdaptationSettings settings = adaptation_settings(method, input, error.patch());
    if (input.elliptic.weight == project::WeightSource::error) {
        return std::make_unique<grid::EllipticAdaptation>(error, start, settings);
    }
    if (!needs_error(input.elliptic)) {
        return std::make_unique<grid::EllipticAdaptation>(
            error, start, settings, chosen_weight(input, error.patch(), nullptr));
    }
    return std::make_unique<grid::EllipticAdaptation>(
        error, start, settings, [input, patch = error.patch()](const grid::WeightPtr& density) {
            return chosen_weight(input, patch, density);
        });
}

/// Bytes, at most; nothing where nobody knows.
std::optional<std::size_t> memory_of(project::GridMethod method, const project::GridInput& input) {
    if (method != project::GridMethod::elliptic && method != project::GridMethod::harmonic) {
        return std::nullopt;
    }
    return grid::memory_bytes(method == project::GridMethod::harmonic ? grid::EllipticMethod::harmonic
                                                                      : input.elliptic.solver,
                              input.nu,
                              input.nv);
}

double megabytes(std::size_t bytes) {
    constexpr double bytes_a_megabyte = 1e6;
    return std::ceil(static_cast<double>(bytes) / bytes_a_megabyte);
}

} // namespace

bool needs_error(const project::EllipticInput& input) {
    const auto formula_needs_it = [&] { return grid::speaks_of_error(input.expression); };
    switch (input.weight) {
    case project::WeightSource::error:
        return true;
    case project::WeightSource::expression:
        return formula_needs_it();
    case project::WeightSource::mixed:
        return input.mix.error > 0.0 || (input.mix.expression > 0.0 && formula_needs_it());
    case project::WeightSource::w1:
    case project::WeightSource::w2:
    case project::WeightSource::w3:
    case project::WeightSource::w4:
        break;
    }
    return false;
}

grid::WeightPtr chosen_weight(const project::GridInput& input,
                              const geometry::BezierPatch& patch,
                              const grid::WeightPtr& error) {
    if (needs_error(input.elliptic) && error == nullptr) {
        return nullptr;
    }
    const auto shared = [&] { return std::make_shared<const geometry::BezierPatch>(patch); };
    switch (input.elliptic.weight) {
    case project::WeightSource::error:
        return error;
    case project::WeightSource::expression:
        return weight_of_formula(input, shared(), error);
    case project::WeightSource::mixed:
        return mixed_weight_of(input, shared(), error);
    case project::WeightSource::w1:
        return grid::weight_w1();
    case project::WeightSource::w2:
        return grid::weight_w2(input.nu);
    case project::WeightSource::w3:
        return grid::weight_w3(input.nu, input.nv);
    case project::WeightSource::w4:
        return grid::weight_w4();
    }
    return nullptr;
}

grid::WeightPtr region_weight(const project::GridInput& input, const geometry::BezierPatch& patch) {
    return input.elliptic.region.everywhere()
               ? nullptr
               : grid::field_weight(grid::share_of(input.elliptic.region, patch), input.nu, input.nv);
}

bool paint_weight(project::EllipticInput& input,
                  const geometry::BezierPatch& patch,
                  const Vec2& from,
                  const Vec2& to,
                  const grid::Brush& brush) {
    if (!input.painted) {
        input.painted = grid::Field::constant(project::fresh_painted, project::fresh_painted, 0.0);
    }
    return from == to ? grid::dab(*input.painted, patch, from, brush)
                      : grid::stroke(*input.painted, patch, from, to, brush);
}

void let_paint_count(project::EllipticInput& input) {
    if (input.weight == project::WeightSource::expression) {
        input.mix.error = 0.0;
        input.mix.expression = std::max(input.mix.expression, 1.0);
    }
    input.weight = project::WeightSource::mixed;
    if (!(input.mix.painted > 0.0)) {
        input.mix.painted = 1.0;
    }
}

std::string memory_sentence(project::GridMethod method, const project::GridInput& input) {
    const std::optional<std::size_t> bytes = memory_of(method, input);
    return !bytes ? std::string()
                  : fmt::format("The {} of {} x {} nodes needs up to {:.0f} MB",
                                method == project::GridMethod::harmonic ? "harmonic map" : "elliptic grid",
                                input.nu,
                                input.nv,
                                megabytes(*bytes));
}

std::optional<Diagnostic> memory_fault(project::GridMethod method,
                                       const project::GridInput& input,
                                       const std::optional<std::size_t>& free) {
    const std::optional<std::size_t> bytes = memory_of(method, input);
    if (!bytes || !free || *bytes <= *free / 2) {
        return std::nullopt;
    }
    return Diagnostic{{},
                      fmt::format("{}, more than half of the {:.0f} MB of free memory",
                                  memory_sentence(method, input),
                                  megabytes(*free)),
                      "use fewer nodes or another solver, or allow it: grid/elliptic/any_memory, "
                      "--any-memory, \"Allow high memory\" in the Grid workspace"};
}

void expect_memory(project::GridMethod method, const project::GridInput& input) {
    if (auto fault = memory_fault(method, input, free_memory()); fault && !input.elliptic.any_memory) {
        throw Error(*std::move(fault));
    }
}

/// Throws Error for a solver that needs more nodes than the grid has.
void expect_enough_nodes(project::GridMethod method, const project::GridInput& input) {
    const grid::EllipticMethod solver = input.elliptic.solver;
    const bool has_stencil =
        solver == grid::EllipticMethod::reference || solver == grid::EllipticMethod::multigrid;
    constexpr int fewest = 3;
    if (method == project::GridMethod::elliptic && has_stencil && std::min(input.nu, input.nv) < fewest) {
        throw Error(fmt::format("the solver \"{}\" needs at least {} x {} nodes, but the grid has {} x {}",
                                project::row_of(project::elliptic_solvers(), solver).label,
                                fewest,
                                fewest,
                                input.nu,
                                input.nv),
                    {},
                    "use more nodes, or the minimiser (grid/elliptic/solver)");
    }
}

/// Throws Error where nodes are to slide along sides that `start` does not have.
void expect_straight_sides(const project::GridInput& input, const grid::Grid& start) {
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

/// Throws Error for tracks that bend, which only the elliptic grid and the harmonic map can start from.
void expect_straight_tracks(grid::TrackDirection direction, const grid::Grid& start) {
    const Eigen::Index across = direction == grid::TrackDirection::along_v ? 0 : 1;
    for (int t = 0; t < start.track_count(direction); ++t) {
        const double first = start.track_node(direction, t, 0)[across];
        for (int k = 1; k < start.nodes_per_track(direction); ++k) {
            if (!exactly_equal(start.track_node(direction, t, k)[across], first)) {
                throw Error(fmt::format("track {} of the start grid, counted from 0, is not straight", t),
                            {},
                            "use the elliptic grid or the harmonic map, which start from any grid");
            }
        }
    }
}

std::unique_ptr<grid::GridImprover> make_improver(project::GridMethod method,
                                                  const project::GridInput& input,
                                                  const toolpath::KinematicError& error,
                                                  Effort effort,
                                                  const std::optional<grid::Grid>& given) {
    expects(method != project::GridMethod::uniform, "the uniform grid is not optimised");
    expect_memory(method, input);
    expect_enough_nodes(method, input);
    grid::Grid start = given ? *given : grid::Grid::uniform(input.nu, input.nv);
    expects(start.nu() == input.nu && start.nv() == input.nv, "a start grid has nu x nv nodes");
    if (method == project::GridMethod::elliptic || method == project::GridMethod::harmonic) {
        expect_straight_sides(input, start);
        return make_adaptation(method, input, error, start);
    }
    expect_straight_tracks(input.direction, start);
    if (method == project::GridMethod::redistribution) {
        const grid::RedistributionSettings settings{.floor = input.redistribution.floor,
                                                    .smoothings = input.redistribution.smoothing_passes};
        return std::make_unique<grid::Redistribution>(error, start, input.direction, settings);
    }
    if (method == project::GridMethod::chain) {
        return std::make_unique<grid::ChainOptimiser>(
            error, std::move(start), input.direction, chain_settings(input));
    }
    return std::make_unique<grid::TrackOptimiser>(
        error, std::move(start), input.direction, track_settings(input, effort));
}

GridOutcome uniform_outcome(const project::GridInput& input) {
    return {grid::Grid::uniform(input.nu, input.nv)};
}

GridOutcome improved_outcome(grid::GridImprover& improver, const Progress& progress) {
    const grid::ImproverState state = grid::run(improver, progress);
    progress.report(1.0);
    return {state.best,
            state.status,
            state.round,
            state.iteration,
            state.norm,
            state.start,
            state.of_best,
            state.note,
            state.warning,
            state.links,
            state.norms};
}

std::string_view title_of_making(project::GridMethod method) {
    switch (method) {
    case project::GridMethod::uniform:
        return "Measuring the uniform grid";
    case project::GridMethod::redistribution:
        return "Redistributing the nodes of each track";
    case project::GridMethod::elliptic:
        return "Adapting the elliptic grid";
    case project::GridMethod::harmonic:
        return "Computing the harmonic map";
    case project::GridMethod::tracks:
        return "Optimising the tracks";
    case project::GridMethod::chain:
        return "Moving all nodes at once";
    }
    return {};
}

} // namespace millwright::plan
