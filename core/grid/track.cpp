#include "core/grid/track.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace millwright::grid {

namespace {

PlacedTrack straight_track(const Grid& grid, TrackDirection direction, int t) {
    const bool along_v = direction == TrackDirection::along_v;
    const Vec2& first = grid.track_node(direction, t, 0);
    PlacedTrack found{{direction, along_v ? first.x() : first.y()}, {}};
    for (int k = 0; k < grid.nodes_per_track(direction); ++k) {
        const Vec2& node = grid.track_node(direction, t, k);
        const double across = along_v ? node.x() : node.y();
        const double place = along_v ? node.y() : node.x();
        expects(exactly_equal(across, found.track.across), "a track to be optimised is straight");
        expects(found.places.empty() || found.places.back() < place, "the nodes of a track go forward");
        found.places.push_back(place);
    }
    return found;
}

} // namespace

std::vector<PlacedTrack> straight_tracks(const Grid& grid, TrackDirection direction) {
    std::vector<PlacedTrack> tracks;
    for (int t = 0; t < grid.track_count(direction); ++t) {
        tracks.push_back(straight_track(grid, direction, t));
    }
    return tracks;
}

NodeArray array_of(const std::vector<PlacedTrack>& tracks) {
    expects(!tracks.empty(), "an array of tracks has a track");
    const bool along_v = tracks.front().track.direction == TrackDirection::along_v;
    const int count = static_cast<int>(std::ssize(tracks));
    const int nodes = static_cast<int>(std::ssize(tracks.front().places));
    NodeArray array(along_v ? count : nodes, along_v ? nodes : count);
    for (int t = 0; t < count; ++t) {
        const PlacedTrack& track = tracks[static_cast<std::size_t>(t)];
        expects(std::ssize(track.places) == nodes, "tracks of one grid have equally many nodes");
        for (int k = 0; k < nodes; ++k) {
            const Vec2 uv = track.track.at(track.places[static_cast<std::size_t>(k)]);
            array.at(along_v ? t : k, along_v ? k : t) = uv;
        }
    }
    return array;
}

namespace {

// The error of a short move is a parabola in time: three times find its top, four chords its curve.
constexpr Sampling short_move{3, 4};

void smooth(std::vector<double>& values) {
    const std::vector<double> old = values;
    const std::size_t last = old.size() - 1;
    for (std::size_t n = 0; n < old.size(); ++n) {
        const double before = old[n == 0 ? 0 : n - 1];
        const double after = old[n == last ? last : n + 1];
        values[n] = 0.25 * before + 0.5 * old[n] + 0.25 * after;
    }
}

} // namespace

std::vector<double> monitor(const ErrorModel& model,
                            const Track& track,
                            double first,
                            double last,
                            int cells,
                            int smoothings,
                            const Progress& progress) {
    expects(cells >= 1 && first < last, "a monitor has cells");
    std::vector<Vec2> nodes;
    for (int n = 0; n <= cells; ++n) {
        nodes.push_back(track.at(mix(first, last, static_cast<double>(n) / cells)));
    }
    const auto moves = model.lattice(nodes, short_move);
    std::vector<double> found;
    for (int n = 0; n < cells; ++n) {
        progress.check();
        const double error = moves->between(n, n + 1).tip;
        found.push_back(std::isfinite(error) ? std::sqrt(error) * cells : 0.0);
    }
    for (int pass = 0; pass < smoothings; ++pass) {
        smooth(found);
    }
    const double mean = std::accumulate(found.begin(), found.end(), 0.0) / cells;
    for (double& value : found) {
        value = mean > 0.0 ? value / mean : 1.0;
    }
    return found;
}

std::vector<double> equal_shares(std::span<const double> density, double first, double last, int intervals) {
    expects(!density.empty() && intervals >= 1, "shares are taken of a density");
    expects(std::ranges::all_of(density, [](double d) { return d > 0.0; }), "a density is positive");
    const double total = std::accumulate(density.begin(), density.end(), 0.0);
    const auto cells = static_cast<double>(density.size());
    std::vector<double> places{first};
    std::size_t cell = 0;
    double before = 0.0; // the share of the cells that are passed
    for (int n = 1; n < intervals; ++n) {
        const double wanted = total * n / intervals;
        while (cell + 1 < density.size() && before + density[cell] < wanted) {
            before += density[cell++];
        }
        const double inside = std::clamp((wanted - before) / density[cell], 0.0, 1.0);
        places.push_back(mix(first, last, (static_cast<double>(cell) + inside) / cells));
    }
    places.push_back(last);
    return places;
}

std::vector<double> through(std::vector<double> places, std::span<const double> nodes) {
    std::vector<double> added;
    std::vector<bool> taken(places.size(), false);
    for (const double node : nodes) {
        const auto above = std::ranges::lower_bound(places, node);
        auto nearest = above == places.end() ? above - 1 : above;
        if (above != places.begin() && above != places.end() && node - *(above - 1) < *above - node) {
            nearest = above - 1;
        }
        const auto n = static_cast<std::size_t>(nearest - places.begin());
        if (taken[n]) {
            added.push_back(node);
        } else {
            taken[n] = true;
            *nearest = node;
        }
    }
    places.insert(places.end(), added.begin(), added.end());
    std::ranges::sort(places);
    return places;
}

std::vector<double> lattice(const ErrorModel& model,
                            const PlacedTrack& start,
                            const LatticeSettings& settings,
                            const Progress& progress) {
    expects(std::ssize(start.places) >= 2, "a track has two nodes or more");
    const double first = start.places.front();
    const double last = start.places.back();
    std::vector<double> density =
        monitor(model, start.track, first, last, 2 * settings.intervals, settings.smoothings, progress);
    for (double& value : density) {
        value = mix(1.0, value, settings.monitor_share);
    }
    return through(equal_shares(density, first, last, settings.intervals), start.places);
}

} // namespace millwright::grid
