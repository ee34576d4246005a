#include "core/program/arm_ways.h"

#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "tests/support/motions.h"
#include "tests/support/samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace millwright::program {
namespace {

using arm::ArmWay;
using kinematics::AxisPositions;
using kinematics::MachineModel;

std::shared_ptr<const MachineModel> machine(const char* name) {
    return std::make_shared<const MachineModel>(test::machine(name));
}

AxisPositions at(const MachineModel& machine, double x, double y, double z) {
    AxisPositions q = AxisPositions::Zero(machine.axis_count());
    q.head<3>() << x, y, z;
    return q;
}

TEST(ArmWays, PutTheToolWhereThePartStands) {
    const auto router = machine("router-xyz");
    Program program = test::empty_program(*router);
    test::add_move(program, at(*router, 10.0, 20.0, 5.0), 0.0);
    test::add_move(program, at(*router, 40.0, 20.0, 5.0), 2.0);
    program.blocks.back().source_line = 7;
    Frame part = Frame::Identity();
    part.translation() = Vec3(700.0, 0.0, -300.0);
    part.linear() = Eigen::AngleAxisd(0.5 * pi, Vec3::UnitZ()).toRotationMatrix();
    const auto ways = arm_ways(std::make_shared<const Program>(program), router, part);
    // The rapid leads from an unknown position: it is not asked of the arm.
    ASSERT_EQ(ways.size(), 1U);
    const ArmWay& way = ways.front();
    EXPECT_EQ(way.line, 7);
    EXPECT_NEAR(way.length, 30.0, 1e-9);
    EXPECT_NEAR(way.duration, 2.0, 1e-12);
    EXPECT_LE((way.at(0.0).translation() - Vec3(680.0, 10.0, -295.0)).norm(), 1e-9);
    EXPECT_LE((way.at(0.5).translation() - Vec3(680.0, 25.0, -295.0)).norm(), 1e-9);
    EXPECT_LE((way.at(1.0).linear().col(2) + Vec3::UnitZ()).norm(), 1e-12); // down, from spindle to tip
}

TEST(ArmWays, BendAsTheRotaryAxesOfTheMachineDo) {
    const auto five = machine("rotary-tilt-listing");
    Program program = test::empty_program(*five);
    AxisPositions from = at(*five, 30.0, 10.0, 40.0), to = at(*five, -20.0, 30.0, 60.0);
    from[3] = 0.1;
    to[3] = 0.6;
    to[4] = -0.5;
    test::add_move(program, from, 0.0);
    test::add_move(program, to, 3.0);
    const auto ways = arm_ways(std::make_shared<const Program>(program), five, Frame::Identity());
    ASSERT_EQ(ways.size(), 1U);
    double length = 0.0;
    Vec3 last = kinematics::forward(*five, from).tip;
    for (int k = 0; k <= 1000; ++k) {
        const double u = k / 1000.0;
        const auto pose = kinematics::forward(*five, from + u * (to - from));
        ASSERT_LE((ways[0].at(u).translation() - pose.tip).norm(), 1e-9);
        ASSERT_LE((ways[0].at(u).linear().col(2) + pose.axis).norm(), 1e-9);
        length += (pose.tip - last).norm();
        last = pose.tip;
    }
    EXPECT_NEAR(ways[0].length, length, 0.01 * length);
}

TEST(ArmWays, BeginWithTheFirstCutWhereNoRapidTellsThePlace) {
    const auto router = machine("router-xyz");
    Program program = test::empty_program(*router);
    Block block;
    block.kind = BlockKind::rapid;
    block.target = at(*router, 10.0, 0.0, 0.0);
    block.named = AxisSet::only(router->axis_index('X'));
    program.blocks.push_back(block);
    test::add_move(program, at(*router, 40.0, 0.0, 0.0), 2.0);
    program.blocks.back().kind = BlockKind::feed;
    const auto ways = arm_ways(std::make_shared<const Program>(program), router, Frame::Identity());
    ASSERT_EQ(ways.size(), 1U);
    EXPECT_NEAR(ways[0].at(0.0).translation().x(), 10.0, 1e-12);
}

} // namespace
} // namespace millwright::program
