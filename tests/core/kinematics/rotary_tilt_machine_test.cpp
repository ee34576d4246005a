#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/inverse.h"
#include "core/kinematics/rotary_tilt.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <utility>

namespace millwright::kinematics {
namespace {

void expect_constants(const MachineModel& machine, const RotaryTilt& wanted) {
    const auto found = rotary_tilt_of(machine);
    ASSERT_TRUE(found) << machine.name();
    for (const auto member : {&RotaryTilt::a,
                              &RotaryTilt::b,
                              &RotaryTilt::c,
                              &RotaryTilt::e,
                              &RotaryTilt::AB,
                              &RotaryTilt::B4,
                              &RotaryTilt::OF}) {
        EXPECT_NEAR((*found).*member, wanted.*member, 1e-9) << machine.name();
    }
}

// T5.
TEST(RotaryTiltMachine, HasTheConstantsOfTheThesis) {
    expect_constants(test::machine("rotary-tilt-listing"), listing_values);
    expect_constants(test::machine("rotary-tilt-chapter3"), chapter_3_values);
    expect_constants(test::machine("rotary-tilt-gui"), gui_values);
    for (const char* other : {"ac-table", "bc-table-head", "router-xyz"}) {
        EXPECT_FALSE(rotary_tilt_of(test::machine(other))) << other;
    }
}

// T5: the same tip as the thesis's formulas, whatever the constants.
TEST(RotaryTiltMachine, GoesWhereTheFormulasSayWithOtherConstants) {
    const RotaryTilt constants{20.0, -5.0, 90.0, 0.4, 230.0, 350.0, 110.0};
    const MachineModel machine = with_rotary_tilt(test::machine("rotary-tilt-listing"), constants);
    expect_constants(machine, constants);
    std::mt19937 random(1997);
    for (int n = 0; n < 500; ++n) {
        const Vec3 M = test::random_point(random, 300.0);
        const Vec3 angles = test::random_point(random, pi);
        AxisPositions q(5);
        q << M, angles.x(), angles.y();
        EXPECT_LT(
            (forward(machine, q).tip - workpiece_from_machine(constants, M, angles.x(), angles.y())).norm(),
            round_trip_mm);
    }
    EXPECT_THROW((void)with_rotary_tilt(test::machine("ac-table"), constants), Error);
}

TEST(RotaryTiltMachine, ALongerToolMakesOFLonger) {
    const MachineModel machine = test::machine("rotary-tilt-listing").with_tool_length(52.5);
    RotaryTilt longer = listing_values;
    longer.OF += 12.5; // the machine file's tool has 40 mm
    expect_constants(machine, longer);
    expect_constants(with_rotary_tilt(machine, gui_values), gui_values);
}

} // namespace
} // namespace millwright::kinematics
