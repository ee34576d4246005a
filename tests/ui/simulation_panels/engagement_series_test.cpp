#include "ui/simulation_panels/engagement_series.h"

#include "core/base/error.h"
#include "core/kinematics/machine_file.h"
#include "core/motion/planner.h"
#include "tests/support/programs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace millwright::panels {
namespace {

/// A rapid, a feed in air, a feed that cuts, and a rapid.
program::Program four_moves(const kinematics::MachineModel& machine) {
    program::Program program;
    program.start = kinematics::AxisPositions::Zero(machine.axis_count());
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        program.axes.push_back({axis.letter, axis.kind});
    }
    kinematics::AxisPositions at = program.start;
    for (const double duration : {0.0, 4.0, 4.0, 0.0}) {
        at[0] += 40.0;
        test::add_move(program, at, duration);
    }
    return program;
}

TEST(EngagementSeries, AirIsMarkedAndRapidsLeaveAGap) {
    const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/router-xyz.json");
    const motion::Trajectory trajectory = motion::plan(four_moves(machine), machine, {}, {});
    std::vector<simulation::FeedEngagement> feeds(2);
    feeds[0].block = 1;
    feeds[0].time = 4.0;
    feeds[1] = {.block = 2, .line = 3, .time = 4.0, .removed = 400.0, .depth = 2.0, .width = 6.0};
    const EngagementSeries series = engagement_series(feeds, trajectory, 201);
    ASSERT_EQ(series.time.size(), 201U);
    const auto column = [&](int block) {
        const double middle = 0.5 * (trajectory.start_of(block) + trajectory.end_of(block));
        return static_cast<std::size_t>(std::lround(200.0 * middle / trajectory.duration()));
    };
    EXPECT_FALSE(std::isfinite(series.rate[column(0)])) << "a rapid";
    EXPECT_FALSE(std::isfinite(series.air[column(0)]));
    EXPECT_EQ(series.air[column(1)], 0.0);
    EXPECT_FALSE(std::isfinite(series.rate[column(1)]));
    EXPECT_DOUBLE_EQ(series.rate[column(2)], 6000.0) << "400 mm^3 in 4 s";
    EXPECT_DOUBLE_EQ(series.depth[column(2)], 2.0);
    EXPECT_DOUBLE_EQ(series.width[column(2)], 6.0);
    EXPECT_FALSE(std::isfinite(series.air[column(2)]));
}

TEST(EngagementSeries, NeedsTwoColumns) {
    const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/router-xyz.json");
    const motion::Trajectory trajectory = motion::plan(four_moves(machine), machine, {}, {});
    EXPECT_THROW((void)engagement_series({}, trajectory, 1), Defect);
}

} // namespace
} // namespace millwright::panels
