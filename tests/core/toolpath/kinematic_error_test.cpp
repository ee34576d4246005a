#include "core/toolpath/kinematic_error.h"

#include "core/base/units.h"
#include "core/toolpath/error_field.h"
#include "core/toolpath/tool_poses.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/cutters.h"
#include "tests/support/grid_arrays.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

grid::ErrorSummary uniform_summary(const KinematicError& error, int n) {
    return grid::summary(measure(error, Grid::uniform(n, n), TrackDirection::along_u, grid::fine));
}

TEST(KinematicError, AgreesWithTheErrorFieldOfTheWholePath) {
    // The field measures to the surface, the model to the curve: never below it, and equal where the curve is
    // the nearest part of the surface.
    const auto patch = test::patch("two-bell");
    const auto machine = test::machine("ac-table");
    const Grid grid = Grid::uniform(16, 16);
    const Toolpath path = zigzag(patch, grid, TrackDirection::along_v, false);
    const ErrorField field = error_field(patch, machine, path, sequence(machine, path), {10}, {});
    const auto error = test::two_bell_error();
    for (std::size_t n = 0; n < field.moves.size(); ++n) {
        if (field.moves[n].kind != MoveKind::track) {
            continue;
        }
        const auto move = error.move(path.points[n].origin.uv, path.points[n + 1].origin.uv, {10, 200});
        EXPECT_LE(field.moves[n].closest, move.tip + 1e-3) << n;
        EXPECT_LE(move.tip, field.moves[n].param + 1e-3) << n;
    }
}

/// The share of the moves along tracks for which the model says of a tool what the field of the whole path
/// says, to a quarter: the field looks at the whole body, and for the place of the real surface where it is
/// nearest. A tool that leans may be better on the path, which goes along each track one way only.
double agreement(const char* surface, const char* machine_name, const Tool& tool) {
    constexpr int n = 24;
    const auto patch = test::patch(surface);
    const auto machine = test::machine(machine_name);
    const Toolpath contacts = zigzag(patch, Grid::uniform(n, n), TrackDirection::along_v, false);
    const Toolpath path = with_tool(patch, machine, tool, contacts);
    const ErrorField field = error_field(patch, machine, path, sequence(machine, path), {10}, {});
    const KinematicError error(patch, machine, false, tool);
    int moves = 0, agree = 0;
    for (std::size_t m = 0; m < field.moves.size(); ++m) {
        if (field.moves[m].kind == MoveKind::track) {
            const Vec2 from = path.points[m].origin.uv, to = path.points[m + 1].origin.uv;
            const double there = field.moves[m].closest;
            const double here = error.move(from, to, {10, 200}).off_surface;
            const double most = 0.25 * there + 0.01;
            ++moves;
            agree += here - there > -most && (here - there < most || !tool.lean.upright()) ? 1 : 0;
        }
    }
    return static_cast<double>(agree) / moves;
}

TEST(KinematicError, OfACutterIsWhatTheFieldOfThePathSays) {
    const Lean leaning{.lead = from_degrees(8.0), .tilt = from_degrees(3.0)};
    for (const char* surface : {"dome", "two-bell"}) {
        for (const auto& cutter : {test::ball, test::flat_end, test::bull_nose, test::cone}) {
            for (const Lean& lean : {Lean{}, leaning}) {
                EXPECT_GT(agreement(surface, "ac-table", {.cutter = test::body(cutter), .lean = lean}), 0.9)
                    << surface << ", cutter " << static_cast<int>(cutter.kind);
            }
        }
    }
}

/// A router keeps the axis: the rim touches, or the flank of a cone.
TEST(KinematicError, OfACutterOnARouterIsWhatTheFieldOfThePathSays) {
    for (const auto& cutter : test::every_cutter) {
        EXPECT_GT(agreement("two-bell", "router-xyz", {.cutter = test::body(cutter)}), 0.8)
            << static_cast<int>(cutter.kind);
    }
}

/// The path of a tool that leans goes back on each second track, where it leans the other way.
TEST(KinematicError, OfALeaningToolIsTheWorseOfBothWays) {
    const Tool tool{.cutter = test::body(test::flat_end), .lean = {.lead = from_degrees(15.0)}};
    const auto patch = test::patch("dome");
    const KinematicError error(patch, test::machine("ac-table"), false, tool);
    const auto on = error.move({0.3, 0.2}, {0.3, 0.3}, grid::fine);
    const auto back = error.move({0.3, 0.3}, {0.3, 0.2}, grid::fine);
    EXPECT_NEAR(on.tip, back.tip, 1e-6);
    EXPECT_NEAR(on.axis, back.axis, 1e-6);
}

TEST(KinematicError, OfALatticeEqualsThatOfSingleMoves) {
    const Tool bull{.cutter = test::body(test::bull_nose), .lean = {.lead = from_degrees(5.0)}};
    std::vector<Vec2> nodes;
    for (int k = 0; k <= 40; ++k) {
        nodes.emplace_back(0.3, k / 40.0);
    }
    for (const Tool& tool : {Tool{}, bull}) {
        const KinematicError error(test::patch("dome"), test::machine("rotary-tilt-listing"), false, tool);
        const auto lattice = error.lattice(nodes, {10, 16});
        for (const auto& [k, l] : {std::pair{0, 4}, {3, 7}, {10, 18}, {36, 40}, {20, 24}}) {
            const auto pair = lattice->between(k, l);
            const auto single =
                error.move(nodes[static_cast<std::size_t>(k)], nodes[static_cast<std::size_t>(l)], {10, 16});
            EXPECT_NEAR(pair.tip, single.tip, 1e-9);
            EXPECT_NEAR(pair.off_surface, single.off_surface, 1e-9);
            EXPECT_NEAR(pair.axis, single.axis, 1e-9);
            EXPECT_NEAR(pair.length, single.length, 1e-9);
        }
    }
}

TEST(KinematicError, ShrinksWithTheSquareOfTheStepAwayFromPoles) {
    const auto error = test::dome_error();
    const double coarse = error.move({0.2, 0.2}, {0.2, 0.25}, grid::fine).tip;
    const double half = error.move({0.2, 0.2125}, {0.2, 0.2375}, grid::fine).tip;
    EXPECT_NEAR(coarse / half, 4.0, 0.3);
}

TEST(KinematicError, ADegenerateNormalIsOutOfReach) {
    geometry::ControlNet net = test::patch("dome").net();
    for (int j = 0; j < 4; ++j) {
        net.point(0, j) = {10, 10, 1};
    }
    const KinematicError error(geometry::BezierPatch(net), test::machine("ac-table"), false);
    EXPECT_TRUE(std::isinf(error.move({0.0, 0.2}, {0.0, 0.4}, grid::coarse).tip));
}

TEST(TrackGap, OfStraightTracksOnAPlaneIsTheirDistance) {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    net.point(1, 0) = {100, 0, 0};
    net.point(0, 1) = {0, 60, 0};
    net.point(1, 1) = {100, 60, 0};
    const KinematicError error(geometry::BezierPatch(net), test::machine("ac-table"), false);
    EXPECT_NEAR(error.track_gap(Grid::uniform(11, 4), TrackDirection::along_v), 10.0, 1e-12);
    EXPECT_NEAR(error.track_gap(Grid::uniform(11, 4), TrackDirection::along_u), 20.0, 1e-12);
}

Grid bent_grid(int n) {
    grid::NodeArray nodes = grid::displaced_square_grid(n, 0.3);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            nodes.at(i, j) /= n - 1;
        }
    }
    return Grid(nodes);
}

/// Every point of a track against every chord of the next one, and back.
double gap_by_brute_force(const geometry::BezierPatch& patch, const Grid& grid, TrackDirection direction) {
    constexpr int steps = 4; // between two nodes, as track_gap() looks
    const auto line = [&](int track) {
        std::vector<Vec3> points;
        const int nodes = grid.nodes_per_track(direction);
        for (int k = 0; k + 1 < nodes; ++k) {
            const Vec2 a = grid.track_node(direction, track, k), b = grid.track_node(direction, track, k + 1);
            for (int s = 0; s < steps + (k + 2 == nodes ? 1 : 0); ++s) {
                const Vec2 uv = a + (b - a) * s / steps;
                points.push_back(patch.position(uv.x(), uv.y()));
            }
        }
        return points;
    };
    const auto to_chord = [](const Vec3& p, const Vec3& a, const Vec3& b) {
        const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        return (a + t * (b - a) - p).norm();
    };
    double gap = 0.0;
    const auto widen = [&](const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
        for (const Vec3& p : from) {
            double least = 1e300;
            for (std::size_t n = 1; n < to.size(); ++n) {
                least = std::min(least, to_chord(p, to[n - 1], to[n]));
            }
            gap = std::max(gap, least);
        }
    };
    for (int t = 0; t + 1 < grid.track_count(direction); ++t) {
        widen(line(t), line(t + 1));
        widen(line(t + 1), line(t));
    }
    return gap;
}

TEST(TrackGap, OfCurvedTracksIsThatOfBruteForce) {
    for (const char* surface : {"dome", "two-bell", "sine"}) {
        const KinematicError error(test::patch(surface), test::machine("ac-table"), false);
        const Grid grid = bent_grid(14);
        for (const TrackDirection direction : {TrackDirection::along_u, TrackDirection::along_v}) {
            EXPECT_NEAR(error.track_gap(grid, direction),
                        gap_by_brute_force(test::patch(surface), grid, direction),
                        1e-9)
                << surface;
        }
    }
}

TEST(KinematicError, HasTheUniformFiguresOfTheDome) {
    // Independent prototype, moves inside tracks along u, largest distance to the surface curve: max / mean,
    // mm.
    const auto error = test::dome_error();
    const auto at10 = uniform_summary(error, 10), at20 = uniform_summary(error, 20);
    EXPECT_NEAR(at10.max, 15.76, 0.01);
    EXPECT_NEAR(at10.mean, 1.594, 0.001);
    EXPECT_NEAR(at20.max, 15.86, 0.01);
    EXPECT_NEAR(at20.mean, 0.428, 0.001);
    EXPECT_NEAR(to_degrees(at20.axis_max), 23.1, 0.5); // the prototype took the normal at equal parameters
}

/// Straight tracks at equal steps between v = `first` and 1 - `first`, `n` nodes each.
grid::ErrorSummary straight_tracks(const KinematicError& error, int tracks, int n, double first) {
    std::vector<grid::MoveError> moves;
    for (int t = 0; t < tracks; ++t) {
        const double v = first + (1.0 - 2.0 * first) * t / (tracks - 1);
        for (int k = 0; k + 1 < n; ++k) {
            const double step = 1.0 / (n - 1);
            moves.push_back(error.move({k * step, v}, {(k + 1) * step, v}, grid::fine));
        }
    }
    return grid::summary(moves);
}

TEST(KinematicError, HasTheUniformFiguresOfTheTwoBells) {
    const auto error = test::two_bell_error();
    const auto full = uniform_summary(error, 20);
    EXPECT_NEAR(full.max, 6.48, 0.005);
    EXPECT_NEAR(full.mean, 0.734, 0.0005);
    struct Row {
        int n;
        double max, mean;
    };
    for (const auto& [n, max, mean] : {Row{15, 12.37, 1.302},
                                       {20, 11.13, 0.827},
                                       {30, 8.63, 0.387},
                                       {40, 7.04, 0.232},
                                       {60, 8.89, 0.119}}) {
        const auto inner = straight_tracks(error, 20, n, 0.02);
        EXPECT_NEAR(inner.max, max, 0.03) << n;
        EXPECT_NEAR(inner.mean, mean, 0.001) << n;
    }
}

} // namespace
} // namespace millwright::toolpath
