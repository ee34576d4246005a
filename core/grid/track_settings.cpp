#include "core/grid/track_settings.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/grid/lattice.h"

#include <algorithm>
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

} // namespace millwright::grid
