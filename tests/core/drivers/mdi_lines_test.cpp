#include "core/drivers/mdi_lines.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <gtest/gtest.h>

namespace millwright::drivers {
namespace {

using kinematics::AxisKind;

TEST(HandLines, NameTheWorkSystems) {
    EXPECT_EQ(work_system_name(1), "G54");
    EXPECT_EQ(work_system_name(6), "G59");
    EXPECT_EQ(work_system_name(9), "G59.3");
    EXPECT_THROW((void)work_system_name(0), Defect);
}

TEST(HandLines, SwitchSpindleAndCoolant) {
    EXPECT_EQ(start_spindle(12000.0), "M3 S12000.0");
    EXPECT_EQ(start_spindle(500.0, false), "M4 S500.0");
    EXPECT_EQ(set_coolant(false, true), "M9\nM8");
    EXPECT_EQ(set_coolant(false, false), "M9");
    EXPECT_THROW((void)start_spindle(-1.0), Defect);
}

TEST(HandLines, SpeakInMillimetresAndDegrees) {
    EXPECT_EQ(set_work_position({'X', AxisKind::linear}, 1.5), "G21 G10 L20 P0 X1.5000");
    EXPECT_EQ(set_work_position({'A', AxisKind::rotary}, from_degrees(30.0)), "G21 G10 L20 P0 A30.0000");
    DriverStatus status;
    status.position = status.work_offset = kinematics::AxisPositions::Zero(3);
    status.position[2] = 7.0;
    status.work_offset[2] = 5.0;
    EXPECT_EQ(probe_line({'Z', AxisKind::linear}, 2, -10.0, 2.0, status),
              "G21 G90 G94 G38.2 Z-8.0000 F120.000");
}

} // namespace
} // namespace millwright::drivers
