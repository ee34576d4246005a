#include "core/emulators/stream/stream_emulator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::emulators {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* heading = "# millwright-stream 1 period_s 0.01 X mm B deg\n";

TEST(StreamEmulator, GoesToOneSampleAPeriod) {
    StreamEmulator machine;
    machine.receive(heading);
    machine.receive("0.0 0.0\n0.5 -2\n1.5 -2");
    machine.receive("\n");
    EXPECT_TRUE(machine.moving());
    machine.advance(0.015);
    EXPECT_THAT(machine.position(), ElementsAre(0.5, -2.0));
    machine.advance(0.010);
    EXPECT_THAT(machine.position(), ElementsAre(1.5, -2.0));
    EXPECT_FALSE(machine.moving());
    EXPECT_THAT(machine.axes(), ElementsAre("X", "B"));
    EXPECT_EQ(machine.truth().samples, 3);
    EXPECT_THAT(machine.truth().greatest_speed,
                ElementsAre(DoubleNear(100.0, 1e-9), DoubleNear(200.0, 1e-9)));
    EXPECT_NEAR(machine.truth().last_motion, 0.02, 1e-12);
    machine.advance(5.0);
    machine.receive("1.6 -2\n"); // begins a new motion, and does not catch up
    machine.receive("1.7 -2\n");
    machine.advance(0.001);
    EXPECT_THAT(machine.position(), ElementsAre(1.6, -2.0));
    EXPECT_EQ(machine.take_output(), "");
}

TEST(StreamEmulator, StaysWhereItIsForWhatIsNoSample) {
    for (const std::string& bad : {std::string("1 2 3"),
                                   std::string("1"),
                                   std::string("1 nan"),
                                   std::string("1 inf"),
                                   std::string("1 2x"),
                                   std::string("1  2"),
                                   std::string("\x01\xff"),
                                   std::string(10'000, '1')}) {
        StreamEmulator machine;
        machine.receive(heading);
        machine.receive("1 2\n" + bad + "\n");
        machine.advance(1.0);
        EXPECT_THAT(machine.position(), ElementsAre(1.0, 2.0)) << bad;
        EXPECT_EQ(machine.truth().bad_lines, 1) << bad;
        EXPECT_NE(machine.truth().first_fault, "");
    }
}

TEST(StreamEmulator, TakesNothingWithoutAHeading) {
    StreamEmulator machine;
    machine.receive("1 2\n");
    EXPECT_THAT(machine.truth().first_fault, HasSubstr("before a heading"));
    for (const char* bad : {"# millwright-stream 2 period_s 0.01 X mm\n",
                            "# millwright-stream 1 period_s 0 X mm\n",
                            "# millwright-stream 1 period_s 0.01\n",
                            "# millwright-stream 1 period_s 0.01 X\n",
                            "# millwright-stream 1 period_s 0.01 X inch\n",
                            "# millwright-stream 1 period_s 0.01 XY mm\n"}) {
        machine.receive(heading);
        machine.receive(bad);
        machine.receive("1 2\n");
        machine.advance(1.0);
        EXPECT_TRUE(machine.position().empty()) << bad;
    }
}

TEST(StreamEmulator, StandsAfterAnAlarmUntilTheNextHeading) {
    StreamEmulator machine;
    machine.receive(std::string(heading).append("0 0\n1 1\n2 2\n"));
    machine.advance(0.011);
    machine.raise_alarm();
    machine.receive("3 3\n");
    machine.advance(1.0);
    EXPECT_THAT(machine.position(), ElementsAre(1.0, 1.0));
    machine.receive(std::string(heading).append("1 1\n"));
    machine.power_cycle();
    EXPECT_TRUE(machine.axes().empty());
}

} // namespace
} // namespace millwright::emulators
