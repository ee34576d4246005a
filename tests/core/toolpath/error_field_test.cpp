#include "core/toolpath/error_field.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/toolpath/tool_poses.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/cutters.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

struct PathCase {
    geometry::BezierPatch patch;
    kinematics::MachineModel machine;
    Toolpath path;
    AxisPath axes;

    PathCase(const char* surface, const char* machine_name, int n, const Tool& tool = {})
        : patch(test::patch(surface)), machine(test::machine(machine_name)),
          path(with_tool(
              patch, machine, tool, zigzag(patch, Grid::uniform(n, n), TrackDirection::along_v, false))),
          axes(sequence(machine, path)) {}

    [[nodiscard]] ErrorField field(int times) const { return field(MoveSampling{times}); }
    [[nodiscard]] ErrorField field(MoveSampling sampling) const {
        return error_field(patch, machine, path, axes, sampling, {});
    }
};

// T9.
TEST(ErrorField, ClosestIsNeverLargerThanParametricAndBothAreFinite) {
    const PathCase dome("dome", "rotary-tilt-listing", 20);
    for (const MoveDeviation& move : dome.field(10).moves) {
        EXPECT_LE(move.closest, move.param + 1e-12);
        EXPECT_TRUE(std::isfinite(move.param) && std::isfinite(move.axis));
        EXPECT_GT(move.length, 0.0);
    }
}

TEST(ErrorField, GrowsWithTheNumberOfSamplesOnNestedTimes) {
    const PathCase dome("dome", "rotary-tilt-listing", 12);
    const auto few = dome.field(1).moves, many = dome.field(3).moves; // 1/2 is among 1/4, 1/2, 3/4
    for (std::size_t n = 0; n < few.size(); ++n) {
        EXPECT_GE(many[n].closest, few[n].closest);
    }
}

// T9.
TEST(ErrorField, OfTheDomeIsLargerThanOfTheSineSheet) {
    const PathCase dome("dome", "rotary-tilt-listing", 20), sine("sine", "rotary-tilt-listing", 20);
    const auto d = summary(dome.field(10), Distance::closest, MoveKind::track);
    const auto s = summary(sine.field(10), Distance::closest, MoveKind::track);
    EXPECT_GT(d.mean, s.mean);
    EXPECT_GT(d.max, s.max);
}

void expect_what_brute_force_finds(const PathCase& made) {
    const auto known = made.field(until_known).moves;
    const auto brute = made.field(4095).moves;
    for (std::size_t n = 0; n < known.size(); ++n) {
        EXPECT_NEAR(known[n].closest, brute[n].closest, 1e-3) << "move " << n;
        EXPECT_NEAR(known[n].axis, brute[n].axis, from_degrees(2e-3)) << "move " << n;
        EXPECT_NEAR(known[n].param, brute[n].param, 1e-2) << "move " << n;
    }
}

TEST(ErrorField, IsKnownToAMicrometreAgainstBruteForce) {
    expect_what_brute_force_finds({"dome", "rotary-tilt-listing", 8});
    expect_what_brute_force_finds({"two-bell", "ac-table", 10}); // moves that turn by half a circle
    expect_what_brute_force_finds({"saddle", "bc-table-head", 9});
    expect_what_brute_force_finds({"sine", "tilted-c-table", 9});
}

geometry::BezierPatch plane_of_uneven_speed() {
    geometry::ControlNet net = geometry::ControlNet::sized(4, 2);
    const std::array x{0.0, 10.0, 90.0, 100.0};
    for (int i = 0; i < 4; ++i) {
        net.point(i, 0) = {x.at(static_cast<std::size_t>(i)), 0.0, 0.0};
        net.point(i, 1) = {x.at(static_cast<std::size_t>(i)), 50.0, 0.0};
    }
    return geometry::BezierPatch(net);
}

/// The tip is on the plane all the time, and at the right place where it begins, in the middle and at the
/// end.
TEST(ErrorField, FindsTheParametricErrorWhereNoOtherIs) {
    const geometry::BezierPatch patch = plane_of_uneven_speed();
    const auto machine = test::machine("ac-table");
    const Toolpath path = zigzag(patch, Grid::uniform(2, 2), TrackDirection::along_u, false);
    const auto moves = error_field(patch, machine, path, sequence(machine, path), until_known, {}).moves;
    double largest = 0.0;
    for (int k = 0; k <= 10'000; ++k) {
        const double t = 1e-4 * k;
        largest = std::max(largest, std::abs(patch.position(t, 0.0).x() - 100.0 * t));
    }
    EXPECT_NEAR(moves[0].closest, 0.0, 1e-9);
    EXPECT_GT(largest, 6.0);
    EXPECT_NEAR(moves[0].param, largest, 1e-2);
}

TEST(ErrorField, IsKnownOfABallToo) {
    const Tool tool{.cutter = test::body(test::ball)};
    for (const PathCase& made :
         {PathCase("two-bell", "ac-table", 20, tool), PathCase("saddle", "bc-table-head", 12, tool)}) {
        const auto known = made.field(until_known).moves;
        const auto brute = made.field(1023).moves;
        for (std::size_t n = 0; n < known.size(); ++n) {
            EXPECT_NEAR(known[n].closest, brute[n].closest, 1e-3) << "move " << n;
        }
    }
}

/// What bites with its rim does so all at once: between any two looks there may be more, but not less.
TEST(ErrorField, MissesNothingOfACutterWithAFlatBottom) {
    for (const CutterShape& shape : {test::flat_end, test::bull_nose}) {
        const PathCase made("two-bell", "ac-table", 20, {.cutter = test::body(shape)});
        const auto known = made.field(until_known).moves;
        const auto brute = made.field(255).moves;
        for (std::size_t n = 0; n < known.size(); ++n) {
            EXPECT_LE(brute[n].closest, known[n].closest + 1e-3) << "move " << n;
        }
    }
}

TEST(ErrorField, IsTheSameBytesOnAnyNumberOfThreads) {
    const PathCase dome("dome", "rotary-tilt-listing", 10);
    set_thread_count(1);
    const auto one = dome.field(5).moves;
    for (const int threads : {2, 7}) {
        set_thread_count(threads);
        const auto several = dome.field(5).moves;
        for (std::size_t n = 0; n < one.size(); ++n) {
            EXPECT_EQ(one[n].closest, several[n].closest);
            EXPECT_EQ(one[n].axis, several[n].axis);
        }
    }
    set_thread_count(0);
}

TEST(ErrorField, CountsTrackAndCrossMovesApart) {
    const PathCase dome("dome", "rotary-tilt-listing", 6);
    const ErrorField field = dome.field(4);
    int cross = 0;
    for (const MoveDeviation& move : field.moves) {
        cross += move.kind == MoveKind::cross ? 1 : 0;
    }
    EXPECT_EQ(cross, 5);
    EXPECT_EQ(std::ssize(field.moves), 35);
}

TEST(ErrorField, StopsWhenCancelled) {
    const PathCase dome("dome", "rotary-tilt-listing", 6);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(
        (void)error_field(dome.patch, dome.machine, dome.path, dome.axes, {4}, {nullptr, stop.get_token()}),
        Cancelled);
}

} // namespace
} // namespace millwright::toolpath
