// What the elliptic adaptation is worth on real surfaces and machines, 20 x 20 nodes. Mean error, uniform ->
// adapted, to the surface and on the whole path: dome on the thesis's machine along v .211 -> .164 mm (22 %),
// two bells on the A-on-C table along u .336 -> .303 (10 %), along v .098 -> .080 (18 %).
// The harmonic map: 35 and 35 % on the dome along u and v, 27 and 37 % on the bells. The nodes of each track
// shared out by the monitor: 36, 40, 31 and 37 %, and the largest error falls by 93, 94, 53 and 94 %.
#include "core/grid/elliptic_adaptation.h"
#include "core/grid/quality_guard.h"
#include "core/grid/redistribution.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

constexpr double promised = 0.93; // of the uniform grid's mean error, at most

grid::OptimiserState adapted(const KinematicError& error, int n, TrackDirection direction) {
    grid::EllipticAdaptation adaptation(error, Grid::uniform(n, n), {.direction = direction});
    return grid::run(adaptation, Progress());
}

grid::ErrorSummary to_the_curve(const KinematicError& error, const Grid& grid, TrackDirection direction) {
    return grid::summary(measure(error, grid, direction, grid::fine));
}

void expect_gain(const KinematicError& error, TrackDirection direction) {
    const Grid uniform = Grid::uniform(20, 20);
    const grid::OptimiserState state = adapted(error, 20, direction);
    EXPECT_GT(state.best.min_jacobian(), 0.0);
    EXPECT_NE(state.status, grid::OptimiserStatus::no_gain);

    const grid::ErrorSummary before = error.on_path(uniform, direction, {});
    const grid::ErrorSummary after = error.on_path(state.best, direction, {});
    EXPECT_LT(after.mean, promised * before.mean);
    EXPECT_LE(after.max, before.max);
    EXPECT_LE(after.axis_max, before.axis_max);
    EXPECT_LT(to_the_curve(error, state.best, direction).mean,
              promised * to_the_curve(error, uniform, direction).mean);
}

// T17.
TEST(EllipticGain, OnTheDomeAndTheThesisMachineIsAtLeastSevenPercent) {
    expect_gain(test::dome_error(), TrackDirection::along_u);
    expect_gain(test::dome_error(), TrackDirection::along_v);
}

TEST(EllipticGain, OnTwoBellsAndTheACTableIsAtLeastSevenPercent) {
    expect_gain(test::two_bell_error(), TrackDirection::along_u);
    expect_gain(test::two_bell_error(), TrackDirection::along_v);
}

TEST(EllipticGain, IsNeverNegativeWhateverTheSize) {
    // Odd sizes have nodes on the poles: there the uniform grid is hard to beat.
    for (const int n : {7, 12, 15}) {
        for (const KinematicError& error : {test::dome_error(), test::two_bell_error()}) {
            const grid::OptimiserState state = adapted(error, n, TrackDirection::along_v);
            EXPECT_LE(error.on_path(state.best, TrackDirection::along_v, {}).mean,
                      error.on_path(Grid::uniform(n, n), TrackDirection::along_v, {}).mean)
                << n;
        }
    }
}

TEST(EllipticGain, IsZeroWhereTheTracksAreRulings) {
    const KinematicError error(test::patch("sine"), test::machine("rotary-tilt-listing"), false);
    EXPECT_EQ(adapted(error, 10, TrackDirection::along_v).status, grid::OptimiserStatus::no_gain);
}

/// Both keep the tracks where they are, so that the scallops stay what they were.
void expect_gain_along_tracks(grid::GridOptimiser& optimiser,
                              const KinematicError& error,
                              TrackDirection direction,
                              double least_gain) {
    const Grid uniform = Grid::uniform(20, 20);
    const grid::OptimiserState state = grid::run(optimiser, Progress());
    const grid::ErrorSummary before = error.on_path(uniform, direction, {});
    const grid::ErrorSummary after = error.on_path(state.best, direction, {});
    EXPECT_LT(after.mean, (1.0 - least_gain) * before.mean);
    EXPECT_LE(after.max, before.max + grid::negligible_mm);
    EXPECT_LE(after.axis_max, before.axis_max + grid::negligible_rad);
    EXPECT_LE(error.track_gap(state.best, direction), 1.15 * error.track_gap(uniform, direction));
}

TEST(EllipticGain, OfTheHarmonicMapIsTwiceThatOfTheVolumeTerm) {
    for (const KinematicError& error : {test::dome_error(), test::two_bell_error()}) {
        for (const TrackDirection direction : {TrackDirection::along_u, TrackDirection::along_v}) {
            grid::EllipticAdaptationSettings settings = grid::harmonic_settings();
            settings.direction = direction;
            grid::EllipticAdaptation harmonic(error, Grid::uniform(20, 20), settings);
            expect_gain_along_tracks(harmonic, error, direction, 0.23);
        }
    }
}

TEST(EllipticGain, OfSharingOutTheNodesOfEachTrackIsThatOfTheHarmonicMap) {
    for (const KinematicError& error : {test::dome_error(), test::two_bell_error()}) {
        for (const TrackDirection direction : {TrackDirection::along_u, TrackDirection::along_v}) {
            grid::Redistribution redistribution(error, Grid::uniform(20, 20), direction);
            expect_gain_along_tracks(redistribution, error, direction, 0.28);
        }
    }
}

} // namespace
} // namespace millwright::toolpath
