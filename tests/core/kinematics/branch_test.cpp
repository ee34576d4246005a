#include "core/base/error.h"
#include "core/kinematics/inverse.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

namespace millwright::kinematics {
namespace {

AxisPositions position(double A, double C) {
    AxisPositions q(5);
    q << 1.0, 2.0, 3.0, A, C;
    return q;
}

TEST(NearestBranch, IsTheOneWithTheLeastRotaryTravel) {
    const MachineModel machine = test::machine("ac-table");
    const std::vector<AxisPositions> branches{position(0.5, 3.0), position(-0.5, 0.1)};
    EXPECT_EQ(nearest_branch(machine, branches, position(0.4, 0.0)), branches[1]);
    EXPECT_EQ(nearest_branch(machine, branches, position(0.4, 2.0)), branches[0]);
    EXPECT_DOUBLE_EQ(rotary_travel(machine, branches[0], branches[1]), 3.9);
}

TEST(NearestBranch, NeedsABranch) {
    EXPECT_THROW((void)nearest_branch(test::machine("ac-table"), {}, position(0, 0)), Defect);
}

} // namespace
} // namespace millwright::kinematics
