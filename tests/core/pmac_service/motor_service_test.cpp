#include "core/base/error.h"
#include "core/pmac_service/offset_finder.h"
#include "core/pmac_service/step_test.h"
#include "tests/core/pmac_service/card_talk_to.h"
#include "tests/support/reason.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace millwright::pmac {
namespace {

using test::reason;
using test::talk_to;
using ::testing::HasSubstr;

// C2.
TEST(OffsetFinderC2, FindsTheOffsetThatHoldsTheMotorOfTheThesis) {
    PmacPlant plant;
    plant.bias = 996.0;
    test::PmacCard pmac({.plants = {plant}});
    ASSERT_EQ(pmac.send("I100=1\nI129=-900"), "");
    const OffsetFound found = find_offset(talk_to(pmac), 1);
    EXPECT_EQ(found.before, -900);
    EXPECT_NEAR(found.middle, -996, 1);
    EXPECT_LT(found.backward, found.forward);
    // Nothing is left changed, and nothing has power.
    EXPECT_EQ(pmac.ask("I129"), "-900");
    EXPECT_EQ(pmac.ask("I130"), "2000");
    EXPECT_NE(pmac.ask("I111"), "0");
    EXPECT_FALSE(pmac.card.enabled(1));
    EXPECT_LE(std::abs(pmac.card.position(1)), found.farthest + 1000.0);
}

TEST(OffsetFinderC2, TakesTheMiddleOfWhatFrictionHolds) {
    for (const double friction : {3.0, 40.0}) {
        PmacPlant plant;
        plant.bias = -60.0;
        plant.friction = friction;
        test::PmacCard pmac({.plants = {plant}});
        const OffsetFound found = find_offset(talk_to(pmac), 1);
        EXPECT_NEAR(found.middle, 60, 1) << friction;
        EXPECT_NEAR(found.forward - found.backward, 2.0 * friction, 3.0);
    }
}

TEST(OffsetFinderC2, GivesUpWithoutPowerLeftOn) {
    PmacPlant heavy;
    heavy.friction = 1e9;
    test::PmacCard stuck({.plants = {heavy}});
    EXPECT_THAT(reason([&] { (void)find_offset(talk_to(stuck), 1, {.look = 0.05}); }),
                HasSubstr("motor 1 does not move backward with any offset up to"));
    EXPECT_FALSE(stuck.card.enabled(1));
    EXPECT_EQ(stuck.ask("I130"), "2000");
    PmacPlant fast;
    fast.bias = 5000.0;
    test::PmacCard away({.plants = {fast}});
    EXPECT_THAT(reason([&] { (void)find_offset(talk_to(away), 1, {.most_way = 3000.0}); }),
                HasSubstr("counts, but only 3000 were allowed"));
    EXPECT_FALSE(away.card.enabled(1));
    EXPECT_EQ(away.ask("I129"), "0");
}

TEST(OffsetFinderC2, DoesNotChaseAMotorWhoseEncoderCountsTheOtherWay) {
    for (const double bias : {60.0, -996.0, 5.0}) {
        for (const double glance : {0.005, 0.1}) { // of a busy computer
            PmacPlant wrong;
            wrong.speed_per_bit = -wrong.speed_per_bit;
            wrong.bias = bias;
            test::PmacCard pmac({.plants = {wrong}});
            const OffsetSearch search{.glance = glance};
            EXPECT_THAT(reason([&] { (void)find_offset(talk_to(pmac), 1, search); }),
                        HasSubstr("counts, but only 10000 were allowed"))
                << bias;
            const double coasts = wrong.coast_time * 200.0 * 2.0 * 996.0;
            EXPECT_LT(std::abs(pmac.card.position(1)), 1.25 * search.most_way + coasts) << bias;
            EXPECT_FALSE(pmac.card.enabled(1));
            EXPECT_EQ(pmac.ask("I129"), "0");
        }
    }
}

/// As the driver in an alarm: variables are set, motors are sent nothing.
TEST(OffsetFinderC2, GivesBackWhatItChangedWheneverTheCardTakesNoMoreCommands) {
    for (int last = 0; last < 40; ++last) {
        PmacPlant plant;
        plant.bias = 30.0;
        test::PmacCard pmac({.plants = {plant}});
        const CardTalk card = talk_to(pmac);
        int asked = 0;
        const CardTalk alarmed{.ask =
                                   [&](const std::string& line) {
                                       if (asked++ > last && line.find('#') != std::string::npos) {
                                           throw Error("the PMAC is in alarm");
                                       }
                                       return card.ask(line);
                                   },
                               .wait = card.wait};
        EXPECT_THAT(reason([&] { (void)find_offset(alarmed, 1); }), HasSubstr("alarm")) << last;
        EXPECT_EQ(pmac.ask("I129"), "0") << last;
        EXPECT_EQ(pmac.ask("I130"), "2000") << last;
        EXPECT_EQ(pmac.ask("I111"), "32000") << last;
    }
}

// C3: a closed form, the answer of a second order system.
TEST(StepTestC3, MeasuresAKnownAnswer) {
    const double damping = 0.5, rate = 40.0; // rad/s
    const double damped = rate * std::sqrt(1.0 - damping * damping);
    std::vector<StepReading> readings;
    for (int n = 1; n <= 2000; ++n) {
        const double t = n * 5e-4;
        const double e = std::exp(-damping * rate * t);
        readings.push_back(
            {t,
             -300.0 * (1.0 - e * (std::cos(damped * t) + damping * rate / damped * std::sin(damped * t)))});
    }
    const StepResponse response = judge(-300.0, readings, 0.05);
    EXPECT_NEAR(
        response.overshoot, std::exp(-3.14159265 * damping / std::sqrt(1.0 - damping * damping)), 1e-3);
    EXPECT_NEAR(response.rise_time, 1.64 / rate, 0.002); // textbook value for this damping
    EXPECT_NEAR(response.settling_time, 0.132, 0.005);   // the last 5 % crossing, 5.28 / rate
    EXPECT_NEAR(response.error, 0.0, 1e-4);
    EXPECT_THAT(response.advice, HasSubstr("overshoots a little"));
}

TEST(StepTestC3, SeesWhetherALoopIsSoftOrSharp) {
    const auto tested = [](const std::string& settings) {
        test::PmacCard pmac({.plants = {PmacPlant{}}});
        EXPECT_EQ(pmac.send("I100=1\nI111=0\n" + settings + "\n#1J/"), "");
        pmac.card.advance(0.2);
        return step_test(talk_to(pmac), 1, {.size = 500.0, .duration = 1.0, .glance = 0.002});
    };
    const StepResponse soft = tested("I130=50"), usual = tested("I130=2000"),
                       sharp = tested("I130=2000\nI131=0");
    EXPECT_GT(soft.rise_time < 0.0 ? 1e9 : soft.rise_time, usual.rise_time);
    EXPECT_GT(sharp.overshoot, usual.overshoot + 0.05);
    EXPECT_NE(soft.advice, usual.advice);
    EXPECT_THAT(soft.advice, HasSubstr("Ix30"));
    EXPECT_EQ(usual.variables.at(30), 2000.0);
}

TEST(StepTestC3, KillsAMotorThatRunsAway) {
    PmacPlant wrong;
    wrong.speed_per_bit = -200.0; // its encoder counts the other way
    test::PmacCard pmac({.plants = {wrong}});
    ASSERT_EQ(pmac.send("I100=1\nI111=0\n#1J/"), "");
    EXPECT_THAT(reason([&] { (void)step_test(talk_to(pmac), 1); }), HasSubstr("I900"));
    EXPECT_FALSE(pmac.card.enabled(1));
    EXPECT_EQ(pmac.ask("I122"), "32");
}

TEST(StepTestC3, LeavesTheCardAsItWas) {
    test::PmacCard pmac({.plants = {PmacPlant{}}});
    ASSERT_EQ(pmac.send("I100=1\nI119=0.25\nI122=17\n#1J/"), "");
    pmac.card.advance(0.2);
    (void)step_test(talk_to(pmac), 1);
    EXPECT_EQ(pmac.ask("I119"), "0.25");
    EXPECT_EQ(pmac.ask("I122"), "17");
    EXPECT_EQ(pmac.ask("M1023->"), "*");
    EXPECT_NEAR(pmac.card.position(1), 0.0, 2.0); // and the motor where it was
    EXPECT_THAT(reason([&] {
                    CardTalk broken = talk_to(pmac);
                    broken.ask = [&, ask = broken.ask](const std::string& line) {
                        return line.starts_with("#1J:") ? throw Error("refused") : ask(line);
                    };
                    (void)step_test(broken, 1);
                }),
                HasSubstr("refused"));
    EXPECT_FALSE(pmac.card.enabled(1));
    EXPECT_EQ(pmac.ask("I122"), "17");
}

} // namespace
} // namespace millwright::pmac
