#include "core/grid/track_optimiser.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/grid/internal/parallel_nodes.h"
#include "core/grid/track.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace millwright::grid {

namespace {

constexpr int least_lattice = 160;  // below, the polish no longer makes up for the coarse places
constexpr int lattice_per_node = 4; // the same, for long tracks
constexpr int quick_lattice = 100;

void check_track_settings(const TrackSettings& s, int nodes) {
    expects(s.lattice == 0 || (s.lattice >= nodes && s.lattice <= 100'000),
            "a lattice has at least one place per node");
    expects(lies_between(s.monitor_share, 0.0, 0.99), "the share of the monitor is from 0 to 0.99");
    expects(lies_between(s.longest_move, 1.5, 100.0), "the longest move is from 1.5 to 100 mean steps");
    expects(lies_between(s.shortest_move, 0.0, 0.5), "the shortest move is from 0 to 0.5 mean steps");
    expects(lies_between(s.error_exponent, 1.0, 16.0), "the error exponent is from 1 to 16");
    expects(lies_between(s.axis_weight_mm_per_deg, 0.0, 100.0),
            "the tool-axis weight is from 0 to 100 mm/deg");
    for (const double share : {s.tip_share, s.param_share, s.length_share, s.worst_share, s.axis_share}) {
        expects(lies_between(share, 0.0, 1.0), "a share is from 0 to 1");
    }
    expects(s.polish_sweeps >= 0 && s.polish_sweeps <= 1000, "there are 0 to 1000 polishing sweeps");
    expects(lies_between(s.gap_allowance, 0.0, 10.0), "the gap allowance is from 0 to 10");
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

} // namespace

TrackSettings quick_track_settings() {
    TrackSettings settings;
    settings.lattice = quick_lattice;
    settings.polish_sweeps = 0;
    return settings;
}

TrackSettings checked(TrackSettings settings, int nodes) {
    check_track_settings(settings, nodes);
    if (settings.lattice == 0) {
        settings.lattice = std::max(least_lattice, lattice_per_node * nodes);
    }
    return settings;
}

MoveCost cost_by(const TrackSettings& settings, double even_length) {
    return {.exponent = settings.error_exponent,
            .tip_share = settings.tip_share,
            .param_share = settings.param_share,
            .axis_weight = to_degrees(settings.axis_weight_mm_per_deg),
            .length_share = settings.length_share,
            .even_length = even_length};
}

double mean_step(const PlacedTrack& track) {
    return (track.places.back() - track.places.front()) / static_cast<double>(std::ssize(track.places) - 1);
}

MoveTable moves_by(const ErrorModel& model,
                   const PlacedTrack& start,
                   const TrackSettings& settings,
                   const Progress& progress) {
    const LatticeSettings fine_lattice{.intervals = settings.lattice,
                                       .monitor_share = settings.monitor_share};
    std::vector<double> places = lattice(model, start, fine_lattice, progress);
    const MoveWindow window = window_of(start, mean_step(start), settings);
    return {model, start.track, std::move(places), window, coarse, progress};
}

namespace {

constexpr double axis_margin = 0.98; // of the axis limit in the search, whose 10 times miss the top of a move
constexpr double aim_slack = 1.05; // above the least possible, so that the cost has something to choose from
constexpr double small_tip_mm = 1e-3; // no aim is below what a machine could follow
constexpr double small_axis = 1e-4;   // the same, rad: a micrometre at 10 mm

// What of the whole way is done, by where the time goes.
constexpr double lattices_measured = 0.5;
constexpr double paths_found = 0.6;
constexpr double polish_done = 0.98;

constexpr double settled_sweep = 1e-4; // mean steps: a sweep that moves no node further has settled

std::vector<PlacedTrack> placed(const std::vector<MeasuredTrack>& tracks) {
    std::vector<PlacedTrack> found;
    for (const MeasuredTrack& track : tracks) {
        found.push_back(track.placed);
    }
    return found;
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
    return kept == 0 ? done : done + "; unchanged tracks: " + std::to_string(kept);
}

} // namespace

TrackOptimiser::TrackOptimiser(const ErrorModel& model,
                               const Grid& start,
                               TrackDirection direction,
                               const TrackSettings& settings)
    : model_(model),
      state_{.current = start.array(), .best = start, .start = {}, .now = {}, .of_best = {}, .note = {}},
      start_(straight_tracks(start, direction)) {
    settings_ = checked(settings, moves() + 1);
}

bool TrackOptimiser::advance(const Progress& progress) {
    switch (stage_) {
    case Stage::lattices:
        measure_lattices(progress.part(0.0, lattices_measured));
        break;
    case Stage::paths:
        find_paths(progress.part(lattices_measured, paths_found));
        break;
    case Stage::polish:
        sweep(progress);
        break;
    case Stage::done:
        break;
    }
    return stage_ != Stage::done;
}

MoveCost TrackOptimiser::cost_of(std::size_t track) const {
    double length = 0.0;
    for (const MoveError& move : measured_start_[track].moves) {
        length += move.length;
    }
    return cost_by(settings_, length / moves());
}

void TrackOptimiser::measure_lattices(const Progress& progress) {
    progress.report(0.0, "Measuring the lattice moves");
    std::vector<MeasuredTrack> start = measured(model_, start_, fine, progress);
    const TrackQualityLimits limits = quality_limits_of(model_, start, settings_.gap_allowance, progress);
    std::vector<std::optional<MoveTable>> laid(start_.size());
    each_track(std::ssize(start_), progress.part(0.1, 0.99), [&](std::size_t t) {
        laid[t].emplace(moves_by(model_, start_[t], settings_, progress));
    });
    for (std::optional<MoveTable>& table : laid) {
        tables_.push_back(std::move(table).value());
    }
    measured_start_ = std::move(start);
    quality_limits_ = limits;
    state_.start = summary(moves_of(measured_start_));
    state_.now = state_.of_best = state_.start;
    state_.round = 1;
    state_.note = "Lattice moves measured, " + std::to_string(settings_.lattice) + " intervals per track";
    state_.done = lattices_measured;
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
    each_track(std::ssize(start_), progress.part(0.4, 0.9), [&](std::size_t t) {
        found[t] = path_of(t, limits[t]);
    });
    std::vector<MeasuredTrack> paths = measured(model_, found, fine, progress);
    const GuardedTracks best = never_worse(model_, {paths}, measured_start_, quality_limits_, progress);
    limits_ = limits;
    paths_ = std::move(paths);
    tables_.clear();
    publish(best);
    state_.current = array_of(found);
    state_.now = summary(moves_of(paths_));
    state_.round = 2;
    state_.done = paths_found;
    state_.note = note_of("Best paths through the lattices found", best);
    if (settings_.polish_sweeps > 0 && moves() > 1) {
        begin_polish();
    } else {
        finish(OptimiserStatus::converged);
    }
}

void TrackOptimiser::begin_polish() {
    for (std::size_t t = 0; t < start_.size(); ++t) {
        const PolishSettings settings{.cost = cost_of(t),
                                      .limits = limits_[t],
                                      .min_gap = settings_.shortest_move * mean_step(start_[t])};
        polishes_.emplace_back(model_, paths_[t].placed, settings);
    }
    stage_ = Stage::polish;
}

void TrackOptimiser::sweep(const Progress& progress) {
    const auto done_after = [&](int sweeps) {
        return paths_found + (polish_done - paths_found) * sweeps / settings_.polish_sweeps;
    };
    progress.report(done_after(state_.iteration), "Polishing");
    std::vector<TrackPolish> next = polishes_;
    std::vector<double> longest(next.size(), 0.0);
    const Progress part = progress.part(done_after(state_.iteration), done_after(state_.iteration + 1));
    each_track(std::ssize(next), part, [&](std::size_t t) {
        longest[t] = next[t].sweep(progress) / mean_step(start_[t]);
    });
    const double norm = *std::ranges::max_element(longest);
    const bool settled = norm < settled_sweep;
    if (settled || state_.iteration + 1 >= settings_.polish_sweeps) {
        end_polish(next, settled ? OptimiserStatus::converged : OptimiserStatus::iteration_limit, progress);
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
    state_.done = std::max(state_.done, done_after(state_.iteration));
    state_.norm = norm;
    polishes_ = std::move(next);
}

void TrackOptimiser::end_polish(const std::vector<TrackPolish>& polished,
                                OptimiserStatus status,
                                const Progress& progress) {
    std::vector<PlacedTrack> tracks;
    for (const TrackPolish& track : polished) {
        tracks.push_back(track.track());
    }
    const std::vector<MeasuredTrack> after = measured(model_, tracks, fine, progress);
    const GuardedTracks best =
        never_worse(model_, {after, paths_}, measured_start_, quality_limits_, progress);
    publish(best);
    state_.current = array_of(tracks);
    state_.note = note_of("Polished", best);
    finish(status);
}

void TrackOptimiser::publish(const GuardedTracks& best) {
    state_.best = Grid(array_of(placed(best.tracks)));
    state_.of_best = summary(moves_of(best.tracks));
}

void TrackOptimiser::finish(OptimiserStatus status) {
    const bool gained = !(state_.best.array() == array_of(start_));
    state_.status = gained ? status : OptimiserStatus::no_gain;
    state_.reached = std::exchange(state_.current, state_.best.array());
    state_.now = state_.of_best;
    state_.done = 1.0;
    stage_ = Stage::done;
}

} // namespace millwright::grid
