#include "ui/panels/axis_positions.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace millwright::panels {
namespace {

using widgets::AxisReading;
using widgets::AxisState;

kinematics::MachineAxis axis_from(double min, double max) {
    kinematics::MachineAxis axis;
    axis.min = min;
    axis.max = max;
    return axis;
}

TEST(AxisPositions, AMachineThatStandsAtTheEndOfItsTravelIsNotBeyondIt) {
    const kinematics::MachineAxis axis = axis_from(0.0, 300.0);
    EXPECT_EQ(travel_limit_state(axis, 0.0), AxisState::near_limit);
    EXPECT_EQ(travel_limit_state(axis, 300.0), AxisState::near_limit);
    EXPECT_EQ(travel_limit_state(axis, -1e-12), AxisState::near_limit) << "rounding";
    EXPECT_EQ(travel_limit_state(axis, 14.0), AxisState::near_limit);
    EXPECT_EQ(travel_limit_state(axis, 150.0), AxisState::normal);
    EXPECT_EQ(travel_limit_state(axis, -0.001), AxisState::beyond_limit);
    EXPECT_EQ(travel_limit_state(axis, 300.001), AxisState::beyond_limit);
    const double endless = std::numeric_limits<double>::infinity();
    EXPECT_EQ(travel_limit_state(axis_from(-endless, endless), 1e6), AxisState::normal);
}

TEST(AxisPositions, SayWhyDigitsHaveAColour) {
    std::array<AxisReading, 3> axes{
        AxisReading{"X", 0.0, "mm"}, AxisReading{"Y", 0.0, "mm"}, AxisReading{"Z", 0.0, "mm"}};
    EXPECT_EQ(travel_words(axes).text, "Within travel limits");
    axes[0].state = axes[2].state = AxisState::near_limit;
    EXPECT_EQ(travel_words(axes).text, "Near travel limit: X, Z");
    EXPECT_EQ(travel_words(axes).tone, widgets::Tone::warning);
    axes[1].state = AxisState::beyond_limit;
    EXPECT_EQ(travel_words(axes).text, "Beyond travel limit: Y");
    EXPECT_EQ(travel_words(axes).tone, widgets::Tone::danger);
}

} // namespace
} // namespace millwright::panels
