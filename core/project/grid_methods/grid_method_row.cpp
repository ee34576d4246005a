#include "core/project/grid_methods/grid_method_row.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <fmt/format.h>

namespace millwright::project {

constinit const GridMethodRow uniform_row{
    .id = "uniform",
    .label = "Uniform",
    .tip = "Equal parameter steps, no adaptation",
    .report_key = "uniform",
    .short_name = "Uniform",
    .caption = "uniform",
    .title = "Measuring the uniform grid",
    .share = 0.1,
    .same_settings = [](const GridInput&, const GridInput&) { return true; }};

void expect_straight_tracks(grid::TrackDirection direction, const grid::Grid& start) {
    const Eigen::Index across = direction == grid::TrackDirection::along_v ? 0 : 1;
    for (int t = 0; t < start.track_count(direction); ++t) {
        const double first = start.track_node(direction, t, 0)[across];
        for (int k = 1; k < start.nodes_per_track(direction); ++k) {
            if (!exactly_equal(start.track_node(direction, t, k)[across], first)) {
                throw Error(fmt::format("track {} of the start grid, counted from 0, is not straight", t),
                            {},
                            "use the elliptic grid or the harmonic map, which start from any grid");
            }
        }
    }
}

} // namespace millwright::project
