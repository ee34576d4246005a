#include "core/grid/chain_optimiser.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/grid/quality_guard.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::grid {

namespace {

constexpr int iterations_per_step = 5;
constexpr double settled_step = 1e-4;    // cells: an iteration that moves no node further has settled
constexpr double room_for_corners = 0.9; // of the start's smallest corner triangle, where that is small
constexpr double usual_corner = 0.02;

// What one degree of the tool axis costs where it has a price, in shares of the start's mean error a degree
// of its largest deviation: while tracks and their nodes are chosen, and while all nodes move. Measured on
// the dome at 10 nodes, where the best nodes for the tip turn the axis further than the start does, on the
// start's tracks too: without a price both are refused, and the chain ends at a mean of 0.755 mm; with it
// 0.640.
constexpr double choosing_price = 2.0 / 3.0;
constexpr double moving_price = 0.25;

// What of the whole way is done, by where the time goes.
constexpr double start_measured = 0.02;
constexpr double tracks_chosen = 0.4;
constexpr double descents_done = 0.97;
constexpr double chain_judged = 0.99;

void check_chain_settings(const ChainSettings& s) {
    expects(s.candidates_per_gap >= 1 && s.candidates_per_gap <= 64, "there are 1 to 64 candidates per gap");
    expects(lies_between(s.narrowest_gap, 0.1, 1.0), "the narrowest gap is from 0.1 to 1");
    expects(lies_between(s.widest_gap, 1.0, 2.0), "the widest gap is from 1 to 2");
    expects(s.first_descent >= 0 && s.first_descent <= 100'000, "a descent has 0 to 100 000 iterations");
    expects(s.later_descents >= 0 && s.later_descents <= 100'000, "a descent has 0 to 100 000 iterations");
    expects(lies_between(s.leaps, 0, 100), "a descent leaps 0 to 100 times");
    expects(std::ranges::all_of(s.exponents, [](double p) { return lies_between(p, 1.0, 64.0); }),
            "the exponents are from 1 to 64");
    expects(lies_between(s.least_jacobian, 0.0, 1.0), "the least corner triangle is from 0 to 1");
}

double length_of(const std::vector<MoveError>& moves) {
    double length = 0.0;
    for (const MoveError& move : moves) {
        length += move.length;
    }
    return length;
}

/// Smaller is better: neither the worst move nor the mean is bought at any price of the other.
double score(const ErrorSummary& s) {
    return s.max * s.mean;
}

/// After which of `links` the best grid was the one that reached `best`; the later ones brought nothing more.
std::string found_by(const std::vector<ChainStage>& stages, const ErrorSummary& best) {
    const auto stage = std::ranges::find_if(
        stages, [&](const ChainStage& l) { return exactly_equal(score(l.of_best), score(best)); });
    return stage == stages.end() ? std::string()
                                 : fmt::format("The best grid of the stage \"{}\" is kept", stage->name);
}

/// Why the start stands after `links`, each reason once; whether links were taken until their paths as they
/// are run were seen.
std::string none_taken(const std::vector<ChainStage>& stages, bool worse_as_run) {
    std::vector<std::string> reasons;
    for (auto stage = stages.begin() + 1; stage != stages.end(); ++stage) { // behind the start's own
        const std::string why = stage->refused.empty() ? "no better than the start grid" : stage->refused;
        if (!(worse_as_run && stage->refused.empty()) && std::ranges::count(reasons, why) == 0) {
            reasons.push_back(why);
        }
    }
    if (worse_as_run) {
        reasons.emplace_back("a worse path than the start grid when it is run");
    }
    return fmt::format("No stage was accepted, so the start grid is kept: {}", fmt::join(reasons, "; "));
}

} // namespace

ChainOptimiser::ChainOptimiser(const ErrorModel& model,
                               const Grid& start,
                               TrackDirection direction,
                               ChainSettings settings)
    : model_(model), direction_(direction), settings_(std::move(settings)),
      state_{.current = start.array(), .best = start, .start = {}, .now = {}, .of_best = {}, .note = {}},
      start_(straight_tracks(start, direction)), accepted_(start.array()), bests_{{start, {}}} {
    check_chain_settings(settings_);
    settings_.tracks = checked(settings_.tracks, start.nodes_per_track(direction));
}

bool ChainOptimiser::advance(const Progress& progress) {
    switch (stage_) {
    case Stage::start:
        measure_start(progress.part(0.0, start_measured));
        break;
    case Stage::tracks:
        choose_tracks(progress.part(start_measured, tracks_chosen));
        break;
    case Stage::descent:
        descend(progress);
        break;
    case Stage::leap:
        leap(progress);
        break;
    case Stage::done:
        break;
    }
    return stage_ != Stage::done;
}

void ChainOptimiser::measure_start(const Progress& progress) {
    progress.report(0.0, "Measuring the start grid");
    const ErrorSummary found = summary(measure(model_, state_.best, direction_, fine, progress));
    widest_gap_mm_ = (1.0 + settings_.tracks.gap_allowance) * model_.track_gap(state_.best, direction_);
    state_.start = state_.now = state_.of_best = found;
    state_.note = "Start grid measured";
    state_.stages.push_back({"start", found, found, {}});
    bests_.front().reached = found;
    state_.done = start_measured;
    stage_ = Stage::tracks;
}

/// What of the promise the grid of `state_.now` breaks; empty: nothing.
std::string ChainOptimiser::fault_of(const Grid& grid) const {
    const ErrorSummary& now = state_.now;
    const ErrorSummary& start = state_.start;
    if (!(now.max <= start.max + negligible_mm)) {
        return "a larger error than the start grid";
    }
    if (!(now.mean <= start.mean + negligible_mm && now.lmean <= start.lmean + negligible_mm)) {
        return "a larger mean error than the start grid";
    }
    if (!(now.axis_max <= start.axis_max + negligible_rad)) {
        return "a larger tool-axis deviation than the start grid";
    }
    return model_.track_gap(grid, direction_) > widest_gap_mm_ ? "tracks too far apart" : std::string();
}

/// Makes `nodes` the best grid if they keep the promise and score better. Why they do not keep it; empty if
/// they do.
std::string ChainOptimiser::consider(const NodeArray& nodes, const Progress& progress) {
    state_.current = nodes;
    if (!(min_corner_jacobian(nodes) >= settings_.least_jacobian)) {
        return "a nearly folded cell";
    }
    const Grid grid(nodes);
    state_.now = summary(measure(model_, grid, direction_, fine, progress));
    if (std::string fault = fault_of(grid); !fault.empty()) {
        return fault;
    }
    accepted_ = nodes;
    if (score(state_.now) < score(state_.of_best)) {
        state_.best = grid;
        state_.of_best = state_.now;
    }
    return {};
}

void ChainOptimiser::end_link(std::string name, std::string refused) {
    state_.stages.push_back({std::move(name), state_.now, state_.of_best, std::move(refused)});
    if (score(state_.of_best) < score(bests_.back().reached)) {
        bests_.push_back({state_.best, state_.of_best});
    }
}

/// What the track optimiser finds keeps more promises than what comes after, where nodes are few.
void ChainOptimiser::optimise_tracks(const Progress& progress) {
    TrackSettings settings;
    settings.lattice = settings_.tracks.lattice;
    settings.error_exponent = settings_.tracks.error_exponent;
    settings.axis_weight_mm_per_deg = settings_.tracks.axis_weight_mm_per_deg;
    settings.polish_sweeps = settings_.tracks.polish_sweeps;
    settings.gap_allowance = settings_.tracks.gap_allowance;
    TrackOptimiser optimiser(model_, bests_.front().grid, direction_, settings);
    const Grid found = run(optimiser, progress).best;
    end_link("track optimiser", consider(found.array(), progress));
}

/// A price on the tool axis is not free: the tip pays it. It is asked only where the promise needs it, and
/// the start's own tracks with their best nodes come last.
void ChainOptimiser::choose_tracks(const Progress& progress) {
    progress.report(0.0, "Measuring the candidate tracks");
    optimise_tracks(progress.part(0.0, 0.1));
    const int a_gap = settings_.candidates_per_gap;
    const TrackCandidates candidates(model_, start_, a_gap, settings_.tracks, progress.part(0.1, 0.5));
    const bool chosen = choose_by_cost("best tracks and nodes", candidates, progress.part(0.5, 0.6)) ||
                        choose_with_axis_priced(progress.part(0.6, 0.95));
    if (!chosen) {
        take("best nodes of the start's tracks", candidates, a_gap, a_gap, progress.part(0.95, 1.0));
    }
    ++state_.round;
    state_.note = state_.stages.back().name;
    accepted_ = state_.best.array();
    state_.done = tracks_chosen;
    begin_descent(progress);
}

bool ChainOptimiser::choose_with_axis_priced(const Progress& progress) {
    const TrackSettings priced = price_axis(choosing_price);
    if (!(priced.axis_weight_mm_per_deg > settings_.tracks.axis_weight_mm_per_deg)) {
        return false;
    }
    const TrackCandidates candidates(
        model_, start_, settings_.candidates_per_gap, priced, progress.part(0.0, 0.85));
    if (!choose_by_cost("best tracks and nodes, with axis weight", candidates, progress.part(0.85, 1.0))) {
        return false;
    }
    moving_price_ = moving_price;
    return true;
}

/// With tracks as far apart as the settings let them.
bool ChainOptimiser::choose_by_cost(const std::string& name,
                                    const TrackCandidates& candidates,
                                    const Progress& progress) {
    const int a_gap = settings_.candidates_per_gap;
    const int nearest = static_cast<int>(std::ceil(settings_.narrowest_gap * a_gap));
    const int furthest = static_cast<int>(std::floor(settings_.widest_gap * a_gap));
    return take(name, candidates, std::max(1, nearest), furthest, progress);
}

/// The cheapest of `candidates` as the next stage. True if it keeps the promise.
bool ChainOptimiser::take(const std::string& name,
                          const TrackCandidates& candidates,
                          int nearest,
                          int furthest,
                          const Progress& progress) {
    const auto tracks = candidates.cheapest(nearest, furthest, progress);
    if (!tracks) {
        return false;
    }
    std::string refused = consider(array_of(*tracks), progress);
    const bool kept = refused.empty();
    end_link(name, std::move(refused));
    return kept;
}

/// The settings of the tracks with `price` on the tool axis, or the user's own weight where that is more.
TrackSettings ChainOptimiser::price_axis(double price) const {
    TrackSettings priced = settings_.tracks;
    if (state_.start.axis_max > negligible_rad) {
        const double share = price * state_.start.mean / to_degrees(state_.start.axis_max);
        priced.axis_weight_mm_per_deg = std::max(priced.axis_weight_mm_per_deg, share);
    }
    return priced;
}

/// Of the whole way, with so many iterations done of the present level, by all that are allowed: a descent
/// that settles early leaves the rest of its share out.
double ChainOptimiser::done_of_all(int of_level) const {
    const double later = settings_.later_descents;
    const double all = settings_.first_descent + later * static_cast<double>(settings_.exponents.size());
    const double before =
        level_ == 0 ? 0.0 : settings_.first_descent + later * static_cast<double>(level_ - 1);
    return mix(tracks_chosen, descents_done, all > 0.0 ? (before + of_level) / all : 1.0);
}

int ChainOptimiser::iterations_allowed() const {
    return level_ == 0 ? settings_.first_descent : settings_.later_descents;
}

double ChainOptimiser::exponent() const {
    return level_ == 0 ? settings_.tracks.error_exponent : settings_.exponents[level_ - 1];
}

void ChainOptimiser::begin_descent(const Progress& progress) {
    if (level_ > settings_.exponents.size() || iterations_allowed() == 0) {
        finish(progress);
        return;
    }
    const std::vector<MoveError> moves = measure(model_, Grid(accepted_), direction_, fine, progress);
    const ErrorSummary now = summary(moves);
    MoveCost cost = cost_by(price_axis(moving_price_), length_of(moves) / static_cast<double>(moves.size()));
    cost.exponent = exponent();
    const double usual_error = std::max(negligible_mm, level_ == 0 ? now.lmean : now.max / 2.0);
    PathObjectiveSettings objective{.cost = cost,
                                    .unit_cost = cost.even_length * std::pow(usual_error, cost.exponent)};
    objective.least_jacobian = std::min(usual_corner, room_for_corners * min_corner_jacobian(accepted_));
    descent_.emplace(PathObjective(model_, direction_, accepted_, objective), accepted_, progress);
    iterations_of_level_ = 0;
    leaps_of_level_ = 0;
    stage_ = Stage::descent;
}

/// The moves taken individually are not the whole truth: the path as it is run has the last word on each
/// link's best.
void ChainOptimiser::finish(const Progress& progress) {
    const Grid start = bests_.front().grid;
    const QualityGuard guard(model_, start, direction_, progress);
    const bool better_by_move = bests_.size() > 1;
    while (bests_.size() > 1 && !guard.kept_by(bests_.back().grid, progress)) {
        bests_.pop_back();
    }
    descent_.reset();
    state_.best = bests_.back().grid;
    state_.of_best = bests_.back().reached;
    const bool gained = bests_.size() > 1;
    state_.status = gained ? OptimiserStatus::converged : OptimiserStatus::no_gain;
    state_.note =
        gained ? found_by(state_.stages, state_.of_best) : none_taken(state_.stages, better_by_move);
    state_.reached = std::exchange(state_.current, state_.best.array());
    state_.now = state_.of_best;
    state_.done = 1.0;
    stage_ = Stage::done;
}

void ChainOptimiser::descend(const Progress& progress) {
    const int left = iterations_allowed() - iterations_of_level_;
    progress.report(done_of_all(iterations_of_level_), "Moving all nodes at once");
    PathDescent next = *descent_;
    bool going = true;
    int done = 0;
    while (going && done < std::min(iterations_per_step, left)) {
        going = next.iterate(progress) && next.last_step() > settled_step;
        ++done;
        progress.report(done_of_all(iterations_of_level_ + done));
    }
    refused_ = consider(next.nodes(), progress);
    descent_ = std::move(next);
    iterations_of_level_ += done;
    state_.iteration += done;
    state_.norm = descent_->last_step();
    state_.done = done_of_all(iterations_of_level_);
    state_.note =
        fmt::format("All nodes at once, exponent {:g}, iteration {}", exponent(), iterations_of_level_);
    if (done == left) {
        end_descent(progress);
    } else if (!going) {
        stage_ = Stage::leap;
    }
}

/// Near singular points the error has ridges, between which a descent comes to rest early.
void ChainOptimiser::leap(const Progress& progress) {
    if (leaps_of_level_ < settings_.leaps) {
        progress.report(state_.done, "Searching for better positions further away");
        PathDescent next = *descent_;
        if (next.leap(progress.part(state_.done, state_.done))) {
            descent_ = std::move(next);
            ++leaps_of_level_;
            stage_ = Stage::descent;
            return;
        }
    }
    end_descent(progress);
}

void ChainOptimiser::end_descent(const Progress& progress) {
    end_link(fmt::format("all nodes at once, exponent {:g}", exponent()), refused_);
    ++state_.round;
    ++level_;
    iterations_of_level_ = 0;
    state_.done = done_of_all(iterations_of_level_);
    begin_descent(progress.part(descents_done, chain_judged));
}

} // namespace millwright::grid
