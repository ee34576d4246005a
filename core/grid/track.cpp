#include "core/grid/track.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

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

} // namespace millwright::grid
