#include "core/grid/polish.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::grid {

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
