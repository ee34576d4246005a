#include "core/grid/redistribution.h"
#include "core/plan/internal/grid_method_rows.h"

#include <utility>

namespace millwright::plan {

namespace {

std::unique_ptr<grid::GridOptimiser> redistribution(GridStart from) {
    expect_straight_tracks(from.input.direction, from.start);
    const grid::RedistributionSettings settings{.floor = from.input.redistribution.floor,
                                                .smoothings = from.input.redistribution.smoothing_passes};
    return std::make_unique<grid::Redistribution>(
        from.error, std::move(from.start), from.input.direction, settings);
}

} // namespace

const GridMethodRow redistribution_row{
    .method = project::GridMethod::redistribution,
    .report_key = "redistribution",
    .short_name = "1-D",
    .title = "Redistributing the nodes of each track",
    .share = 0.05,
    .same_settings = [](const project::GridInput& a,
                        const project::GridInput& b) { return a.redistribution == b.redistribution; },
    .optimiser = redistribution};

} // namespace millwright::plan
