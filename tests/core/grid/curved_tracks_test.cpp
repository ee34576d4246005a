#include "core/grid/curved_tracks.h"

#include "core/base/parallel.h"
#include "core/grid/path_descent.h"
#include "tests/support/shaken_nodes.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace millwright::grid {
namespace {

PathObjective unit_cost_objective(const ErrorModel& model, const NodeArray& nodes, TrackDirection direction) {
    PathObjectiveSettings settings;
    settings.unit_cost = 0.05;
    return {model, direction, nodes, settings};
}

class BentTracks : public ::testing::TestWithParam<TrackDirection> {
protected:
    const SpikeErrorModel spike_{{}};
};

/// The least value over all ways to put the two nodes inside the middle track of 3 x 4, and the two at its
/// ends, on the places around where they are in `nodes`.
double
least_by_trying_all(const PathObjective& f, const NodeArray& nodes, const CurvedTrackSettings& settings) {
    const bool along_v = f.direction() == TrackDirection::along_v;
    const auto node = [&](int k) { return along_v ? nodes.index(1, k) : nodes.index(k, 1); };
    const Vec2 along = (along_v ? Vec2(0.0, 1.0) : Vec2(1.0, 0.0)).cwiseProduct(f.cell());
    const Vec2 across = f.cell() - along;
    std::vector<Vec2> inside, at_ends;
    for (int a = -settings.places_across; a <= settings.places_across; ++a) {
        const Vec2 sideways = settings.reach * a / settings.places_across * across;
        at_ends.push_back(sideways);
        for (int b = -settings.places_along; b <= settings.places_along; ++b) {
            inside.emplace_back(sideways + settings.reach * b / settings.places_along * along);
        }
    }
    double least = std::numeric_limits<double>::infinity();
    NodeArray tried = nodes;
    for (const Vec2& first : at_ends) {
        tried.nodes[node(0)] = nodes.nodes[node(0)] + first;
        for (const Vec2& second : inside) {
            tried.nodes[node(1)] = nodes.nodes[node(1)] + second;
            for (const Vec2& third : inside) {
                tried.nodes[node(2)] = nodes.nodes[node(2)] + third;
                for (const Vec2& last : at_ends) {
                    tried.nodes[node(3)] = nodes.nodes[node(3)] + last;
                    least = std::min(least, f.value(tried, {}));
                }
            }
        }
    }
    return least;
}

TEST_P(BentTracks, FindWhatTryingAllPlacesFinds) {
    const bool along_v = GetParam() == TrackDirection::along_v;
    const NodeArray nodes = along_v ? test::shaken(3, 4, 0.2) : test::shaken(4, 3, 0.2);
    const PathObjective f = unit_cost_objective(spike_, nodes, GetParam());
    const CurvedTrackSettings settings{.places_along = 2, .places_across = 1, .reach = 0.25};
    const NodeArray found = shortest_curved_tracks(f, nodes, settings, {});
    NodeArray before = found; // the outer tracks have gone first
    for (int k = 0; k < 4; ++k) {
        const std::size_t n = along_v ? nodes.index(1, k) : nodes.index(k, 1);
        before.nodes[n] = nodes.nodes[n];
    }
    EXPECT_LE(f.value(before, {}), f.value(nodes, {}));
    EXPECT_LT(f.value(found, {}), f.value(before, {}));
    EXPECT_NEAR(f.value(found, {}), least_by_trying_all(f, before, settings), 1e-12 * f.value(before, {}));
}

TEST_P(BentTracks, NeverRiseAndFoldNothing) {
    NodeArray nodes = test::shaken(9, 10, 0.3);
    const PathObjective f = unit_cost_objective(spike_, nodes, GetParam());
    double before = f.value(nodes, {});
    ASSERT_TRUE(std::isfinite(before));
    for (const double reach : {1.5, 0.8, 0.3, 0.1}) {
        const NodeArray found = shortest_curved_tracks(f, nodes, {.reach = reach}, {});
        const double now = f.value(found, {});
        EXPECT_LE(now, before * (1.0 + 1e-12));
        EXPECT_GT(min_corner_jacobian(found), 0.0);
        EXPECT_EQ(found.at(0, 0), nodes.at(0, 0));
        EXPECT_EQ(found.at(8, 9), nodes.at(8, 9));
        EXPECT_EQ(found.at(8, 4).x(), 1.0);
        nodes = found;
        before = now;
    }
}

TEST_P(BentTracks, AreTheSameBytesOnAnyNumberOfThreads) {
    const NodeArray nodes = test::shaken(8, 7, 0.2);
    const PathObjective f = unit_cost_objective(spike_, nodes, GetParam());
    set_thread_count(1);
    const NodeArray alone = shortest_curved_tracks(f, nodes, {}, {});
    for (const int threads : {2, 8}) {
        set_thread_count(threads);
        EXPECT_EQ(shortest_curved_tracks(f, nodes, {}, {}).nodes, alone.nodes);
    }
    set_thread_count(0);
}

/// Ridges across a slope, seven in a cell of six nodes.
class RidgedErrorModel final : public ClosedFormErrorModel {
public:
    [[nodiscard]] MoveError move(const Vec2& a, const Vec2& b, Sampling) const override {
        const Vec2 middle = 0.5 * (a + b);
        const double slope = 0.3 * (middle - Vec2(0.45, 0.55)).norm();
        return {0.3 + slope + 0.1 * std::sin(220.0 * (middle.x() + middle.y())), 0.0, size * (b - a).norm()};
    }
};

TEST_P(BentTracks, ADescentLeapsOverRidges) {
    const RidgedErrorModel ridged;
    const NodeArray start = test::shaken(6, 6, 0.15);
    PathDescent descent(unit_cost_objective(ridged, start, GetParam()), start, {});
    while (descent.iterate({})) {
    }
    const double at_rest = descent.value();
    EXPECT_FALSE(descent.iterate({}));
    ASSERT_TRUE(descent.leap({}));
    EXPECT_LT(descent.value(), 0.999 * at_rest);
    EXPECT_GT(min_corner_jacobian(descent.nodes()), 0.0);
    EXPECT_TRUE(descent.iterate({})); // on from there
}

INSTANTIATE_TEST_SUITE_P(BothWays,
                         BentTracks,
                         ::testing::Values(TrackDirection::along_u, TrackDirection::along_v));

} // namespace
} // namespace millwright::grid
