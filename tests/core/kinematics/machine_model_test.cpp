#include "core/kinematics/machine_model.h"

#include "core/base/error.h"
#include "core/kinematics/inverse.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace millwright::kinematics {
namespace {

/// What the model says of the A-on-C table after `spoil`.
std::string model_fault(const std::function<void(MachineDescription&)>& spoil) {
    MachineDescription description = test::machine("ac-table").description();
    spoil(description);
    try {
        const MachineModel model(description);
    } catch (const Error& error) {
        return error.diagnostic().message;
    }
    return {};
}

TEST(MachineModel, OrdersAxesByLetterAndChainsFromTheBase) {
    const MachineModel machine = test::machine("rotary-tilt-listing");
    std::string letters;
    for (const MachineAxis& axis : machine.axes()) {
        letters += axis.letter;
    }
    EXPECT_EQ(letters, "XYZAB");
    EXPECT_EQ(machine.axis(machine.table_chain()[0]).letter, 'B');
    EXPECT_EQ(machine.axis(machine.rotary_axes()[1]).letter, 'A');
    EXPECT_EQ(machine.axis_index('C'), -1);
}

TEST(MachineModel, RefusesMachinesThatAreNone) {
    EXPECT_EQ(model_fault([](auto&) {}), "");
    EXPECT_NE(model_fault([](auto& m) { m.head.pop_back(); }).find("three linear axes"), std::string::npos);
    EXPECT_NE(model_fault([](auto& m) {
                  m.table.insert(m.table.end(), 2, m.table[0]);
                  m.table[2].letter = 'B';
                  m.table[3].letter = 'U';
              }).find("at most three rotary axes"),
              std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.table[0].max_jerk = 0.0; }).find("jerk"), std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.head[0].letter = 'Y'; }).find("occurs twice"), std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.head[0].letter = 'Q'; }).find("not one of X Y Z"),
              std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.head[0].direction = m.head[1].direction; }).find("span"),
              std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.table[0].direction = m.table[1].direction; }).find("parallel"),
              std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.table[0].direction *= 2.0; }).find("unit vector"),
              std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.table[0].min = m.table[0].max; }).find("lower limit"),
              std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.head[2].max_velocity = 0.0; }).find("positive"), std::string::npos);
    EXPECT_NE(model_fault([](auto& m) {
                  m.table[0].point.x() = std::numeric_limits<double>::infinity();
              }).find("not finite"),
              std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.tool_axis = Vec3::Zero(); }).find("tool axis"), std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.bodies[0].carried_by = 'W'; }).find("axis W"), std::string::npos);
    EXPECT_NE(model_fault([](auto& m) { m.bodies[0].size.x() = 0.0; }).find("body"), std::string::npos);
}

TEST(MachineModel, OfOneOrThreeRotaryAxesHasNoInverse) {
    MachineDescription description = test::machine("ac-table").description();
    description.table.pop_back();
    description.bodies.clear();
    const MachineModel machine(description);
    EXPECT_EQ(machine.axis_count(), 4);
    EXPECT_FALSE(has_inverse(machine));
    EXPECT_TRUE(has_inverse(test::machine("ac-table")));
    EXPECT_TRUE(has_inverse(test::machine("router-xyz")));
    EXPECT_THROW((void)inverse(machine, {Vec3::Zero(), Vec3::UnitZ()}, AxisPositions::Zero(4)), Error);
    EXPECT_FALSE(at_pole(machine, Vec3::UnitZ()));
}

TEST(MachineModel, AnotherWorkpieceOffsetMovesOnlyTheWorkpiece) {
    const MachineModel machine = test::machine("rotary-tilt-listing");
    const MachineModel moved = machine.with_workpiece_offset({1, 2, 3});
    EXPECT_EQ(moved.workpiece_origin(), machine.description().table_origin + Vec3(1, 2, 3));
    EXPECT_EQ(moved.name(), machine.name());
}

} // namespace
} // namespace millwright::kinematics
