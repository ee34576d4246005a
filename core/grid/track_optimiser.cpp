#include "core/grid/track_optimiser.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/grid/lattice.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace millwright::grid {

namespace {

constexpr int least_lattice = 160;  // below, the polish no longer makes up for the coarse places
constexpr int lattice_per_node = 4; // the same, for long tracks
constexpr int quick_lattice = 100;
constexpr double axis_margin = 0.98; // of the axis limit in the search, whose 10 times miss the top of a move
constexpr double aim_slack = 1.05; // above the least possible, so that the cost has something to choose from
constexpr double small_tip_mm = 1e-3; // no aim is below what a machine could follow
constexpr double small_axis = 1e-4;   // the same, rad: a micrometre at 10 mm
constexpr double still = 1e-4;        // mean steps: a sweep that moves no node further has settled

bool within(double value, double least, double most) {
    return value >= least && value <= most;
}

void check(const TrackSettings& s, int nodes) {
    expects(s.lattice == 0 || (s.lattice >= nodes && s.lattice <= 100'000), "a lattice has a place a node");
    expects(within(s.monitor_share, 0.0, 0.99), "the share of the monitor is from 0 to 0.99");
    expects(within(s.longest_move, 1.5, 100.0), "the longest move is from 1.5 to 100 mean steps");
    expects(within(s.shortest_move, 0.0, 0.5), "the shortest move is from 0 to 0.5 mean steps");
    expects(within(s.error_exponent, 1.0, 16.0), "the error exponent is from 1 to 16");
    expects(within(s.axis_weight_mm_per_deg, 0.0, 100.0), "the weight of the axis is from 0 to 100 mm/deg");
    for (const double share : {s.tip_share, s.param_share, s.length_share, s.worst_share, s.axis_share}) {
        expects(within(share, 0.0, 1.0), "a share is from 0 to 1");
    }
    expects(s.polish_sweeps >= 0 && s.polish_sweeps <= 1000, "there are 0 to 1000 polishing sweeps");
    expects(within(s.gap_allowance, 0.0, 10.0), "the allowance of the gap is from 0 to 10");
}

/// Calls `body` for each track in parallel and tells `progress` how many are done.
template <typename Body> void each_track(std::ptrdiff_t count, const Progress& progress, Body body) {
    std::atomic<int> done = 0;
    parallel_for(count, 1, [&](std::ptrdiff_t t) {
        progress.check();
        body(static_cast<std::size_t>(t));
        progress.report(static_cast<double>(++done) / static_cast<double>(count));
    });
}

std::vector<PlacedTrack> placed(const std::vector<MeasuredTrack>& tracks) {
    std::vector<PlacedTrack> found;
    for (const MeasuredTrack& track : tracks) {
        found.push_back(track.placed);
    }
    return found;
}

MoveWindow window_of(const PlacedTrack& start, double step, const TrackSettings& settings) {
    MoveWindow window{settings.shortest_move * step, settings.longest_move * step};
    for (std::size_t n = 1; n < start.places.size(); ++n) { // the start is one of the paths
        const double move = start.places[n] - start.places[n - 1];
        window.shortest = std::min(window.shortest, move);
        window.longest = std::max(window.longest, move);
    }
    return window;
}

/// The worst of `start`'s moves in `table` that are in reach, or `worst` if that is worse.
MoveLimits worst_of(const MoveTable& table, const PlacedTrack& start, MoveLimits worst) {
    for (std::size_t n = 1; n < start.places.size(); ++n) {
        const MoveError& move =
            table.move(table.index_of(start.places[n - 1]), table.index_of(start.places[n]));
        if (std::isfinite(move.tip) && std::isfinite(move.axis)) {
            worst = {std::max(worst.tip, move.tip), std::max(worst.axis, move.axis)};
        }
    }
    return worst;
}

std::string note_of(const std::string& done, const GuardedTracks& best) {
    const int kept = best.kept_from_start;
    return kept == 0 ? done : done + "; tracks left as they were: " + std::to_string(kept);
}

} // namespace

TrackSettings quick_track_settings() {
    TrackSettings settings;
    settings.lattice = quick_lattice;
    settings.polish_sweeps = 0;
    return settings;
}

TrackOptimiser::TrackOptimiser(const ErrorModel& model,
                               const Grid& start,
                               TrackDirection direction,
                               const TrackSettings& settings)
    : model_(model), settings_(settings),
      state_{.current = start.array(), .best = start, .start = {}, .now = {}, .of_best = {}, .note = {}},
      start_(straight_tracks(start, direction)) {
    check(settings_, moves() + 1);
    if (settings_.lattice == 0) {
        settings_.lattice = std::max(least_lattice, lattice_per_node * (moves() + 1));
    }
}

bool TrackOptimiser::advance(const Progress& progress) {
    switch (stage_) {
    case Stage::lattices:
        measure_lattices(progress);
        break;
    case Stage::paths:
        find_paths(progress);
        break;
    case Stage::polish:
        sweep(progress);
        break;
    case Stage::done:
        break;
    }
    return stage_ != Stage::done;
}

double TrackOptimiser::mean_step(std::size_t track) const {
    return (start_[track].places.back() - start_[track].places.front()) / moves();
}

MoveCost TrackOptimiser::cost_of(std::size_t track) const {
    double length = 0.0;
    for (const MoveError& move : measured_start_[track].moves) {
        length += move.length;
    }
    return {.exponent = settings_.error_exponent,
            .tip_share = settings_.tip_share,
            .param_share = settings_.param_share,
            .axis_weight = to_degrees(settings_.axis_weight_mm_per_deg),
            .length_share = settings_.length_share,
            .even_length = length / moves()};
}

MoveTable TrackOptimiser::table_of(std::size_t track, const Progress& progress) const {
    const PlacedTrack& start = start_[track];
    const LatticeSettings settings{.intervals = settings_.lattice, .monitor_share = settings_.monitor_share};
    std::vector<double> places = lattice(model_, start, settings, progress);
    const MoveWindow window = window_of(start, mean_step(track), settings_);
    return {model_, start.track, std::move(places), window, coarse, progress};
}

void TrackOptimiser::measure_lattices(const Progress& progress) {
    progress.report(0.0, "Measuring the moves of the lattices");
    std::vector<MeasuredTrack> start = measured(model_, start_, fine, progress);
    const TrackPromise promise = promise_of(model_, start, settings_.gap_allowance, progress);
    std::vector<std::optional<MoveTable>> laid(start_.size());
    each_track(std::ssize(start_), progress.part(0.1, 1.0), [&](std::size_t t) {
        laid[t].emplace(table_of(t, progress));
    });
    for (std::optional<MoveTable>& table : laid) {
        tables_.push_back(std::move(table).value());
    }
    measured_start_ = std::move(start);
    promise_ = promise;
    state_.start = summary(moves_of(measured_start_));
    state_.now = state_.of_best = state_.start;
    state_.round = 1;
    state_.note =
        "Moves of the lattices measured, " + std::to_string(settings_.lattice) + " intervals a track";
    stage_ = Stage::paths;
}

/// The settings' shares of the start's worst, raised to what is possible, so that there always is a path.
std::vector<MoveLimits> TrackOptimiser::aims(const Progress& progress) const {
    MoveLimits worst{0.0, 0.0};
    for (std::size_t t = 0; t < tables_.size(); ++t) {
        worst = worst_of(tables_[t], start_[t], worst);
    }
    const double axis_aim = axis_margin * settings_.axis_share * worst.axis;
    std::vector<MoveLimits> limits(tables_.size());
    std::vector<double> least_tips(tables_.size(), 0.0);
    each_track(std::ssize(tables_), progress, [&](std::size_t t) {
        const auto axis = least_worst_path(tables_[t], moves(), &MoveError::axis, {});
        limits[t].axis = std::max({axis_aim, small_axis, aim_slack * (axis ? axis->value : 0.0)});
        const auto tip = least_worst_path(tables_[t], moves(), &MoveError::tip, limits[t]);
        least_tips[t] = tip ? tip->value : 0.0;
    });
    const double least_tip = *std::ranges::max_element(least_tips);
    for (MoveLimits& limit : limits) {
        limit.tip = std::max({settings_.worst_share * worst.tip, small_tip_mm, aim_slack * least_tip});
    }
    return limits;
}

/// The start's track if no path is in reach.
PlacedTrack TrackOptimiser::path_of(std::size_t track, const MoveLimits& limits) const {
    const auto path = cheapest_path(tables_[track], moves(), cost_of(track), limits);
    return path ? PlacedTrack{start_[track].track, places_of(tables_[track], *path)} : start_[track];
}

void TrackOptimiser::find_paths(const Progress& progress) {
    progress.report(0.0, "Choosing the nodes of each track");
    const std::vector<MoveLimits> limits = aims(progress.part(0.0, 0.4));
    std::vector<PlacedTrack> found(start_.size());
    each_track(std::ssize(start_), progress.part(0.4, 0.6), [&](std::size_t t) {
        found[t] = path_of(t, limits[t]);
    });
    std::vector<MeasuredTrack> paths = measured(model_, found, fine, progress);
    const GuardedTracks best = never_worse(model_, {paths}, measured_start_, promise_, progress);
    limits_ = limits;
    paths_ = std::move(paths);
    tables_.clear();
    publish(best);
    state_.current = array_of(found);
    state_.now = summary(moves_of(paths_));
    state_.round = 2;
    state_.note = note_of("Best paths through the lattices found", best);
    if (settings_.polish_sweeps > 0 && moves() > 1) {
        begin_polish();
    } else {
        finish(ImproverStatus::converged);
    }
}

void TrackOptimiser::begin_polish() {
    for (std::size_t t = 0; t < start_.size(); ++t) {
        const PolishSettings settings{
            .cost = cost_of(t), .limits = limits_[t], .min_gap = settings_.shortest_move * mean_step(t)};
        polishes_.emplace_back(model_, paths_[t].placed, settings);
    }
    stage_ = Stage::polish;
}

void TrackOptimiser::sweep(const Progress& progress) {
    progress.report(0.0, "Polishing");
    std::vector<TrackPolish> next = polishes_;
    std::vector<double> longest(next.size(), 0.0);
    each_track(std::ssize(next), progress.part(0.0, 0.8), [&](std::size_t t) {
        longest[t] = next[t].sweep(progress) / mean_step(t);
    });
    const double norm = *std::ranges::max_element(longest);
    const bool settled = norm < still;
    if (settled || state_.iteration + 1 >= settings_.polish_sweeps) {
        end_polish(next, settled ? ImproverStatus::converged : ImproverStatus::iteration_limit, progress);
    } else {
        std::vector<MoveError> moves;
        std::vector<PlacedTrack> tracks;
        for (const TrackPolish& track : next) {
            tracks.push_back(track.track());
            moves.insert(moves.end(), track.moves().begin(), track.moves().end());
        }
        state_.current = array_of(tracks);
        state_.now = summary(moves);
        state_.note = "Polishing, sweep " + std::to_string(state_.iteration + 1);
    }
    ++state_.round;
    ++state_.iteration;
    state_.norm = norm;
    polishes_ = std::move(next);
}

void TrackOptimiser::end_polish(const std::vector<TrackPolish>& polished,
                                ImproverStatus status,
                                const Progress& progress) {
    std::vector<PlacedTrack> tracks;
    for (const TrackPolish& track : polished) {
        tracks.push_back(track.track());
    }
    const std::vector<MeasuredTrack> after = measured(model_, tracks, fine, progress);
    const GuardedTracks best = never_worse(model_, {after, paths_}, measured_start_, promise_, progress);
    publish(best);
    state_.note = note_of("Polished", best);
    finish(status);
}

void TrackOptimiser::publish(const GuardedTracks& best) {
    state_.best = Grid(array_of(placed(best.tracks)));
    state_.of_best = summary(moves_of(best.tracks));
}

void TrackOptimiser::finish(ImproverStatus status) {
    const bool gained = !(state_.best.array() == array_of(start_));
    state_.status = gained ? status : ImproverStatus::no_gain;
    state_.current = state_.best.array();
    state_.now = state_.of_best;
    stage_ = Stage::done;
}

} // namespace millwright::grid
