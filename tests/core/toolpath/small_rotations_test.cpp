#include "core/base/error.h"
#include "core/base/units.h"
#include "core/toolpath/error_field.h"
#include "core/toolpath/sequenced_path.h"
#include "core/toolpath/shortest_sequence.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;
using kinematics::MachineModel;

Toolpath path_over_tracks(const char* preset, int nodes, int tracks) {
    return zigzag(test::patch(preset), Grid::uniform(nodes, tracks), TrackDirection::along_u, false);
}

double
worst_tip(const char* preset, const MachineModel& machine, const Toolpath& path, const AxisPath& axes) {
    const ErrorField field = error_field(test::patch(preset), machine, path, axes, {20}, {});
    return summary(field, Distance::closest, MoveKind::track).max;
}

TEST(SmallRotations, KeepTheLimitAndCutTheWorstMoves) {
    for (const char* name : {"ac-table", "rotary-tilt-listing", "bc-table-head"}) {
        const MachineModel machine = test::machine(name);
        const Toolpath path = path_over_tracks("two-bell", 20, 8); // no track meets a singular point exactly
        const AxisPath axes = sequence(machine, path);
        const double before = largest_rotary_step(machine, path, axes, MoveKind::track);
        ASSERT_GT(before, from_degrees(60.0)) << name;
        for (const double deg : {30.0, 10.0, 5.0}) {
            const Toolpath finer =
                with_small_rotations(test::patch("two-bell"), machine, path, axes, from_degrees(deg), {});
            const AxisPath after = sequence(machine, finer);
            EXPECT_LE(largest_rotary_step(machine, finer, after, MoveKind::track), from_degrees(deg)) << name;
            EXPECT_GT(finer.points.size(), path.points.size());
            if (deg < 20.0) {
                EXPECT_LT(worst_tip("two-bell", machine, finer, after),
                          0.3 * worst_tip("two-bell", machine, path, axes))
                    << name;
            }
        }
    }
}

TEST(SmallRotations, HoldOnATableWhoseBranchesTurnDifferently) {
    const MachineModel machine = test::machine("tilted-c-table");
    for (const SequencingGoal goal : {SequencingGoal::nearest, SequencingGoal::travel}) {
        const SequencingSettings settings{.goal = goal, .largest_step = from_degrees(15.0)};
        const SequencedPath found =
            sequenced(test::patch("two-bell"), machine, path_over_tracks("two-bell", 20, 8), settings, {});
        EXPECT_LE(largest_rotary_step(machine, found.toolpath, found.axes, MoveKind::track),
                  settings.largest_step);
    }
}

TEST(SmallRotations, ShareTheTurnOfAMoveEqually) {
    const MachineModel machine = test::machine("ac-table");
    const Toolpath path = path_over_tracks("two-bell", 20, 8);
    const AxisPath axes = sequence(machine, path);
    const double limit = from_degrees(10.0);
    const Toolpath finer = with_small_rotations(test::patch("two-bell"), machine, path, axes, limit, {});
    const AxisPath after = sequence(machine, finer);
    std::size_t n = 1;
    for (std::size_t old = 1; old < path.points.size(); ++old) {
        double least = pi;
        double most = 0.0;
        int moves = 0;
        for (bool there = false; !there; ++n, ++moves) {
            there = finer.points[n].origin.uv == path.points[old].origin.uv;
            double step = 0.0;
            for (const int axis : machine.rotary_axes()) {
                step = std::max(step, std::abs(after.positions[n][axis] - after.positions[n - 1][axis]));
            }
            least = std::min(least, step);
            most = std::max(most, step);
        }
        if (moves > 1) {
            EXPECT_LE(most - least, 0.25 * limit) << old;
        }
    }
    EXPECT_EQ(n, finer.points.size());
}

TEST(SmallRotations, KeepThePointsThatThereWere) {
    const MachineModel machine = test::machine("ac-table");
    const Toolpath path = path_over_tracks("two-bell", 15, 6);
    const AxisPath axes = sequence(machine, path);
    const Toolpath same = with_small_rotations(test::patch("two-bell"), machine, path, axes, pi, {});
    EXPECT_EQ(same.points.size(), path.points.size()) << "nothing turns by half a turn";
    const Toolpath finer =
        with_small_rotations(test::patch("two-bell"), machine, path, axes, from_degrees(20.0), {});
    std::size_t kept = 0;
    for (const PathPoint& point : finer.points) {
        const bool old = kept < path.points.size() && point.origin.uv == path.points[kept].origin.uv;
        if (old) {
            EXPECT_EQ(point.pose.tip, path.points[kept].pose.tip);
            EXPECT_EQ(point.reached_by, path.points[kept].reached_by);
        } else {
            EXPECT_EQ(point.reached_by, MoveKind::track) << "a way from track to track stays one move";
        }
        kept += old ? 1 : 0;
    }
    EXPECT_EQ(kept, path.points.size());
}

TEST(SmallRotations, LeaveAMachineWithoutRotaryAxesAlone) {
    const MachineModel machine = test::machine("router-xyz");
    Toolpath path = path_over_tracks("dome", 5, 4);
    for (PathPoint& point : path.points) {
        point.pose.axis = Vec3::UnitZ();
    }
    const AxisPath axes = sequence(machine, path);
    EXPECT_EQ(with_small_rotations(test::patch("dome"), machine, path, axes, 0.1, {}).points.size(),
              path.points.size());
}

TEST(SmallRotations, CanBeCancelledAndRefuseAStepOutOfRange) {
    const MachineModel machine = test::machine("ac-table");
    const Toolpath path = path_over_tracks("dome", 4, 4);
    const AxisPath axes = sequence(machine, path);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)with_small_rotations(
                     test::patch("dome"), machine, path, axes, 0.1, Progress({}, stop.get_token())),
                 Cancelled);
    EXPECT_THROW((void)with_small_rotations(test::patch("dome"), machine, path, axes, 0.0, {}), Defect);
}

} // namespace
} // namespace millwright::toolpath
