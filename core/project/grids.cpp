#include "core/project/grids.h"

#include "core/base/error.h"
#include "core/grid/chain_optimiser.h"
#include "core/grid/elliptic_adaptation.h"
#include "core/grid/expression_weight.h"
#include "core/grid/track_optimiser.h"

#include <algorithm>
#include <utility>

namespace millwright::project {

namespace {

int nodes_per_track(const GridInput& input) {
    return input.direction == grid::TrackDirection::along_v ? input.nv : input.nu;
}

grid::TrackSettings track_settings(const GridInput& input, Effort effort) {
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

grid::ChainSettings chain_settings(const GridInput& input) {
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

grid::WeightPtr weight_of_formula(const GridInput& input) {
    try {
        return grid::expression_weight(input.elliptic.expression, input.nu, input.nv);
    } catch (const Error& error) {
        Diagnostic found = error.diagnostic();
        found.message = "grid/elliptic/expression, character " + std::to_string(found.place.column) + ": " +
                        found.message;
        found.place = {}; // it counts in the formula, not in a file
        throw Error(std::move(found));
    }
}

grid::EllipticAdaptationSettings elliptic_settings(const GridInput& input) {
    grid::EllipticAdaptationSettings settings;
    settings.direction = input.direction;
    settings.functional = {.adaptation = input.elliptic.adaptation,
                           .orthogonality = input.elliptic.orthogonality};
    settings.boundary = input.elliptic.sliding_boundary ? grid::Boundary::sliding : grid::Boundary::fixed;
    settings.tolerance = input.elliptic.tolerance;
    settings.max_iterations = input.elliptic.max_iterations;
    settings.max_rounds = input.elliptic.max_rounds;
    return settings;
}

} // namespace

grid::WeightPtr chosen_weight(const GridInput& input) {
    switch (input.elliptic.weight) {
    case WeightSource::error:
        return nullptr;
    case WeightSource::expression:
        return weight_of_formula(input);
    case WeightSource::w1:
        return grid::weight_w1();
    case WeightSource::w2:
        return grid::weight_w2(input.nu);
    case WeightSource::w3:
        return grid::weight_w3(input.nu, input.nv);
    case WeightSource::w4:
        return grid::weight_w4();
    }
    return nullptr;
}

std::unique_ptr<grid::GridImprover> make_improver(GridMethod method,
                                                  const GridInput& input,
                                                  const toolpath::KinematicError& error,
                                                  Effort effort) {
    expects(method != GridMethod::uniform, "the uniform grid is not improved");
    grid::Grid start = grid::Grid::uniform(input.nu, input.nv);
    if (method == GridMethod::elliptic) {
        return std::make_unique<grid::EllipticAdaptation>(
            error, start, elliptic_settings(input), chosen_weight(input));
    }
    if (method == GridMethod::chain) {
        return std::make_unique<grid::ChainOptimiser>(
            error, std::move(start), input.direction, chain_settings(input));
    }
    return std::make_unique<grid::TrackOptimiser>(
        error, std::move(start), input.direction, track_settings(input, effort));
}

GridOutcome uniform_outcome(const GridInput& input) {
    return {grid::Grid::uniform(input.nu, input.nv)};
}

GridOutcome improved_outcome(grid::GridImprover& improver, const Progress& progress) {
    constexpr double share = 0.15; // of what is left: nobody knows the number of steps beforehand
    double done = 0.0;
    for (bool more = true; more;) {
        progress.check();
        const double next = done + share * (1.0 - done);
        more = improver.advance(progress.part(done, next));
        done = next;
    }
    const grid::ImproverState& state = improver.state();
    progress.report(1.0);
    return {state.best,
            state.status,
            state.round,
            state.iteration,
            state.norm,
            state.start,
            state.of_best,
            state.note};
}

std::string_view title_of_making(GridMethod method) {
    switch (method) {
    case GridMethod::uniform:
        return "Measuring the uniform grid";
    case GridMethod::elliptic:
        return "Adapting the elliptic grid";
    case GridMethod::tracks:
        return "Optimising the tracks";
    case GridMethod::chain:
        return "Moving all nodes at once";
    }
    return {};
}

Evaluation improved_evaluation(GridMethod method,
                               const GridInput& input,
                               const Workpiece& workpiece,
                               const Evaluation& uniform,
                               Effort effort,
                               const Progress& progress) {
    const toolpath::KinematicError error = workpiece.error_model();
    const auto improver = make_improver(method, input, error, effort);
    return evaluation_by(*improver, workpiece, uniform, effort, progress);
}

Evaluation evaluation_by(grid::GridImprover& improver,
                         const Workpiece& workpiece,
                         const Evaluation& uniform,
                         Effort effort,
                         const Progress& progress) {
    constexpr double measuring = 0.9; // share of the improvement
    GridOutcome outcome = improved_outcome(improver, progress.part(0.0, measuring));
    const int samples = effort == Effort::live ? live_samples : report_samples;
    Evaluation found = evaluate(workpiece, std::move(outcome), samples, progress.part(measuring, 1.0));
    if (!is_worse(found, uniform, workpiece.machine)) {
        return found;
    }
    Evaluation kept = uniform;
    kept.outcome = {uniform.outcome.grid,
                    grid::ImproverStatus::no_gain,
                    found.outcome.rounds,
                    found.outcome.iterations,
                    found.outcome.norm,
                    found.outcome.start_by_curve,
                    found.outcome.start_by_curve,
                    "Nothing better than the uniform grid was found on the whole path; it is kept."};
    return kept;
}

bool is_worse(const Evaluation& found, const Evaluation& start, const kinematics::MachineModel& machine) {
    constexpr double rounding = 1e-9; // of figures that are sums over many moves
    const bool turns = !machine.rotary_axes().empty();
    return !(found.closest.mean <= start.closest.mean * (1.0 + rounding)) ||
           !(found.closest.max <= start.closest.max * (1.0 + rounding)) ||
           (turns && !(found.closest.axis_max <= start.closest.axis_max * (1.0 + rounding)));
}

} // namespace millwright::project
