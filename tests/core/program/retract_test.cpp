#include "core/program/retract.h"

#include "core/base/error.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <limits>

namespace millwright::program {
namespace {

using kinematics::MachineDescription;
using kinematics::MachineModel;

MachineDescription machine_with_z_in_table(Vec3 z_direction, double z_min, double z_max) {
    MachineDescription description = test::machine("ac-table").description();
    kinematics::MachineAxis z = description.head.back();
    description.head.pop_back();
    z.side = kinematics::AxisSide::table;
    z.direction = z_direction;
    z.min = z_min;
    z.max = z_max;
    description.table.insert(description.table.begin(), z);
    return description;
}

TEST(RetractAxis, IsTheHeadsZUpwardsOnTheShippedMachines) {
    for (const char* name : {"rotary-tilt-listing", "ac-table"}) {
        const MachineModel machine = test::machine(name);
        EXPECT_EQ(machine.axis(retract_axis(machine).axis).letter, 'Z') << name;
        EXPECT_GT(retract_axis(machine).sense, 0.0) << name;
        EXPECT_EQ(safe_position(machine, {}), machine.axis(machine.axis_index('Z')).max) << name;
    }
}

TEST(RetractAxis, PullsATableThatMovesUpwardsDown) {
    const MachineModel machine(machine_with_z_in_table(Vec3::UnitZ(), -200.0, 100.0));
    EXPECT_LT(retract_axis(machine).sense, 0.0);
    EXPECT_EQ(safe_position(machine, {}), -200.0);
}

TEST(SafePosition, IsTheOneThatIsSet) {
    ProgramSettings settings;
    settings.safe_position = 55.0;
    EXPECT_EQ(safe_position(test::machine("ac-table"), settings), 55.0);
}

TEST(SafePosition, MustBeSetWhereTheAxisHasNoLimit) {
    const double endless = std::numeric_limits<double>::infinity();
    const MachineModel machine(machine_with_z_in_table(-Vec3::UnitZ(), -200.0, endless));
    EXPECT_THROW((void)safe_position(machine, {}), Error);
}

} // namespace
} // namespace millwright::program
