// One straight track across the domain. A place on it is the parameter that runs along it (v of a track along
// v), so that nodes which stay where they were keep their bytes. Nodes that only slide along straight tracks
// can never fold a cell.
#pragma once

#include "core/grid/grid.h"

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

} // namespace millwright::grid
