// P6, P7, P11, P12 and the protections: motors by themselves, in the emulated card's own time.
#include "tests/core/pmac/emulator/pmac_card.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::pmac {
namespace {

using test::PmacCard;

/// Starts `line` for motor 1 and measures until its command no longer moves.
double command_time(PmacCard& pmac, const std::string& line) {
    EXPECT_EQ(pmac.send(line), "");
    return pmac.wait_until(
        [&] { return (std::stoul(pmac.ask("#1?").substr(0, 6), nullptr, 16) & 0x2000U) != 0; });
}

TEST(PmacJogP6, TakesTheTimeOfIx20AndIx21ToItsSpeed) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send("I122=0.2\n#1J+"), "");
    pmac.card.advance(1.0);
    const double begin = pmac.card.command(1);
    pmac.card.advance(1.0);
    EXPECT_NEAR(pmac.card.command(1) - begin, 200.0, 0.2);
    // stopped from 0.2 counts/ms within 100 ms, on half of the way at full speed
    const double at = pmac.card.command(1);
    EXPECT_NEAR(command_time(pmac, "#1J/"), 0.100, 2.1e-3);
    EXPECT_NEAR(pmac.card.command(1) - at, 0.5 * 0.100 * 200.0, 0.3);
}

TEST(PmacJogP6, IsStretchedByTheLimitOfAcceleration) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send("I111=0\nI122=32\n#1J+"), "");
    pmac.card.advance(5.0);
    const double time = command_time(pmac, "#1J/");
    EXPECT_GE(time, 2.048);                 // 32 / 0.015625 ms, as a trapezoid
    EXPECT_NEAR(time, 2.048 + 0.050, 2e-3); // and the S-curve at its ends
    PmacCard manual; // the manual's example: 50 counts/ms, Ix19=0.25, Ix20=100, Ix21=0 takes 200 ms
    ASSERT_EQ(manual.send("I111=0\nI122=50\nI119=0.25\nI120=100\nI121=0\n#1J+"), "");
    manual.card.advance(3.0);
    EXPECT_NEAR(command_time(manual, "#1J/"), 0.200, 2.1e-3);
}

TEST(PmacJogP6, GoesToPlacesByWaysAndBack) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send("#1J=1000"), "");
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "1000");
    ASSERT_EQ(pmac.send("#1J:-2500"), "");
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "-1500");
    ASSERT_EQ(pmac.send("#1J="), "");
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "0"); // where it was before jogging
    ASSERT_EQ(pmac.send("#1J+"), "");
    pmac.card.advance(0.7);
    ASSERT_EQ(pmac.send("#1J=-300"), ""); // the other way, in full motion
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "-300");
    EXPECT_EQ(pmac.ask("#1F"), "0");
    ASSERT_EQ(pmac.send("#1J=5000"), "");
    pmac.card.advance(0.4);
    ASSERT_EQ(pmac.send("#1J=5000"), ""); // again while it is on its way
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "5000");
}

TEST(PmacHomingP7, FindsTheEdgeReturnsToItAndOvershootsMeanwhile) {
    PmacPlant plant;
    plant.home_edge = 3456.0;
    PmacCard pmac({.plants = {plant}});
    ASSERT_EQ(pmac.send("I902=10\nI903=0\nI123=5\n#1HM"), "");
    double highest = 0.0;
    const auto truly = [&] { return pmac.card.position(1); };
    pmac.wait_until([&] { return (std::stoul(pmac.ask("#1?").substr(0, 6), nullptr, 16) & 0x400U) == 0; });
    // reports refer to the new zero as soon as the flag was seen
    EXPECT_LT(std::abs(truly()), 50.0);
    EXPECT_EQ(pmac.ask("#1?").substr(8, 2), "40"); // the search is over, home is not complete
    pmac.wait_until([&] {
        highest = std::max(highest, truly());
        return !pmac.card.moving();
    });
    pmac.card.advance(0.3);
    EXPECT_GT(highest, 100.0); // it could not stop at once
    EXPECT_EQ(pmac.ask("#1P"), "0");
    EXPECT_EQ(pmac.ask("#1?").substr(6, 6), "004401");
    ASSERT_EQ(pmac.send("#1J=-3456"), "");
    ASSERT_GT(pmac.settle(), 0.0);
    ASSERT_EQ(pmac.send("M1->X:$C000,20"), "");
    EXPECT_EQ(pmac.ask("M1"), "1");
    EXPECT_EQ(pmac.ask("#1P"), "-3456"); // where it began
}

TEST(PmacHomingP7, CountsFromTheTriggerByIx26) {
    PmacPlant plant;
    plant.home_edge = 800.0;
    PmacCard pmac({.plants = {plant}});
    ASSERT_EQ(pmac.send("I902=10\nI123=2\nI126=3200\n#1HM"), ""); // 200 counts beyond
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "0");
    ASSERT_EQ(pmac.send("#1J=-1000"), "");
    ASSERT_GT(pmac.settle(), 0.0);
    ASSERT_EQ(pmac.send("I126=0\nI123=2\n#1HM"), "");
    ASSERT_GT(pmac.settle(), 0.0);
    ASSERT_EQ(pmac.send("#1J=200"), ""); // the old zero
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "200");
}

TEST(PmacHomingP7, WithoutAFlagRunsIntoTheLimitAndSaysSo) {
    PmacPlant plant;
    plant.home_edge = 1e9;
    plant.high_switch = 4000.0;
    PmacCard pmac({.plants = {plant}});
    ASSERT_EQ(pmac.send("I902=10\nI123=5\n#1HM"), "");
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1?").substr(8, 1), "4");                                  // enabled still
    EXPECT_NE(std::stoul(pmac.ask("#1?").substr(6, 6), nullptr, 16) & 0x800U, 0u); // stopped at a limit
    EXPECT_EQ(std::stoul(pmac.ask("#1?").substr(6, 6), nullptr, 16) & 0x400U, 0u); // and not home
    const double stopped = pmac.card.position(1);
    ASSERT_EQ(pmac.send("#1J+"), "");
    pmac.card.advance(2.0);
    EXPECT_NEAR(pmac.card.position(1), stopped, 3.0); // no further
    ASSERT_EQ(pmac.send("#1J-"), "");
    pmac.card.advance(2.0);
    EXPECT_LT(pmac.card.position(1), stopped - 500.0); // but back
}

TEST(PmacLimits, SoftOnesStopAtIx15) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send("I113=9000\nI114=-1500\nI122=10\n#1J+"), "");
    ASSERT_GT(pmac.settle(), 0.0);
    const double behind = 10'000.0 / 200.0 / (2000.0 * 96.0 / 524288.0); // how far it follows
    const double beyond = 10.0 * 10.0 / (2.0 * 0.25) + behind;           // v^2 / 2a
    EXPECT_NEAR(pmac.card.command(1), 9000.0 + beyond, 6.0);
    ASSERT_EQ(pmac.send("#1J-"), "");
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_NEAR(pmac.card.command(1), -1500.0 - beyond, 6.0);
}

TEST(PmacProtections, AFollowingErrorKills) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send("#1->120X\n#2->222Y\nI200=1\n#2J/\n#1J+"), "");
    pmac.card.advance(0.5);
    pmac.card.unplug_encoder(1);
    pmac.wait_until([&] { return !pmac.card.enabled(1); });
    EXPECT_NE(std::stoul(pmac.ask("#1?").substr(6, 6), nullptr, 16) & 4U, 0u); // fatal following error
    EXPECT_FALSE(pmac.card.enabled(2));                                        // Ix25 = $C000: all motors
    EXPECT_NE(std::stoul(pmac.ask("&1??").substr(6, 6), nullptr, 16) & 0x80000U, 0u);
    pmac.card.advance(1.0);
    EXPECT_LT(std::abs(pmac.card.speed(1)), 1.0);
    // without the protection it goes on
    PmacCard careless;
    ASSERT_EQ(careless.send("I111=0\n#1J+"), "");
    careless.card.unplug_encoder(1);
    careless.card.advance(5.0);
    EXPECT_TRUE(careless.card.enabled(1));
    EXPECT_GT(careless.card.speed(1), 1000.0);
}

TEST(PmacProtections, AFaultOfAnAmplifierKillsUnlessIx25LooksAway) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send("#1J+"), "");
    pmac.card.advance(0.5);
    pmac.card.raise_alarm();
    pmac.card.advance(0.01);
    EXPECT_FALSE(pmac.card.enabled(1));
    EXPECT_NE(std::stoul(pmac.ask("#1?").substr(6, 6), nullptr, 16) & 8U, 0u);
    pmac.card.advance(1.0);
    EXPECT_LT(std::abs(pmac.card.speed(1)), 1.0);
    PmacCard thesis;
    ASSERT_EQ(thesis.send("I125=$13C000\nI111=0\n#1J+"), "");
    thesis.card.advance(0.5);
    thesis.card.raise_alarm();
    thesis.card.advance(0.5);
    EXPECT_TRUE(thesis.card.enabled(1));
    EXPECT_LT(std::abs(thesis.card.speed(1)), 1.0); // it drives nothing, and that is not reported
    thesis.card.clear_faults();
    thesis.card.advance(0.02);
    EXPECT_GT(std::abs(thesis.card.speed(1)), 1000.0); // which is why the protection should be on
}

TEST(PmacProtections, KillIsTheOneCommandThatNothingRefuses) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send(test::arm_axes + test::arm_program + "B1R"), "");
    pmac.card.advance(1.0);
    EXPECT_EQ(pmac.ask("#1K"), "ERR001");
    pmac.card.receive("\x0B");
    for (int motor = 1; motor <= 4; ++motor) {
        EXPECT_FALSE(pmac.card.enabled(motor)) << motor;
        EXPECT_EQ(pmac.card.output(motor), 0.0) << motor;
    }
    pmac.card.receive("\x01"); // ^A closes the loops again: never after a kill
    EXPECT_TRUE(pmac.card.enabled(1));
}

TEST(PmacServoP11, TheDriftTestFindsTheOffset) {
    PmacPlant plant;
    plant.bias = 996.0; // the thesis ended at I129 = -996
    PmacCard pmac({.plants = {plant}});
    ASSERT_EQ(pmac.send("I111=0\nI130=0\n#1J/"), "");
    const auto drift = [&](int offset) {
        EXPECT_EQ(pmac.send("I129=" + std::to_string(offset)), "");
        pmac.card.advance(0.5);
        return pmac.card.speed(1);
    };
    EXPECT_NEAR(drift(0), 996.0 * 200.0, 1.0);
    int low = -2000, high = 0;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        (drift(middle) < 0.0 ? low : high) = middle;
    }
    EXPECT_EQ(high, -996);
    EXPECT_NEAR(drift(-996), 0.0, 0.5);
}

TEST(PmacServoP11, ClampsTheOutput) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send("I111=0\nI169=3276\nI122=2000\nI119=100\n#1J+"), ""); // 1 V, and far too fast
    pmac.card.advance(3.0);
    EXPECT_EQ(pmac.card.output(1), 3276.0);
    EXPECT_NEAR(pmac.card.speed(1), 3276.0 * 200.0, 1.0);
    ASSERT_EQ(pmac.send("#1O50"), ""); // half of the limit, open loop
    pmac.card.advance(1.0);
    EXPECT_EQ(pmac.card.output(1), 1638.0);
    EXPECT_EQ(pmac.ask("#1O150"), "ERR003");
}

TEST(PmacServoP11, FollowsTheManualsFilter) {
    // at constant speed the velocity terms cancel (Ix31 = Ix32), so that the error alone makes the output:
    // 2^-19 Ix30 Ix08 FE = speed / speed_per_bit
    PmacCard pmac;
    ASSERT_EQ(pmac.send("I111=0\nI122=10\n#1J+"), "");
    pmac.card.advance(4.0);
    const double error = 10'000.0 / 200.0 / (2000.0 * 96.0 / 524288.0);
    EXPECT_NEAR(pmac.card.command(1) - pmac.card.position(1), error, 1.0);
    ASSERT_EQ(pmac.send("I133=10000\nI134=0"), ""); // the integral takes that away
    pmac.card.advance(20.0);
    EXPECT_LT(std::abs(pmac.card.command(1) - pmac.card.position(1)), 0.1 * error);
}

TEST(PmacCardP12, WithEightChannelsDrivesAFifthMotor) {
    PmacCard four;
    ASSERT_EQ(four.send("I500=1\n#5J:100"), "");
    four.card.advance(1.0);
    EXPECT_EQ(four.ask("#5P"), "0"); // nothing hangs on it
    PmacCard eight({.plants = {}, .channels = 8});
    ASSERT_EQ(eight.send("I500=1\n#5->71.1111B\n#5J:25600"), "");
    ASSERT_GT(eight.settle(), 0.0);
    EXPECT_EQ(eight.ask("#5P"), "25600"); // a turn of joint 5
}

// No output of the card and no encoder: its place is the sum of what it would put out.
TEST(PmacCardP12, SimulatesAFifthMotorOnFourChannels) {
    PmacCard pmac;
    EXPECT_EQ(pmac.ask("RHY:$724"), "00C010"); // as it comes: an encoder that a card of four does not have
    ASSERT_EQ(pmac.send("WY:$724,$5007F0\nI500=1\nI502=$7F0\nI503=$724\n#5->71.1111B\n#5J:25600"), "");
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#5P"), "25600");
    EXPECT_EQ(pmac.ask("RHY:$724"), "5007F0");
    ASSERT_EQ(pmac.send("#5J+"), "");
    pmac.card.advance(0.5);
    EXPECT_GT(pmac.card.speed(5), 1000.0);
    EXPECT_NE(pmac.ask("RHY:$7F0"), "000000"); // the output, in memory
    pmac.control('\x0B');
    pmac.card.advance(0.5);
    EXPECT_FALSE(pmac.card.enabled(5));
    EXPECT_NEAR(pmac.card.speed(5), 0.0, 0.5);
}

TEST(PmacCard, KnowsNoPositionAfterAReset) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send("I130=1999\nSAVE\nI130=5\n#1->120X\n#1J=1000"), "");
    ASSERT_GT(pmac.settle(), 0.0);
    pmac.card.power_cycle();
    EXPECT_FALSE(pmac.card.enabled(1));
    EXPECT_EQ(pmac.ask("#1P"), "0");
    EXPECT_EQ(pmac.ask("I130"), "1999"); // as saved
    EXPECT_EQ(pmac.ask("#1->"), "120X"); // kept by the battery
    EXPECT_EQ(pmac.send("$$$***"), "");
    EXPECT_EQ(pmac.ask("I130"), "2000");
    EXPECT_EQ(pmac.ask("#1->"), "0");
}

} // namespace
} // namespace millwright::pmac
