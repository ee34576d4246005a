#include "core/grid/quality_guard.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

namespace millwright::grid {
namespace {

/// Three tracks of two moves; `tip` and `axis` of every move.
std::vector<MeasuredTrack> three_tracks(double tip, double axis, double middle = 0.5) {
    std::vector<MeasuredTrack> found;
    for (const double across : {0.0, 0.5, 1.0}) {
        const MoveError move{tip, axis, 50.0, tip / 2.0, tip};
        found.push_back({{{TrackDirection::along_v, across}, {0.0, middle, 1.0}}, {move, move}});
    }
    return found;
}

/// Only its track gap is used: the distance of nodes of equal number.
const SpikeErrorModel guarded_model({});

class NeverWorse : public ::testing::Test {
protected:
    GuardedTracks guarded(const std::vector<std::vector<MeasuredTrack>>& versions,
                          double gap_allowance = 0.15) {
        const TrackQualityLimits limits = quality_limits_of(guarded_model, start_, gap_allowance, {});
        return never_worse(guarded_model, versions, start_, limits, {});
    }
    std::vector<MeasuredTrack> start_ = three_tracks(1.0, 0.2);
    std::vector<MeasuredTrack> good_ = three_tracks(0.5, 0.1, 0.55);
    std::vector<MeasuredTrack> better_ = three_tracks(0.3, 0.1, 0.6);
};

TEST_F(NeverWorse, TakesTheMostWantedVersion) {
    const GuardedTracks found = guarded({better_, good_});
    EXPECT_EQ(found.kept_from_start, 0);
    for (const MeasuredTrack& track : found.tracks) {
        EXPECT_EQ(track.placed.places[1], 0.6);
    }
}

TEST_F(NeverWorse, TakesTheNextVersionOfATrackThatBreaksTheAxisPromise) {
    better_[1].moves[0].axis = 0.21;
    const GuardedTracks found = guarded({better_, good_});
    EXPECT_EQ(found.tracks[0].placed.places[1], 0.6);
    EXPECT_EQ(found.tracks[1].placed.places[1], 0.55);
    EXPECT_EQ(found.kept_from_start, 0);
}

TEST_F(NeverWorse, KeepsTheStartOfATrackThatHasNoGoodVersion) {
    better_[2].moves[1].tip = 1.1;
    good_[2].moves[1].axis = 0.3;
    const GuardedTracks found = guarded({better_, good_});
    EXPECT_EQ(found.tracks[2].placed.places, start_[2].placed.places);
    EXPECT_EQ(found.kept_from_start, 1);
}

TEST_F(NeverWorse, AcceptsAWorseTrackInABetterGridButNotInAWorseOne) {
    better_[0].moves[0].param = 1.0; // not above the start's largest
    better_[0].moves[1].param = 1.0;
    better_[0].moves[0].tip = better_[0].moves[1].tip = 1.0;
    EXPECT_EQ(guarded({better_}).kept_from_start, 0);

    for (MeasuredTrack& track : better_) { // now the distance at equal parameters rises in the whole grid
        track.moves[0].param = 1.2;
    }
    EXPECT_EQ(guarded({better_}).kept_from_start, 3);
}

TEST_F(NeverWorse, ClosesAGapThatIsTooWide) {
    better_[1].placed.places[1] = 0.95; // node 1 of track 1 far from its neighbours
    good_[1].placed.places[1] = 0.55;
    const GuardedTracks found = guarded({better_, good_});
    EXPECT_EQ(found.tracks[1].placed.places[1], 0.55);
    EXPECT_EQ(found.kept_from_start, 0);
    EXPECT_EQ(guarded({better_, good_}, 10.0).tracks[1].placed.places[1], 0.95);
}

TEST_F(NeverWorse, IgnoresRoundingOfAnErrorThatIsNoneAtAll) {
    start_ = three_tracks(1e-13, 1e-13);
    EXPECT_EQ(guarded({three_tracks(2e-13, 2e-13)}).kept_from_start, 0);
}

} // namespace
} // namespace millwright::grid
