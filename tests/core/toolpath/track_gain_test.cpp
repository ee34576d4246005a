// What the track optimiser is for, on real machines: 20 x 20 nodes on the whole patch, moves inside tracks.
#include "core/base/units.h"
#include "core/grid/track_optimiser.h"
#include "core/toolpath/error_field.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace millwright::toolpath {
namespace {

using grid::ErrorSummary;
using grid::Grid;
using grid::OptimiserState;
using grid::TrackDirection;

struct GainCase {
    std::string preset;
    std::string machine;
    TrackDirection direction = TrackDirection::along_v;

    friend std::ostream& operator<<(std::ostream& out, const GainCase& c) {
        return out << c.preset << (c.direction == TrackDirection::along_v ? " along v" : " along u");
    }
};

const GainCase dome_along_v{"dome", "rotary-tilt-listing", TrackDirection::along_v};
const GainCase dome_along_u{"dome", "rotary-tilt-listing", TrackDirection::along_u};
const GainCase two_bell_along_u{"two-bell", "ac-table", TrackDirection::along_u};
const GainCase two_bell_along_v{"two-bell", "ac-table", TrackDirection::along_v};
const GainCase sine_along_u{"sine", "rotary-tilt-listing", TrackDirection::along_u};
const GainCase sine_along_v{"sine", "rotary-tilt-listing", TrackDirection::along_v};

KinematicError error_of(const GainCase& c) {
    return {test::patch(c.preset), test::machine(c.machine), false};
}

OptimiserState optimised(const GainCase& c, int n, const grid::TrackSettings& settings = {}) {
    const KinematicError error = error_of(c);
    grid::TrackOptimiser optimiser(error, Grid::uniform(n, n), c.direction, settings);
    return run(optimiser, {});
}

/// The error of the whole zigzag path, as people are shown it.
ErrorField zigzag_field(const GainCase& c, const Grid& grid) {
    const auto patch = test::patch(c.preset);
    const auto machine = test::machine(c.machine);
    const Toolpath path = zigzag(patch, grid, c.direction, false);
    return error_field(patch, machine, path, sequence(machine, path), {40}, {});
}

/// Share of `before` by which `after` is less.
double cut(double before, double after) {
    return 1.0 - after / before;
}

class TrackGain : public ::testing::TestWithParam<GainCase> {};

// T17.
TEST_P(TrackGain, CutsTheMeanByFortyFiveAndTheMaxByEightyFivePerCent) {
    const OptimiserState state = optimised(GetParam(), 20);
    EXPECT_GE(cut(state.start.mean, state.of_best.mean), 0.45);
    EXPECT_GE(cut(state.start.max, state.of_best.max), 0.85);
    EXPECT_GE(cut(state.start.lmean, state.of_best.lmean), 0.40);
}

INSTANTIATE_TEST_SUITE_P(OfTheTip,
                         TrackGain,
                         ::testing::Values(dome_along_v, dome_along_u, two_bell_along_u));

class TrackGainOnThePath : public ::testing::TestWithParam<GainCase> {};

TEST_P(TrackGainOnThePath, CutsTheDistanceFromTheSurfaceByAsMuch) {
    const OptimiserState state = optimised(GetParam(), 20);
    const ErrorField before = zigzag_field(GetParam(), Grid::uniform(20, 20));
    const ErrorField after = zigzag_field(GetParam(), state.best);
    const ErrorSummary was = summary(before, Distance::closest, MoveKind::track);
    const ErrorSummary is = summary(after, Distance::closest, MoveKind::track);
    EXPECT_GE(cut(was.mean, is.mean), 0.45);
    EXPECT_GE(cut(was.max, is.max), 0.85);
    EXPECT_GE(cut(was.lmean, is.lmean), 0.40);
}

INSTANTIATE_TEST_SUITE_P(OfShippedProjects,
                         TrackGainOnThePath,
                         ::testing::Values(dome_along_v, two_bell_along_u));

class NeverWorseOnThePath : public ::testing::TestWithParam<GainCase> {};

TEST_P(NeverWorseOnThePath, InAnyDistanceOrTheAxisOrTheTrackGap) {
    for (const grid::TrackSettings& settings : {grid::TrackSettings{}, grid::quick_track_settings()}) {
        const Grid start = Grid::uniform(20, 20);
        const Grid best = optimised(GetParam(), 20, settings).best;
        const ErrorField before = zigzag_field(GetParam(), start);
        const ErrorField after = zigzag_field(GetParam(), best);
        constexpr double rounding_mm = 1e-6;
        for (const Distance distance : {Distance::closest, Distance::param}) {
            const ErrorSummary was = summary(before, distance, MoveKind::track);
            const ErrorSummary is = summary(after, distance, MoveKind::track);
            EXPECT_LE(is.max, was.max + rounding_mm);
            EXPECT_LE(is.mean, was.mean + rounding_mm);
            EXPECT_LE(is.lmean, was.lmean + rounding_mm);
            EXPECT_LE(to_degrees(is.axis_max), to_degrees(was.axis_max) + 1e-6);
        }
        const KinematicError error = error_of(GetParam());
        EXPECT_LE(error.track_gap(best, GetParam().direction),
                  1.15 * error.track_gap(start, GetParam().direction));
    }
}

INSTANTIATE_TEST_SUITE_P(OfAllSurfaces,
                         NeverWorseOnThePath,
                         ::testing::Values(dome_along_v,
                                           dome_along_u,
                                           two_bell_along_u,
                                           two_bell_along_v,
                                           sine_along_u,
                                           sine_along_v));

TEST(TrackGainQuick, KeepsNearlyAllOfTheGainForLiveEditing) {
    for (const GainCase& c : {dome_along_v, two_bell_along_u}) {
        const OptimiserState state = optimised(c, 20, grid::quick_track_settings());
        EXPECT_GE(cut(state.start.mean, state.of_best.mean), 0.43) << c;
        EXPECT_GE(cut(state.start.max, state.of_best.max), 0.85) << c;
    }
}

TEST(TrackGainSmall, IsNoLossOnGridsWithHardlyAnyNodes) {
    for (const int n : {2, 3, 4, 6}) {
        const OptimiserState state = optimised(dome_along_v, n);
        const ErrorSummary was =
            summary(zigzag_field(dome_along_v, Grid::uniform(n, n)), Distance::closest, MoveKind::track);
        const ErrorSummary is =
            summary(zigzag_field(dome_along_v, state.best), Distance::closest, MoveKind::track);
        EXPECT_LE(state.of_best.mean, state.start.mean + 1e-6) << n;
        EXPECT_LE(state.of_best.axis_max, state.start.axis_max + 1e-8) << n;
        EXPECT_LE(is.mean, was.mean * 1.02)
            << n << ": the model's distance off the surface is of first order";
    }
}

} // namespace
} // namespace millwright::toolpath
