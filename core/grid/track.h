// One straight track across the domain. A place on it is the parameter that runs along it (v of a track along
// v), so that nodes which stay where they were keep their bytes. Nodes that only slide along straight tracks
// can never fold a cell.
#pragma once

#include "core/base/progress.h"
#include "core/grid/error_model.h"
#include "core/grid/grid.h"

#include <span>
#include <vector>

namespace millwright::grid {

struct Track {
    TrackDirection direction = TrackDirection::along_v;
    double across = 0.0; ///< the parameter that is the same all along

    [[nodiscard]] Vec2 at(double place) const {
        return direction == TrackDirection::along_v ? Vec2(across, place) : Vec2(place, across);
    }
};

/// A track with where its nodes lie, ascending.
struct PlacedTrack {
    Track track;
    std::vector<double> places;
};

/// The tracks of `grid`. Throws Defect unless each is a line of one constant parameter, exactly.
[[nodiscard]] std::vector<PlacedTrack> straight_tracks(const Grid& grid, TrackDirection direction);

/// The nodes of all tracks, which have the same direction and the same number of places, as an array.
[[nodiscard]] NodeArray array_of(const std::vector<PlacedTrack>& tracks);

// The fine lattice of a track: the places that its nodes are chosen from. Denser where the error of short
// moves is large: half of its density is uniform, half follows the monitor sqrt(e / h^2), to which the best
// spacing of nodes is proportional away from the machine's singular points.

struct LatticeSettings {
    int intervals = 160;        ///< of the lattice
    double monitor_share = 0.5; ///< of the density that follows the monitor, 0 to 0.99
    int smoothings = 3;         ///< binomial passes over the monitor
};

/// sqrt(e / h^2) of `cells` equal short moves between `first` and `last`, smoothed, scaled to mean 1.
/// All 1 where there is no error at all; moves out of reach count as none.
[[nodiscard]] std::vector<double> monitor(const ErrorModel& model,
                                          const Track& track,
                                          double first,
                                          double last,
                                          int cells,
                                          int smoothings,
                                          const Progress& progress);

/// `intervals` + 1 places from `first` to `last` with equal shares of `density`, which is constant on equal
/// cells. Both ends exact. Throws Defect unless the density is positive.
[[nodiscard]] std::vector<double>
equal_shares(std::span<const double> density, double first, double last, int intervals);

/// `places`, ascending, with the nearest place of each of `nodes` moved onto it, or a place added where two
/// nodes have the same nearest one.
[[nodiscard]] std::vector<double> through(std::vector<double> places, std::span<const double> nodes);

/// The lattice of `start`'s track. Every node of `start` is in it, so that the best path on the lattice is
/// never worse than the start. Throws Cancelled.
[[nodiscard]] std::vector<double> lattice(const ErrorModel& model,
                                          const PlacedTrack& start,
                                          const LatticeSettings& settings,
                                          const Progress& progress);

} // namespace millwright::grid
