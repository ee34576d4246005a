#include "core/grid/elliptic_adaptation.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/grid/corner_functionals.h"
#include "core/grid/discrete_minimiser.h"
#include "core/grid/internal/adaptation_text.h"
#include "core/grid/jacobi_newton.h"
#include "core/grid/multigrid.h"
#include "core/grid/quality_guard.h"
#include "core/grid/region.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace millwright::grid {

namespace {

constexpr int iterations_per_measurement =
    10;                        // not those of a step, so that watching does not change the result
constexpr int enough_kept = 6; // candidates to choose from at the end; each costs a whole path
constexpr std::size_t most_candidates = 32; // each is a whole grid
constexpr int most_falls = 3;
constexpr double fall_of_adaptation = 0.1;
// What of the whole way is done, by where the time goes.
constexpr double iterated = 0.5;
constexpr double adaptation_judged = 0.99;

/// A cycle does what hundreds of plain iterations do.
int measured_every(EllipticMethod method) {
    return method == EllipticMethod::multigrid ? 1 : iterations_per_measurement;
}

bool has_failed(SolverStatus status) {
    return status == SolverStatus::folded || status == SolverStatus::not_finite ||
           status == SolverStatus::singular;
}

OptimiserStatus as_optimiser_status(SolverStatus status) {
    switch (status) {
    case SolverStatus::converged:
        return OptimiserStatus::converged;
    case SolverStatus::folded:
        return OptimiserStatus::folded;
    case SolverStatus::not_finite:
        return OptimiserStatus::not_finite;
    case SolverStatus::singular:
        return OptimiserStatus::singular;
    case SolverStatus::running:
    case SolverStatus::iteration_limit:
    case SolverStatus::stalled:
        break;
    }
    return OptimiserStatus::iteration_limit;
}

/// Copies the outline of `from`, so that no rounding on the way to solver coordinates and back moves it.
void keep_outline(NodeArray& nodes, const NodeArray& from) {
    for (int i = 0; i < nodes.rows; ++i) {
        nodes.at(i, 0) = from.at(i, 0);
        nodes.at(i, nodes.columns - 1) = from.at(i, nodes.columns - 1);
    }
    for (int j = 0; j < nodes.columns; ++j) {
        nodes.at(0, j) = from.at(0, j);
        nodes.at(nodes.rows - 1, j) = from.at(nodes.rows - 1, j);
    }
}

/// No reason is left to prefer the other grid.
bool dominates(const ErrorSummary& one, const ErrorSummary& other) {
    return one.mean <= other.mean && one.axis_max <= other.axis_max;
}

/// Not finite where the last iteration has none.
double norm_after(const EllipticSolver& solver) {
    const bool has_norm =
        solver.status() != SolverStatus::not_finite && !exactly_equal(solver.norm(), norm_at_start);
    return has_norm ? solver.norm() : std::numeric_limits<double>::quiet_NaN();
}

void expects_valid_settings(const EllipticAdaptationSettings& settings) {
    expects(settings.functional.adaptation >= 0.0 && settings.functional.orthogonality >= 0.0,
            "LV and LO are not negative");
    expects(settings.tolerance >= 0.0 && settings.error_change >= 0.0 && settings.gap_allowance >= 0.0,
            "tolerances and allowances are not negative");
    expects(settings.max_iterations > 0 && settings.max_rounds > 0 && settings.iterations_per_step > 0,
            "an adaptation does at least one iteration per step and one round");
    expects(settings.memory >= 0.0 && settings.memory < 1.0, "the memory is a share below 1");
    expects(settings.error_weight.exponent > 0.0 && settings.error_weight.floor > 0.0 &&
                settings.error_weight.smoothing_passes >= 0,
            "the weight of the error is positive");
}

constexpr const char* start_name = "start grid";

/// `name` says which grid `grid` is.
std::string warning_of(const Weight* weight, const Grid& grid, const std::string& name) {
    if (weight == nullptr) {
        return {};
    }
    const int count = count_not_positive(*weight, to_solver_coordinates(grid.array()));
    return count == 0 ? std::string{}
                      : "The weight is not positive at " + std::to_string(count) + " of " +
                            std::to_string(grid.array().nodes.size()) + " nodes of the " + name +
                            ", so the functional may have no minimum.";
}

} // namespace

std::size_t memory_bytes(EllipticMethod method, int nu, int nv) {
    const auto of_solver = [&] {
        switch (method) {
        case EllipticMethod::multigrid:
            return MultigridThenMinimiser::memory_bytes(nu, nv);
        case EllipticMethod::reference:
            return JacobiNewton::memory_bytes(nu, nv);
        case EllipticMethod::minimiser:
        case EllipticMethod::harmonic:
            break;
        }
        return DiscreteMinimiser::memory_bytes(nu, nv);
    };
    const auto nodes = static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv);
    constexpr std::size_t weights = 3; // density before, now, and what is made of it
    const std::size_t a_position = nodes * (3 * sizeof(Vec2) + sizeof(MoveError));
    return 2 * of_solver() + 2 * a_position + nodes * most_candidates * sizeof(Vec2) +
           weights * raster_bytes(nu, nv);
}

EllipticAdaptationSettings harmonic_settings() {
    EllipticAdaptationSettings settings;
    settings.method = EllipticMethod::harmonic;
    settings.error_weight = {.exponent = 0.5, .floor = 0.05, .smoothing_passes = 0};
    settings.gap_allowance = 0.15;
    return settings;
}

EllipticAdaptation::EllipticAdaptation(const ErrorModel& model,
                                       const Grid& start,
                                       const EllipticAdaptationSettings& settings,
                                       WeightPtr weight)
    : model_(model), settings_(settings), weight_(std::move(weight)),
      start_(start), at_{.state = {.current = start.array(), .best = start},
                         .round_start = start,
                         .functional = settings.functional} {
    expects_valid_settings(settings_);
    const bool has_stencil =
        settings_.method == EllipticMethod::reference || settings_.method == EllipticMethod::multigrid;
    expects(!has_stencil || (start.nu() >= 3 && start.nv() >= 3),
            "the reference and the multigrid method have at least 3 x 3 nodes");
    at_.moves = measure(model_, start_, settings_.direction, settings_.sampling);
    at_.state.start = summary(at_.moves);
    at_.state.now = at_.state.start;
    at_.state.of_best = at_.state.start;
    at_.round_start_error = at_.state.start.mean;
    at_.weight_warning = warning_of(weight_.get(), start_, start_name);
    at_.state.warning = at_.weight_warning;
    at_.state.note = "Start: " + mean_sentence(at_.state.start);
}

EllipticAdaptation::EllipticAdaptation(const ErrorModel& model,
                                       const Grid& start,
                                       const EllipticAdaptationSettings& settings,
                                       WeightOfError weight_of_error)
    : EllipticAdaptation(model, start, settings) {
    weight_of_error_ = std::move(weight_of_error);
}

bool EllipticAdaptation::advance(const Progress& progress) {
    if (at_.state.status != OptimiserStatus::running) {
        return false;
    }
    progress.check();
    Position next = at_;
    if (!next.coarse_start) {
        measure_start(next, progress);
    }
    if (next.ending != OptimiserStatus::running) {
        confirm(next, progress.part(iterated, adaptation_judged));
    } else if (weight_ == nullptr && next.state.start.max <= no_error) {
        next.state.status = OptimiserStatus::no_gain;
        next.state.note = "There is no error to reduce";
    } else {
        step(next, progress);
    }
    at_ = std::move(next);
    const bool more = at_.state.status == OptimiserStatus::running;
    if (!more) {
        at_.state.reached = at_.state.current;
    }
    at_.state.done = more ? std::max(at_.state.done, share_done(at_)) : 1.0;
    const std::string_view note = at_.state.note;
    progress.report(std::min(at_.state.done, adaptation_judged), note.substr(0, note.find(". ")));
    return more;
}

/// The figures that people compare are fine ones, as those of the other methods. On the way a coarse look has
/// to do, and is compared with a coarse one.
void EllipticAdaptation::measure_start(Position& at, const Progress& progress) const {
    progress.report(at.state.done, "Measuring the start grid");
    at.coarse_start = at.state.start;
    at.coarse_best = at.state.start.mean;
    at.state.start = at.state.now = at.state.of_best = finely(start_, progress);
    if (settings_.gap_allowance < any_gap) {
        at.widest_gap = (1.0 + settings_.gap_allowance) * model_.track_gap(start_, settings_.direction);
    }
}

ErrorSummary EllipticAdaptation::finely(const Grid& grid, const Progress& progress) const {
    return summary(measure(model_, grid, settings_.direction, fine, progress));
}

/// Of all the iterations that are allowed: a round that settles early leaves the rest of its share out.
double EllipticAdaptation::share_done(const Position& at) const {
    const double rounds = at.state.round + static_cast<double>(at.state.iteration - at.iterations_before) /
                                               settings_.max_iterations;
    return at.ending != OptimiserStatus::running ? iterated : iterated * rounds / settings_.max_rounds;
}

/// Density of this round and, fading, of those before, as the weight of the next solver.
WeightPtr EllipticAdaptation::error_weight(Position& at) const {
    std::vector<double> density = error_density(at.round_start, settings_.direction, at.moves);
    if (at.density != nullptr) {
        const std::vector<double> before =
            weight_at_nodes(*at.density, to_solver_coordinates(at.round_start.array()));
        for (std::size_t k = 0; k < density.size(); ++k) {
            density[k] = (1.0 - settings_.memory) * density[k] + settings_.memory * before[k];
        }
    }
    at.density = weight_on(at.round_start, density);
    if (weight_of_error_) {
        return weight_of_error_(at.density);
    }
    return weight_on(
        at.round_start,
        scaled_weight(std::move(density), at.round_start.nu(), at.round_start.nv(), settings_.error_weight));
}

/// In the region; outside as small as it is anywhere.
WeightPtr EllipticAdaptation::weight_of_round(Position& at) const {
    WeightPtr weight = weight_ != nullptr ? weight_ : error_weight(at);
    if (settings_.region == nullptr) {
        return weight;
    }
    const double least = std::ranges::min(weight_at_nodes(*weight, to_solver_coordinates(start_.array())));
    return within(std::move(weight), settings_.region, least);
}

std::unique_ptr<EllipticSolver> EllipticAdaptation::new_solver(Position& at) const {
    const EllipticSettings solver{.functional = at.functional,
                                  .relaxation = settings_.relaxation,
                                  .tolerance = settings_.tolerance,
                                  .max_iterations = settings_.max_iterations,
                                  .boundary = settings_.boundary};
    if (at.round_weight == nullptr) {
        at.round_weight = weight_of_round(at);
        at.last_weight = at.round_weight;
        if (at.weight_warning.empty()) { // else it was counted on the start grid, which a person knows
            at.weight_warning =
                warning_of(at.round_weight.get(),
                           at.round_start,
                           at.state.round == 0 ? std::string(start_name)
                                               : "grid of round " + std::to_string(at.state.round + 1));
            at.state.warning += at.state.warning.empty() || at.weight_warning.empty() ? "" : " ";
            at.state.warning += at.weight_warning;
        }
    }
    NodeArray nodes = to_solver_coordinates(at.round_start.array());
    if (settings_.method == EllipticMethod::reference) {
        return std::make_unique<JacobiNewton>(std::move(nodes), at.round_weight, solver);
    }
    if (settings_.method == EllipticMethod::multigrid) {
        return std::make_unique<MultigridThenMinimiser>(std::move(nodes), at.round_weight, solver);
    }
    if (settings_.method == EllipticMethod::harmonic) {
        return std::make_unique<DiscreteMinimiser>(
            std::move(nodes),
            [m = at.round_weight, direction = settings_.direction](const NodeArray& array) {
                return harmonic_functional(array, *m, direction);
            },
            solver);
    }
    return std::make_unique<DiscreteMinimiser>(std::move(nodes), at.round_weight, solver);
}

void EllipticAdaptation::step(Position& at, const Progress& progress) const {
    const std::unique_ptr<EllipticSolver> solver = at.solver != nullptr ? at.solver->clone() : new_solver(at);
    bool more = true;
    for (int n = 0; more && n < settings_.iterations_per_step; ++n) {
        progress.check();
        more = solver->iterate();
        at.state.iteration = at.iterations_before + solver->iterations();
        at.state.norms.push_back(
            {at.state.round + 1,
             has_adaptation() ? at.functional.adaptation : std::numeric_limits<double>::quiet_NaN(),
             norm_after(*solver)});
        if (has_failed(solver->status())) {
            fall(at, solver->status());
            return;
        }
        if (!more || solver->iterations() % measured_every(settings_.method) == 0) {
            take(at, solver->nodes(), progress);
            at.state.note = iteration_sentence(at.state);
            progress.report(at.state.done, at.state.note);
        }
    }
    at.state.current = parameters_of(solver->nodes());
    at.state.norm = solver->norm();
    at.solver = solver->clone();
    at.state.note = iteration_sentence(at.state);
    if (!more) {
        end_round(at, solver->status());
    }
}

std::optional<NodeArray> EllipticAdaptation::residuals() const {
    const NodeArray& nodes = at_.state.current;
    if (at_.last_weight == nullptr || settings_.method == EllipticMethod::harmonic || nodes.rows < 3 ||
        nodes.columns < 3) {
        return std::nullopt;
    }
    const JacobiNewton equations(to_solver_coordinates(nodes),
                                 at_.last_weight,
                                 {.functional = at_.functional, .boundary = settings_.boundary});
    return grid::residuals(equations.equations(), nodes.rows, nodes.columns);
}

NodeArray EllipticAdaptation::parameters_of(const NodeArray& nodes) const {
    NodeArray array = to_parameters(nodes);
    if (settings_.boundary == Boundary::fixed) {
        keep_outline(array, start_.array());
    }
    return array;
}

/// Measures the grid that `nodes` are, and keeps it if it is the best so far.
void EllipticAdaptation::take(Position& at, const NodeArray& nodes, const Progress& progress) const {
    const Grid grid(parameters_of(nodes));
    at.moves = measure(model_, grid, settings_.direction, settings_.sampling, progress);
    at.state.now = summary(at.moves);
    const bool has_gained = at.state.now.mean < at.coarse_start->mean;
    if (has_gained && std::ranges::none_of(at.candidates, [&](const CandidatePtr& earlier) {
            return dominates(earlier->error, at.state.now);
        })) {
        keep(at, grid);
    }
    const bool axis_is_kept = at.state.now.axis_max <= at.coarse_start->axis_max;
    if (at.state.now.mean < at.coarse_best && axis_is_kept) {
        at.coarse_best = at.state.now.mean;
        at.state.best = grid;
        at.state.of_best = at.state.now;
    }
}

/// As a candidate, unless its tracks lie too far apart.
void EllipticAdaptation::keep(Position& at, const Grid& grid) const {
    if (std::isfinite(at.widest_gap) && model_.track_gap(grid, settings_.direction) > at.widest_gap) {
        at.too_wide.push_back(at.state.now.mean);
        return;
    }
    at.candidates.push_back(std::make_shared<const Candidate>(Candidate{grid, at.state.now}));
    if (at.candidates.size() > most_candidates) {
        at.candidates.erase(
            std::ranges::max_element(at.candidates, {}, [](const CandidatePtr& c) { return c->error.mean; }));
    }
}

/// The round starts again with less adaptation, or everything ends if that was tried often enough.
void EllipticAdaptation::fall(Position& at, SolverStatus failure) const {
    const std::string what =
        failure_sentence(failure) +
        (has_adaptation() ? " at LV = " + shortest(at.functional.adaptation) : std::string());
    at.state.current = at.round_start.array();
    at.iterations_before = at.state.iteration;
    at.solver = nullptr;
    if (at.falls == most_falls || !has_adaptation() || at.functional.adaptation <= 0.0) {
        at.ending = as_optimiser_status(failure);
        at.state.note = "Stopped: " + what;
        return;
    }
    ++at.falls;
    at.functional.adaptation *= fall_of_adaptation;
    const std::string used = shortest(at.functional.adaptation);
    at.state.note = "Restarted with LV = " + used + ": " + what;
    at.state.warning = with_sentence(at.weight_warning,
                                     "LV = " + used + " was used instead of " +
                                         shortest(settings_.functional.adaptation) + ": " + what + ".");
}

void EllipticAdaptation::end_round(Position& at, SolverStatus solved) const {
    const double before = at.round_start_error;
    const double now = at.state.now.mean;
    ++at.state.round;
    at.unsolved =
        solved == SolverStatus::converged
            ? std::string()
            : unsolved_sentence(at.state, at.state.iteration - at.iterations_before, settings_.tolerance);
    at.iterations_before = at.state.iteration;
    at.solver = nullptr;
    at.round_weight = nullptr;
    at.round_start = Grid(at.state.current);
    at.round_start_error = now;
    const bool settled = weight_ != nullptr
                             ? solved != SolverStatus::iteration_limit
                             : std::isfinite(before) && std::isfinite(now) &&
                                   std::abs(now - before) <= settings_.error_change * at.coarse_start->mean;
    if (settled) {
        at.ending = weight_ != nullptr ? as_optimiser_status(solved) : OptimiserStatus::converged;
    } else if (at.state.round >= settings_.max_rounds) {
        at.ending = OptimiserStatus::iteration_limit;
    }
}

/// Takes the candidate whose path has the least mean error among those that keep the promise, and tells why
/// better ones do not.
void EllipticAdaptation::choose(Position& at, const Progress& progress) const {
    at.state.best = start_;
    at.state.of_best = at.state.start;
    if (at.candidates.empty()) {
        at.state.note = "No grid was better than the start grid" +
                        refusals(at.too_wide, {}, infinity, settings_.gap_allowance);
        return;
    }
    std::ranges::sort(at.candidates, {}, [](const CandidatePtr& c) { return c->error.mean; });
    const auto share = [&](int n) { // each judges a whole path
        constexpr double paths = enough_kept + 1;
        return progress.part(n / paths, (n + 1) / paths);
    };
    const auto tell = [&](int n, const std::string& what) {
        share(n).report(0.0, "Evaluating " + what + " on the whole path");
    };
    tell(0, "the start grid");
    const QualityGuard guard(model_, start_, settings_.direction, share(0));
    CandidatePtr chosen;
    double least = infinity;
    int kept = 0;
    std::vector<double> worse_elsewhere; // their means
    for (auto c = at.candidates.begin(); c != at.candidates.end() && kept < enough_kept; ++c) {
        const auto which = std::to_string(c - at.candidates.begin() + 1);
        tell(kept + 1, "grid " + which + " of " + std::to_string(at.candidates.size()));
        const std::optional<ErrorSummary> path = guard.kept_by((*c)->grid, share(kept + 1));
        if (!path) {
            worse_elsewhere.push_back((*c)->error.mean);
            continue;
        }
        ++kept;
        if (path->mean < least) {
            least = path->mean;
            chosen = *c;
        }
    }
    if (chosen) {
        at.state.best = chosen->grid;
        at.state.of_best = finely(chosen->grid, progress);
    }
    at.state.note =
        (chosen ? "Best grid: " + mean_sentence(at.state.of_best)
                : std::string("No grid was better than the start grid")) +
        refusals(
            at.too_wide, worse_elsewhere, chosen ? chosen->error.mean : infinity, settings_.gap_allowance);
}

void EllipticAdaptation::confirm(Position& at, const Progress& progress) const {
    const std::string ended = at.state.note;
    choose(at, progress);
    at.state.now = finely(Grid(at.state.current), progress);
    const bool better = !(at.state.best.array() == start_.array());
    const bool failed = at.ending == OptimiserStatus::folded || at.ending == OptimiserStatus::not_finite ||
                        at.ending == OptimiserStatus::singular;
    at.state.status = better || failed ? at.ending : OptimiserStatus::no_gain;
    if (failed) {
        at.state.note = ended;
    } else if (!at.unsolved.empty()) {
        at.state.warning = with_sentence(at.state.warning, at.unsolved);
    }
}

} // namespace millwright::grid
