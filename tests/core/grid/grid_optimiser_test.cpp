#include "core/grid/grid_optimiser.h"

#include "core/base/error.h"
#include "core/grid/chain_optimiser.h"
#include "core/grid/elliptic_adaptation.h"
#include "core/grid/redistribution.h"
#include "core/grid/track_optimiser.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stop_token>

namespace millwright::grid {
namespace {

/// Needs `steps` steps and does nothing in them.
class Counting final : public GridOptimiser {
public:
    explicit Counting(int steps) : left_(steps) {}

    bool advance(const Progress& progress) override {
        progress.check();
        ++state_.round;
        return --left_ > 0;
    }
    [[nodiscard]] const OptimiserState& state() const override { return state_; }

private:
    int left_;
    OptimiserState state_{
        .current = {}, .best = Grid::uniform(2, 2), .start = {}, .now = {}, .of_best = {}, .note = {}};
};

TEST(Run, AdvancesUntilThereIsNothingMoreToDo) {
    Counting optimiser(5);
    EXPECT_EQ(run(optimiser, Progress()).round, 5);
}

/// A step tells no more than what is done after it, the whole is done at the end only. The looks at it that
/// differ.
std::set<double> told_by(GridOptimiser& optimiser) {
    std::set<double> told;
    double last = 0.0;
    const Progress progress(
        [&](const Progress::Report& now) {
            EXPECT_LT(now.fraction, 1.0) << now.text;
            told.insert(last = now.fraction);
        },
        {});
    double before = 0.0;
    while (optimiser.advance(progress)) {
        EXPECT_GE(optimiser.state().done, before);
        EXPECT_LT(optimiser.state().done, 1.0);
        EXPECT_LE(last, optimiser.state().done + 1e-12) << optimiser.state().note;
        before = optimiser.state().done;
    }
    EXPECT_EQ(optimiser.state().done, 1.0);
    return told;
}

double largest_jump(const std::set<double>& told) {
    double largest = 0.0;
    double last = 0.0;
    for (const double fraction : told) {
        largest = std::max(largest, fraction - last);
        last = fraction;
    }
    return std::max(largest, 1.0 - last);
}

const SpikeErrorModel narrow_spike({.width = 0.02});

TEST(Optimiser, TheChainTellsTrulyHowFarItIs) {
    ChainSettings settings;
    settings.tracks.gap_allowance = 2.0;
    settings.first_descent = 40;
    settings.later_descents = 20;
    ChainOptimiser chain(narrow_spike, Grid::uniform(8, 10), TrackDirection::along_v, settings);
    const std::set<double> told = told_by(chain);
    EXPECT_GT(told.size(), 100U);
    EXPECT_LT(largest_jump(told), 0.2);
}

TEST(Optimiser, TheTracksTellTrulyHowFarTheyAre) {
    TrackSettings settings;
    settings.lattice = 60;
    settings.gap_allowance = 2.0;
    TrackOptimiser tracks(narrow_spike, Grid::uniform(8, 10), TrackDirection::along_v, settings);
    EXPECT_GT(told_by(tracks).size(), 20U);
}

TEST(Optimiser, TheOthersTellTrulyHowFarTheyAre) {
    EllipticAdaptation elliptic(narrow_spike, Grid::uniform(12, 12), EllipticAdaptationSettings{});
    EXPECT_GT(told_by(elliptic).size(), 3U);
    Redistribution shares(
        narrow_spike, Grid::uniform(8, 10), TrackDirection::along_v, RedistributionSettings{});
    EXPECT_GT(told_by(shares).size(), 3U);
}

TEST(Run, EndsWhenCancelled) {
    Counting optimiser(5);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)run(optimiser, Progress(nullptr, stop.get_token())), Cancelled);
    EXPECT_EQ(optimiser.state().round, 0);
}

} // namespace
} // namespace millwright::grid
