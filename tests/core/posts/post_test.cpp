#include "core/program/post.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "core/posts/writer.h"
#include "tests/support/programs.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::program {
namespace {

using kinematics::AxisPositions;
using kinematics::forward;
using kinematics::MachineModel;
using toolpath::Toolpath;

/// Height of the tip above the tangent plane of the nearest path point, by looking at all of them.
double height_above(const Toolpath& path, const Vec3& tip) {
    double nearest = std::numeric_limits<double>::infinity();
    double height = 0.0;
    for (const toolpath::PathPoint& point : path.points) {
        const Vec3 off = tip - point.pose.tip;
        if (off.norm() < nearest) {
            nearest = off.norm();
            height = off.dot(point.pose.axis);
        }
    }
    return height;
}

/// The lowest height of a block's move.
double lowest(const MachineModel& machine, const Toolpath& path, const Program& program, int block) {
    constexpr int steps = 400;
    const AxisPositions& a = position_before(program, block);
    const AxisPositions& b = position_before(program, block + 1);
    double result = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        result = std::min(result, height_above(path, forward(machine, (1.0 - t) * a + t * b).tip));
    }
    return result;
}

/// Straight tracks along y, vertical tool: one a pair of x and z, in this order.
Toolpath tracks_at(const std::vector<std::pair<double, double>>& xz) {
    Toolpath path;
    for (std::size_t track = 0; track < xz.size(); ++track) {
        for (int k = 0; k < 9; ++k) {
            const double y = 5.0 * (track % 2 == 0 ? k : 8 - k);
            const auto kind = path.points.empty() ? toolpath::MoveKind::start
                              : k == 0            ? toolpath::MoveKind::cross
                                                  : toolpath::MoveKind::track;
            path.points.push_back({{{xz[track].first, y, xz[track].second}, Vec3::UnitZ()}, kind, {}});
        }
    }
    return path;
}

PostResult post_tracks(const std::vector<std::pair<double, double>>& xz,
                       const ProgramSettings& settings = {}) {
    const auto machine = test::machine("ac-table");
    const Toolpath path = tracks_at(xz);
    return post(machine, path, test::axes_for(machine, path), settings, {});
}

TEST(Post, ReachesEveryPathPointWithinTheRoundingOfTheListing) {
    constexpr double rounding = 1e-3; // mm: half of 1e-4 deg at 300 mm, and of 1e-4 mm
    for (const char* surface : {"dome", "two-bell"}) {
        const auto machine = test::machine("rotary-tilt-listing");
        const Toolpath path = test::zigzag_over(surface, 8, 9);
        const Program program = test::post_over(surface, machine, 8, 9).program;
        const auto blocks = blocks_of_points(program, 72);
        for (std::size_t n = 0; n < 72; ++n) {
            const Block& block = program.blocks.at(static_cast<std::size_t>(blocks[n]));
            EXPECT_LT((forward(machine, block.target).tip - path.points[n].pose.tip).norm(), rounding) << n;
        }
    }
}

TEST(Post, PullsTheToolOffBeforeAnythingElseMovesAndAgainAtTheEnd) {
    const auto machine = test::machine("rotary-tilt-listing");
    const Program program = test::post_over("dome", machine, 5, 6).program;
    std::vector<const Block*> moves;
    for (const Block& block : program.blocks) {
        if (block.moves()) {
            moves.push_back(&block);
        }
    }
    const int z = machine.axis_index('Z');
    const double top = machine.axis(z).max;
    EXPECT_EQ(moves[0]->named, AxisSet::only(z));
    EXPECT_DOUBLE_EQ(moves[0]->target[z], top);
    EXPECT_EQ(moves[1]->named, AxisSet::all(5));
    EXPECT_DOUBLE_EQ(moves[1]->target[z], top);
    EXPECT_EQ(moves[2]->kind, BlockKind::rapid);
    EXPECT_EQ(moves[3]->role, MoveRole::plunge);
    EXPECT_EQ(moves[3]->path_point, 0);
    EXPECT_DOUBLE_EQ(moves.back()->target[z], top);
    EXPECT_EQ(program.blocks.back().kind, BlockKind::end);
    EXPECT_EQ(program.blocks[program.blocks.size() - 2].kind, BlockKind::spindle_off);
}

TEST(Post, KeepsHalfTheClearanceAboveThePartExceptWhereItCutsOrPlunges) {
    for (const char* surface : {"dome", "two-bell"}) {
        const auto machine = test::machine("ac-table");
        const Toolpath path = test::zigzag_over(surface, 10, 10);
        const PostResult result = test::post_over(surface, machine, 10, 10);
        EXPECT_EQ(result.notes.links, 9);
        const Program& program = result.program;
        for (int n = 0; n < program.block_count(); ++n) {
            const Block& block = program.blocks[static_cast<std::size_t>(n)];
            const bool across = block.kind == BlockKind::rapid && n > 0 &&
                                program.blocks[static_cast<std::size_t>(n) - 1].kind == BlockKind::rapid;
            if (across && block.role == MoveRole::link) {
                EXPECT_GE(lowest(machine, path, program, n), 2.5) << surface << " block " << n;
            }
        }
    }
}

TEST(Post, RaisesALinkThatWouldCutThroughARidge) {
    const std::vector<std::pair<double, double>> ridge{{0.0, 0.0}, {40.0, 0.0}, {20.0, 20.0}};
    const PostResult result = post_tracks(ridge);
    EXPECT_EQ(result.notes.raised_links, 2); // over the ridge, and up its side
    EXPECT_EQ(result.notes.safe_height_links, 0);
    const auto machine = test::machine("ac-table");
    const auto across = std::find_if(result.program.blocks.begin(),
                                     result.program.blocks.end(),
                                     [](const Block& b) { return b.role == MoveRole::link; });
    EXPECT_NEAR(forward(machine, across->target).tip.z(), 40.0, 1e-3); // 5, 10, 20 are not clear of 20; 40 is
    const int block = static_cast<int>(across - result.program.blocks.begin()) + 1;
    EXPECT_GE(lowest(machine, tracks_at(ridge), result.program, block), 2.5);
}

TEST(Post, GoesByTheSafePositionWhereNoLiftIsEnough) {
    std::vector<std::pair<double, double>> wall{{0.0, 0.0}, {10.0, 0.0}};
    for (int k = 1; k <= 9; ++k) {
        wall.emplace_back(5.0, 10.0 * k);
    }
    const PostResult result = post_tracks(wall);
    EXPECT_EQ(result.notes.safe_height_links, 2); // over the wall, and from beside it onto its lowest track
}

TEST(Post, StaysOnTheSurfaceIfAskedTo) {
    ProgramSettings settings;
    settings.link = LinkKind::on_surface;
    const PostResult result = test::post_over("dome", test::machine("rotary-tilt-listing"), 5, 6, settings);
    EXPECT_EQ(result.notes.links, 4);
    EXPECT_EQ(result.notes.cut_moves, 25);
    const auto rapids = std::count_if(result.program.blocks.begin(),
                                      result.program.blocks.end(),
                                      [](const Block& block) { return block.kind == BlockKind::rapid; });
    EXPECT_EQ(rapids, 5); // three down to the part, two away from it
}

TEST(Post, FeedsTheTipAtTheCuttingFeedOrAsFastAsTheSlowestAxisCan) {
    const auto machine = test::machine("rotary-tilt-listing");
    ProgramSettings settings;
    settings.cutting_feed = 60.0; // the rotary axes of this machine cannot follow everywhere
    const PostResult result = test::post_over("dome", machine, 12, 12, settings);
    int slowed = 0;
    for (int n = 0; n < result.program.block_count(); ++n) {
        const Block& block = result.program.blocks[static_cast<std::size_t>(n)];
        if (block.kind != BlockKind::feed) {
            continue;
        }
        double busiest = 0.0;
        for (int axis = 0; axis < machine.axis_count(); ++axis) {
            const double step = std::abs(block.target[axis] - position_before(result.program, n)[axis]);
            busiest = std::max(busiest, step / block.duration / machine.axis(axis).max_velocity);
        }
        EXPECT_LE(busiest, 1.0 + 1e-12);
        const double asked = block.role == MoveRole::cut ? 60.0 : 5.0;
        EXPECT_LE(block.feed, asked * (1.0 + 1e-12));
        const bool at_feed = block.feed > asked * (1.0 - 1e-4);
        EXPECT_TRUE(at_feed || busiest > 1.0 - 1e-4) << n;
        slowed += at_feed ? 0 : 1;
    }
    EXPECT_GT(slowed, 0);
    EXPECT_EQ(result.notes.slowed_moves, slowed);
}

TEST(Post, CanBeCancelledBetweenMoves) {
    const auto machine = test::machine("rotary-tilt-listing");
    const Toolpath path = test::zigzag_over("dome", 3, 3);
    std::stop_source user;
    user.request_stop();
    EXPECT_THROW(
        (void)post(machine, path, test::axes_for(machine, path), {}, {}, Progress({}, user.get_token())),
        Cancelled);
}

TEST(Post, NamesBlockAxisValueAndRangeWhereAnAxisWouldLeaveItsLimits) {
    const auto machine = test::machine("rotary-tilt-listing");
    const Toolpath path = test::zigzag_over("dome", 3, 3);
    auto axes = test::axes_for(machine, path);
    axes.positions[4][0] = 512.25;
    try {
        (void)post(machine, path, axes, {}, {});
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_THAT(
            error.what(),
            ::testing::HasSubstr("axis X would have to move to 512.250, outside -500.000 ... 500.000 mm"));
        EXPECT_THAT(error.what(), ::testing::StartsWith("block "));
    }
}

TEST(Post, RoundsAnAxisAtItsLimitTowardsTheInside) {
    auto description = test::machine("ac-table").description();
    description.head[0].max = 20.00004;
    const MachineModel machine(description);
    Toolpath path = tracks_at({{20.00004, 0.0}});
    const Program program = post(machine, path, test::axes_for(machine, path), {}, {}).program;
    for (const Block& block : program.blocks) {
        EXPECT_LE(block.target[0], 20.00004);
    }
}

TEST(Post, RefusesASafePositionBelowTheApproach) {
    const auto machine = test::machine("ac-table");
    const Toolpath path = tracks_at({{0.0, 0.0}});
    const auto axes = test::axes_for(machine, path);
    ProgramSettings settings;
    settings.safe_position = axes.positions[0][machine.axis_index('Z')] + settings.approach_clearance - 0.001;
    EXPECT_THROW((void)post(machine, path, axes, settings, {}), Error);
    settings.safe_position = *settings.safe_position + 0.001;
    EXPECT_NO_THROW((void)post(machine, path, axes, settings, {}));
}

TEST(Post, RefusesSettingsOutOfRange) {
    const test::WithoutTraps numbers_that_are_none;
    for (const auto spoil : {+[](ProgramSettings& s) { s.cutting_feed = 0.0; },
                             +[](ProgramSettings& s) { s.plunge_feed = std::nan(""); },
                             +[](ProgramSettings& s) { s.link_clearance = -1.0; },
                             +[](ProgramSettings& s) { s.length_decimals = 9; },
                             +[](ProgramSettings& s) { s.spindle_rpm = -1.0; }}) {
        ProgramSettings settings;
        spoil(settings);
        EXPECT_THROW((void)post_tracks({{0.0, 0.0}}, settings), Error);
    }
}

TEST(Post, RefusesAxisPositionsOfAnotherPath) {
    const auto machine = test::machine("ac-table");
    const Toolpath path = tracks_at({{0.0, 0.0}, {5.0, 0.0}});
    EXPECT_THROW((void)post(machine, path, test::axes_for(machine, tracks_at({{0.0, 0.0}})), {}, {}), Defect);
    EXPECT_THROW((void)post(machine, {}, {}, {}, {}), Defect);
}

TEST(Post, LeavesOutAMoveThatGoesNowhereButKeepsItsPoint) {
    const auto machine = test::machine("ac-table");
    Toolpath path = tracks_at({{0.0, 0.0}});
    path.points.insert(path.points.begin() + 3, path.points[3]);
    const Program program = post(machine, path, test::axes_for(machine, path), {}, {}).program;
    const auto blocks = blocks_of_points(program, 10);
    EXPECT_EQ(blocks[4], blocks[3]);
    EXPECT_EQ(blocks[5], blocks[4] + 1);
}

} // namespace
} // namespace millwright::program
