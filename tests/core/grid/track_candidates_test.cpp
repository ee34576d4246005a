#include "core/grid/track_candidates.h"

#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

namespace millwright::grid {
namespace {

constexpr int a_gap = 4;
constexpr int track_count = 6;

TrackCandidates candidates_of(const ErrorModel& model, int polish_sweeps) {
    TrackSettings settings;
    settings.lattice = 60;
    settings.length_share = 1.0;
    settings.polish_sweeps = polish_sweeps;
    return {model,
            straight_tracks(Grid::uniform(track_count, 9), TrackDirection::along_v),
            a_gap,
            checked(settings, 9),
            Progress()};
}

double squared_tip_cost(const ErrorModel& model, const std::vector<PlacedTrack>& placed) {
    double cost = 0.0;
    for (const MoveError& move : measure(model, Grid(array_of(placed)), TrackDirection::along_v, coarse)) {
        cost += move.length * move.tip * move.tip;
    }
    return cost;
}

TEST(TrackCandidates, AWholeGapApartAreTheTracksOfTheStart) {
    const SpikeErrorModel model({});
    const auto found = candidates_of(model, 0).cheapest(a_gap, a_gap, Progress());
    ASSERT_TRUE(found);
    ASSERT_EQ(found->size(), 6U);
    for (std::size_t t = 0; t < found->size(); ++t) {
        EXPECT_NEAR((*found)[t].track.across, static_cast<double>(t) / (track_count - 1), 1e-15);
        EXPECT_EQ((*found)[t].places.size(), 9U);
    }
}

TEST(TrackCandidates, MoreFreedomCostsLessAndPolishingToo) {
    const SpikeErrorModel model({});
    const TrackCandidates rough = candidates_of(model, 0);
    const auto bound = rough.cheapest(a_gap, a_gap, Progress());
    const auto free = rough.cheapest(a_gap - 1, a_gap + 1, Progress());
    const auto polished = candidates_of(model, 5).cheapest(a_gap - 1, a_gap + 1, Progress());
    ASSERT_TRUE(bound && free && polished);
    EXPECT_LT(squared_tip_cost(model, *free), squared_tip_cost(model, *bound));
    EXPECT_LT(squared_tip_cost(model, *polished), squared_tip_cost(model, *free));
}

TEST(TrackCandidates, HaveNoChoiceThatDoesNotReachTheLastTrack) {
    const SpikeErrorModel model({});
    EXPECT_FALSE(candidates_of(model, 0).cheapest(1, a_gap - 1, Progress()));
}

} // namespace
} // namespace millwright::grid
