#include "core/grid/redistribution.h"
#include "core/project/grid_methods/grid_method_row.h"

#include <utility>

namespace millwright::project {

namespace {

std::unique_ptr<grid::GridOptimiser> redistribution(GridStart from) {
    expect_straight_tracks(from.input.direction, from.start);
    const grid::RedistributionSettings settings{.floor = from.input.redistribution.floor,
                                                .smoothings = from.input.redistribution.smoothing_passes};
    return std::make_unique<grid::Redistribution>(
        from.error, std::move(from.start), from.input.direction, settings);
}

} // namespace

constinit const GridMethodRow redistribution_row{
    .id = "redistribution",
    .label = "1-D redistribution",
    .tip = "Equal shares of sqrt(e) / h on each track separately",
    .report_key = "redistribution",
    .short_name = "1-D",
    .caption = "redistributed",
    .title = "Redistributing the nodes of each track",
    .share = 0.05,
    .same_settings = [](const GridInput& a,
                        const GridInput& b) { return a.redistribution == b.redistribution; },
    .optimiser = redistribution};

} // namespace millwright::project
