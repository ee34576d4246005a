// A grblHAL with five axes (emulated, in real time, at a pseudo-terminal) in the Machine workspace.
#include "core/base/units.h"
#include "tests/ui/person/at_machine.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::panels {
namespace {

using drivers::DriverState;
using test::GrblBench;
using test::machine_is;
using test::Person;

TEST(MachineWithRotaryAxes, IsNamedReadOutJoggedAndZeroed) {
    GrblBench grbl({.firmware = emulators::EmulatedFirmware::grblhal, .axes = "XYZAB"});
    Person person({1280, 900});
    person.app().view_state().manual.turn_deg_per_min = 1800.0;
    test::connect(person, grbl);
    const auto machine = [&] { return person.app().look().connection; };
    EXPECT_EQ(machine().firmware, "grblHAL 1.1f (20240817)");
    ASSERT_EQ(machine().axes.size(), 5U);
    for (const char* path : {"inspector/connection/firmware",
                             "hand/position/axes/A",
                             "hand/position/axes/B",
                             "hand/position/zero_B",
                             "hand/jog/minus_A",
                             "hand/jog/plus_B",
                             "hand/jog/turn"}) {
        EXPECT_TRUE(person.sees(path)) << path;
    }
    person.hover(person.place("hand/jog/plus_A").centre());
    person.hold_button(true);
    ASSERT_TRUE(person.hold_until([&] { return grbl.axis_position('A') > 2.0; }));
    person.hold_button(false);
    ASSERT_TRUE(person.live_until([&] { return !grbl.moving() && machine_is(person, DriverState::idle); }));
    EXPECT_EQ(grbl.position()[0], 0.0);
    const double there = grbl.axis_position('A');
    ASSERT_TRUE(
        person.live_until([&] { return std::abs(to_degrees(machine().status.position[3]) - there) < 0.01; }));
    person.keep("machine-five-axes");
    person.click("hand/position/zero_A");
    ASSERT_TRUE(
        person.live_until([&] { return std::abs(to_degrees(machine().status.work_position()[3])) < 0.01; }));
    EXPECT_NEAR(to_degrees(machine().status.position[3]), there, 0.01);
}

} // namespace
} // namespace millwright::panels
