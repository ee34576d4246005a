#include "core/plan/grid_method.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/plan/internal/grid_method_rows.h"

#include <fmt/format.h>

#include <array>

namespace millwright::plan {

namespace {

GridMethodRow uniform_row() {
    return {.method = project::GridMethod::uniform,
            .report_key = "uniform",
            .short_name = "Uniform",
            .title = "Measuring the uniform grid",
            .share = 0.1,
            .same_settings = [](const project::GridInput&, const project::GridInput&) { return true; }};
}

} // namespace

std::span<const GridMethodRow> grid_method_rows() {
    static const std::array rows{
        uniform_row(), redistribution_row, elliptic_row, harmonic_row, tracks_row, chain_row};
    static_assert(rows.size() == project::every_grid_method.size());
    return rows;
}

const GridMethodRow& row_of(project::GridMethod method) {
    return grid_method_rows()[static_cast<std::size_t>(method)];
}

/// Throws Error for tracks that bend, which only the elliptic grid and the
/// harmonic map can start from.
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

std::string_view title_of_making(project::GridMethod method) {
    return row_of(method).title;
}

} // namespace millwright::plan
