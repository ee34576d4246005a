#include "core/grid/track_path.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::grid {

namespace {

constexpr double window_slack = 1e-9; // of a window: a move exactly as long as the window is inside

/// The moves of a table as numbers, in rows that the dynamic programming runs along.
struct Weights {
    const MoveTable& table;
    std::vector<std::vector<double>> rows;
};

template <typename Weight> Weights weigh(const MoveTable& table, const MoveLimits& limits, Weight weight) {
    Weights found{table, {}};
    for (int k = 0; k < table.size(); ++k) {
        std::vector<double>& row = found.rows.emplace_back();
        for (int l = table.first(k); l < table.end(k); ++l) {
            const MoveError& move = table.move(k, l);
            row.push_back(limits.allow(move) ? weight(move) : infinity);
        }
    }
    return found;
}

/// One step of D_m(l) = min_k join(D_{m-1}(k), w(k,l)): the new D, and in `from` the k that gave it.
template <typename Join>
std::vector<double>
one_move_more(const Weights& weights, const std::vector<double>& reached, std::vector<int>& from, Join join) {
    std::vector<double> next(reached.size(), infinity);
    for (int k = 0; k < weights.table.size(); ++k) {
        const double before = reached[static_cast<std::size_t>(k)];
        if (!(before < infinity)) {
            continue;
        }
        auto l = static_cast<std::size_t>(weights.table.first(k));
        for (const double weight : weights.rows[static_cast<std::size_t>(k)]) {
            const double value = join(before, weight);
            if (value < next[l]) {
                next[l] = value;
                from[l] = k;
            }
            ++l;
        }
    }
    return next;
}

template <typename Join> std::optional<LatticePath> best_path(const Weights& weights, int moves, Join join) {
    expects(moves >= 1, "a path has a move");
    const auto size = static_cast<std::size_t>(weights.table.size());
    std::vector<double> reached(size, infinity);
    reached.at(0) = 0.0;
    std::vector<std::vector<int>> from(static_cast<std::size_t>(moves), std::vector<int>(size, -1));
    for (std::vector<int>& step : from) {
        reached = one_move_more(weights, reached, step, join);
    }
    if (!(reached.back() < infinity)) {
        return std::nullopt;
    }
    LatticePath path{{weights.table.size() - 1}, reached.back()};
    for (auto step = from.rbegin(); step != from.rend(); ++step) {
        path.nodes.push_back((*step)[static_cast<std::size_t>(path.nodes.back())]);
    }
    std::ranges::reverse(path.nodes);
    return path;
}

} // namespace

MoveTable::MoveTable(const ErrorModel& model,
                     const Track& track,
                     std::vector<double> places,
                     MoveWindow window,
                     Sampling sampling,
                     const Progress& progress,
                     const MoveFilter& filter)
    : places_(std::move(places)) {
    expects(size() >= 2 && std::ranges::is_sorted(places_), "the places of a table ascend");
    std::vector<Vec2> nodes;
    for (const double place : places_) {
        nodes.push_back(track.at(place));
    }
    const auto errors = model.lattice(nodes, sampling);
    for (int k = 0; k < size(); ++k) {
        progress.check();
        const double here = places_[static_cast<std::size_t>(k)];
        const auto after = places_.begin() + k + 1;
        const auto nearest =
            std::lower_bound(after, places_.end(), here + (1.0 - window_slack) * window.shortest);
        const auto beyond =
            std::upper_bound(nearest, places_.end(), here + (1.0 + window_slack) * window.longest);
        Row row{static_cast<int>(nearest - places_.begin()),
                static_cast<int>(beyond - places_.begin()),
                moves_.size()};
        while (filter && row.first < row.end && !filter(k, row.end - 1)) {
            --row.end;
        }
        constexpr MoveError not_measured{.tip = infinity, .axis = infinity};
        for (int l = row.first; l < row.end; ++l) {
            moves_.push_back(!filter || filter(k, l) ? errors->between(k, l) : not_measured);
        }
        rows_.push_back(row);
    }
}

const MoveError& MoveTable::move(int k, int l) const {
    const Row& row = rows_[static_cast<std::size_t>(k)];
    expects(row.first <= l && l < row.end, "a move of a table is inside its window");
    return moves_[row.offset + static_cast<std::size_t>(l - row.first)];
}

void MoveTable::replace(int k, int l, const MoveError& error) {
    const Row& row = rows_[static_cast<std::size_t>(k)];
    expects(row.first <= l && l < row.end, "a move of a table is inside its window");
    moves_[row.offset + static_cast<std::size_t>(l - row.first)] = error;
}

int MoveTable::index_of(double place) const {
    const auto found = std::ranges::lower_bound(places_, place);
    expects(found != places_.end() && exactly_equal(*found, place), "the place is in the lattice");
    return static_cast<int>(found - places_.begin());
}

std::optional<LatticePath>
cheapest_path(const MoveTable& table, int moves, const MoveCost& cost, const MoveLimits& limits) {
    return best_path(weigh(table, limits, cost), moves, [](double sum, double next) { return sum + next; });
}

std::optional<LatticePath>
least_worst_path(const MoveTable& table, int moves, double MoveError::*quantity, const MoveLimits& limits) {
    const auto weight = [quantity](const MoveError& move) { return move.*quantity; };
    const auto worse = [](double worst, double next) { return std::max(worst, next); };
    return best_path(weigh(table, limits, weight), moves, worse);
}

std::optional<LatticePath>
shortest_path(const MoveTable& table, const MoveCost& cost, const MoveLimits& limits) {
    struct Reached {
        int moves = std::numeric_limits<int>::max();
        double sum = infinity;
        int from = -1;
    };
    std::vector<Reached> reached(static_cast<std::size_t>(table.size()));
    reached.at(0) = {0, 0.0, -1};
    for (int k = 0; k < table.size(); ++k) {
        const Reached before = reached[static_cast<std::size_t>(k)];
        for (int l = table.first(k); before.sum < infinity && l < table.end(k); ++l) {
            const MoveError& move = table.move(k, l);
            const double sum = limits.allow(move) ? before.sum + cost(move) : infinity;
            Reached& there = reached[static_cast<std::size_t>(l)];
            const bool fewer = before.moves + 1 < there.moves;
            const bool cheaper = before.moves + 1 == there.moves && sum < there.sum;
            if (sum < infinity && (fewer || cheaper)) {
                there = {before.moves + 1, sum, k};
            }
        }
    }
    if (!(reached.back().sum < infinity)) {
        return std::nullopt;
    }
    LatticePath path{{}, reached.back().sum};
    for (int n = table.size() - 1; n >= 0; n = reached[static_cast<std::size_t>(n)].from) {
        path.nodes.push_back(n);
    }
    std::ranges::reverse(path.nodes);
    return path;
}

std::vector<double> places_of(const MoveTable& table, const LatticePath& path) {
    std::vector<double> places;
    for (const int n : path.nodes) {
        places.push_back(table.places()[static_cast<std::size_t>(n)]);
    }
    return places;
}

TrackPolish::TrackPolish(const ErrorModel& model, PlacedTrack track, const PolishSettings& settings)
    : model_(model), settings_(settings), track_(std::move(track)), steps_(track_.places.size(), 0.0) {
    const std::vector<double>& places = track_.places;
    expects(std::ssize(places) >= 2, "a track has two nodes or more");
    for (std::size_t n = 0; n + 1 < places.size(); ++n) {
        moves_.push_back(move(places[n], places[n + 1]));
        if (n > 0) {
            const double gap = std::min(places[n] - places[n - 1], places[n + 1] - places[n]);
            steps_[n] = settings_.first_step * gap;
        }
    }
}

MoveError TrackPolish::move(double from, double to) const {
    return model_.move(track_.track.at(from), track_.track.at(to), settings_.sampling);
}

bool TrackPolish::try_place(std::size_t node, double place) {
    const std::vector<double>& places = track_.places;
    const double gap_before = std::min(settings_.min_gap, places[node] - places[node - 1]);
    const double gap_after = std::min(settings_.min_gap, places[node + 1] - places[node]);
    if (!(place - places[node - 1] >= gap_before && places[node + 1] - place >= gap_after)) {
        return false;
    }
    const MoveError& old_in = moves_[node - 1];
    const MoveError& old_out = moves_[node];
    const MoveLimits limits{std::max({settings_.limits.tip, old_in.tip, old_out.tip}),
                            std::max({settings_.limits.axis, old_in.axis, old_out.axis})};
    const double old_cost = settings_.cost(old_in) + settings_.cost(old_out);
    const MoveError in = move(places[node - 1], place);
    if (!limits.allow(in) || !(settings_.cost(in) < old_cost)) {
        return false;
    }
    const MoveError out = move(place, places[node + 1]);
    if (!limits.allow(out) || !(settings_.cost(in) + settings_.cost(out) < old_cost)) {
        return false;
    }
    track_.places[node] = place;
    moves_[node - 1] = in;
    moves_[node] = out;
    return true;
}

double TrackPolish::sweep(const Progress& progress) {
    double longest = 0.0;
    for (std::size_t node = 1; node + 1 < track_.places.size(); ++node) {
        progress.check();
        const double here = track_.places[node];
        double& step = steps_[node];
        if (try_place(node, here + step) || try_place(node, here - step)) {
            longest = std::max(longest, std::abs(track_.places[node] - here));
            step *= settings_.growth;
        } else {
            step *= settings_.shrinking;
        }
    }
    return longest;
}

} // namespace millwright::grid
