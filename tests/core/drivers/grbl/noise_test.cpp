// A controller of which only noise is heard.
#include "tests/core/drivers/grbl/grbl_wire.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::drivers::grbl {
namespace {

/// s until a job that runs ends in an alarm, while `noise` comes ten times per second and nothing else.
double time_to_alarm(const std::string& noise) {
    test::GrblWire wire;
    std::string text = "G21 G90 F600\n";
    for (int n = 0; n < 200; ++n) {
        text += n % 2 == 0 ? "G1 X10\n" : "G1 X0\n";
    }
    wire.start(text);
    wire.run_until([&] { return wire.grbl.position()[0] > 1.0; }, 10.0);
    const double begin = wire.now;
    while (wire.state() != DriverState::alarm && wire.now < begin + 60.0) {
        wire.now += 0.1;
        wire.session.receive(noise, wire.now);
        wire.session.tick(wire.now);
        (void)wire.session.take_output();
    }
    return wire.now - begin;
}

TEST(GrblNoise, WithoutPauseEndsAJobAsSilenceDoes) {
    const double silence = time_to_alarm("");
    EXPECT_LT(silence, 9.0);
    for (const char* const noise : {"\xfe\xfdk\n", "\xfe\xfd", "\n", "<Idl|MP\r\n"}) {
        EXPECT_LT(time_to_alarm(noise), silence + 1.0) << noise;
    }
}

} // namespace
} // namespace millwright::drivers::grbl
