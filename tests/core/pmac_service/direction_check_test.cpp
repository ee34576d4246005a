#include "core/pmac_service/direction_check.h"

#include "core/base/error.h"
#include "tests/core/pmac_service/card_talk_to.h"
#include "tests/support/reason.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::pmac {
namespace {

using test::reason;
using ::testing::HasSubstr;

// F4.
TEST(DirectionCheckF4, EveryAxisOfTheThesisGoesTheSameWayByJogAndByProgram) {
    test::PmacCard pmac;
    ASSERT_EQ(pmac.send(test::arm_axes), "");
    const double scales[] = {120.0, 222.0, 150.0, 150.0};
    for (int motor = 1; motor <= 4; ++motor) {
        const DirectionFound found = direction_check(test::talk_to(pmac), motor);
        EXPECT_TRUE(found.agree);
        EXPECT_EQ(found.axis, "XYZA"[motor - 1]);
        EXPECT_NEAR(found.jog, scales[motor - 1], 2.0);
        EXPECT_NEAR(found.program, scales[motor - 1], 2.0);
        EXPECT_NEAR(pmac.card.position(motor), 0.0, 2.0); // where it was
    }
    EXPECT_EQ(pmac.ask("I122"), "32"); // as from the factory
}

TEST(DirectionCheckF4, AScaleOfTheWrongSignIsFound) {
    test::PmacCard pmac;
    ASSERT_EQ(pmac.send("I100=1\nI200=1\n#1->120X\n#2->-222Y\n#1J/\n#2J/"), "");
    EXPECT_TRUE(direction_check(test::talk_to(pmac), 1).agree);
    const DirectionFound found = direction_check(test::talk_to(pmac), 2);
    EXPECT_FALSE(found.agree);
    EXPECT_NEAR(found.jog, 222.0, 2.0);
    EXPECT_NEAR(found.program, -222.0, 2.0);
}

TEST(DirectionCheckF4, AMotorThatStandsStillDoesNotAgree) {
    PmacPlant heavy;
    heavy.friction = 1e9;
    test::PmacCard pmac({.plants = {heavy}});
    ASSERT_EQ(pmac.send("I100=1\n#1->120X\n#1J/"), "");
    EXPECT_FALSE(direction_check(test::talk_to(pmac), 1).agree);
}

// The card tells it sooner than the driver has seen it.
TEST(DirectionCheckF4, PowerThatWasJustLostIsToldWithItsReason) {
    test::PmacCard pmac;
    ASSERT_EQ(pmac.send("I100=1\n#1->120X"), "");
    bool seen = false;
    const CardTalk watched{[&, talk = test::talk_to(pmac)](const std::string& line) {
                               if (seen) {
                                   throw Error("in alarm: motor 3: its following error exceeded the limit");
                               }
                               return talk.ask(line);
                           },
                           [&](double) { seen = true; }};
    EXPECT_THAT(reason([&] { (void)direction_check(watched, 1); }),
                HasSubstr("motor 3: its following error"));
}

TEST(DirectionCheckF4, GivesNoPowerAndNeedsAnAxis) {
    test::PmacCard pmac;
    ASSERT_EQ(pmac.send("I100=1\n#1->120X"), "");
    EXPECT_THAT(reason([&] { (void)direction_check(test::talk_to(pmac), 1); }), HasSubstr("is disabled"));
    EXPECT_FALSE(pmac.card.enabled(1));
    ASSERT_EQ(pmac.send("I200=1\n#2J/"), "");
    EXPECT_THAT(reason([&] { (void)direction_check(test::talk_to(pmac), 2); }),
                HasSubstr("does not move an axis"));
}

} // namespace
} // namespace millwright::pmac
