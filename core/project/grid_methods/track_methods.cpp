// The track optimiser, and the whole chain that begins with it.
#include "core/grid/chain_optimiser.h"
#include "core/grid/track_optimiser.h"
#include "core/project/grid_methods/grid_method_row.h"

#include <algorithm>
#include <utility>

namespace millwright::project {

namespace {

int nodes_per_track(const GridInput& input) {
    return input.direction == grid::TrackDirection::along_v ? input.nv : input.nu;
}

grid::TrackSettings track_settings(const GridInput& input, Effort effort) {
    grid::TrackSettings settings =
        effort == Effort::live ? grid::quick_track_settings() : grid::TrackSettings{};
    settings.error_exponent = input.tracks.error_exponent;
    settings.axis_weight_mm_per_deg = input.tracks.axis_weight;
    if (effort == Effort::full) {
        settings.lattice = input.tracks.lattice;
        settings.polish_sweeps = input.tracks.polish_sweeps;
    }
    if (settings.lattice > 0) {
        settings.lattice = std::max(settings.lattice, nodes_per_track(input));
    }
    return settings;
}

grid::ChainSettings chain_settings(const GridInput& input) {
    grid::ChainSettings settings;
    settings.tracks.error_exponent = input.tracks.error_exponent;
    settings.tracks.axis_weight_mm_per_deg = input.tracks.axis_weight;
    settings.tracks.polish_sweeps = input.tracks.polish_sweeps;
    settings.tracks.gap_allowance = input.chain.gap_percent / 100.0;
    settings.tracks.lattice =
        input.tracks.lattice > 0 ? std::max(input.tracks.lattice, nodes_per_track(input)) : 0;
    settings.first_descent = input.chain.first_iterations;
    settings.later_descents = input.chain.later_iterations;
    return settings;
}

std::unique_ptr<grid::GridOptimiser> track_optimiser(GridStart from) {
    expect_straight_tracks(from.input.direction, from.start);
    return std::make_unique<grid::TrackOptimiser>(
        from.error, std::move(from.start), from.input.direction, track_settings(from.input, from.effort));
}

std::unique_ptr<grid::GridOptimiser> chain_optimiser(GridStart from) {
    expect_straight_tracks(from.input.direction, from.start);
    return std::make_unique<grid::ChainOptimiser>(
        from.error, std::move(from.start), from.input.direction, chain_settings(from.input));
}

} // namespace

constinit const GridMethodRow tracks_row{
    .id = "tracks",
    .label = "Track optimiser",
    .tip = "Places the nodes of each track so that its error is smallest",
    .report_key = "optimised",
    .short_name = "Tracks",
    .caption = "optimised",
    .title = "Optimising the tracks",
    .share = 0.4,
    .compared = true,
    .follows_drag = true,
    .same_settings = [](const GridInput& a, const GridInput& b) { return a.tracks == b.tracks; },
    .optimiser = track_optimiser};

constinit const GridMethodRow chain_row{
    .id = "chain",
    .label = "Whole chain",
    .tip = "Chooses tracks, places their nodes, then moves all nodes at once; slow",
    .report_key = "chain",
    .short_name = "Chain",
    .caption = "whole chain",
    .title = "Moving all nodes at once",
    .share = 3.0,
    .same_settings = [](const GridInput& a,
                        const GridInput& b) { return a.tracks == b.tracks && a.chain == b.chain; },
    .optimiser = chain_optimiser};

} // namespace millwright::project
