// What is reported to a person of a card's protections, alarms and power, and what becomes of power when they
// leave.
#include "core/base/error.h"
#include "tests/ui/person/arm_at_pmac.h"
#include "ui/workspaces/arm_workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace millwright::panels {
namespace {

using drivers::DriverState;
using test::ArmAtPmac;

TEST(ArmAtPmacF1, ProtectionsThatAreOffAreToldWhenItIsConnectedAndWhenItGetsPower) {
    ArmAtPmac bench;
    const auto& log = bench.person.app().view_state().log;
    const auto told = [&] {
        return std::ranges::count_if(log, [](const std::string& text) {
            return text.find("Protections disabled") != std::string::npos;
        });
    };
    bench.connect();
    ASSERT_TRUE(bench.person.live_until([&] { return told() == 1; }));
    EXPECT_THAT(log.back(), testing::HasSubstr("motors 1, 2, 3 and 4 have no upper position limit"));
    bench.person.keep("arm-protections");
    bench.give_power();
    ASSERT_TRUE(bench.person.live_until([&] { return told() == 2; }));
    bench.person.frames(30);
    EXPECT_EQ(told(), 2);
    EXPECT_TRUE(bench.person.sees("hand/protections"));
}

TEST(ArmAtPmacF2, TheLogKeepsAlarmsWithTheirReason) {
    ArmAtPmac bench;
    const auto& log = bench.person.app().view_state().log;
    bench.connect();
    bench.give_power();
    bench.person.app().run("machine.emergency_stop");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::alarm); }));
    bench.person.app().run("machine.reset");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::idle); }));
    EXPECT_THAT(log, testing::Contains("Alarm: Emergency stop."));
    bench.pmac.vanish();
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::alarm); }));
    bench.person.app().run("machine.disconnect");
    ASSERT_TRUE(bench.person.live_until([&] { return !bench.person.app().look().connection.connected(); }));
    EXPECT_THAT(log, testing::Contains(testing::StartsWith("Alarm: The link was lost")));
}

TEST(ArmAtPmacF2, DisconnectingTakesThePower) {
    ArmAtPmac bench;
    bench.connect();
    bench.give_power();
    ASSERT_TRUE(bench.pmac.powered());
    bench.person.app().run("machine.disconnect");
    ASSERT_TRUE(bench.person.live_until([&] { return !bench.person.app().look().connection.connected(); }));
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_FALSE(bench.person.app().look().connection.failure);
}

TEST(ArmAtPmacF2, QuittingAsksSaysThatTheArmMovesAndTakesThePower) {
    ArmAtPmac bench;
    auto& view_state = bench.person.app().view_state();
    bench.connect();
    bench.give_power();
    bench.person.press_key(render::Key::q, true);
    ASSERT_TRUE(bench.person.sees("dialogs/running_job/running_job_stop"));
    bench.person.keep("arm-quit-with-power");
    bench.person.press_key(render::Key::escape);
    EXPECT_TRUE(bench.pmac.powered());
    EXPECT_FALSE(view_state.quit);
    bench.person.app().connection().tell([](drivers::Driver& driver) { (void)driver.command("#1J=6000"); });
    ASSERT_TRUE(
        bench.person.live_until([&] { return bench.is(DriverState::running) && bench.pmac.moving(); }));
    bench.person.app().run("arm.teach"); // refused; the project is as it was
    bench.person.press_key(render::Key::q, true);
    ASSERT_TRUE(bench.person.sees("dialogs/running_job/running_job_stop"));
    bench.person.keep("arm-quit-in-motion");
    bench.person.click("dialogs/running_job/running_job_stop");
    bench.person.frames(2);
    EXPECT_TRUE(view_state.quit);
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_LT(bench.pmac.degrees(1), 49.0);
}

TEST(ArmAtPmacF2, ACardThatDoesNotTellThatItsPowerIsGoneKeepsTheWindowOpen) {
    ArmAtPmac bench;
    auto& view_state = bench.person.app().view_state();
    bench.connect();
    bench.give_power();
    bench.person.press_key(render::Key::q, true);
    ASSERT_TRUE(bench.person.sees("dialogs/running_job/running_job_stop"));
    bench.pmac.pull_plug();
    bench.person.click("dialogs/running_job/running_job_stop");
    bench.person.frames(2);
    EXPECT_FALSE(view_state.quit);
    EXPECT_TRUE(bench.person.sees("hand/connection/failure"));
    EXPECT_THAT(view_state.log.back(), testing::HasSubstr("motors are disabled"));
    bench.person.keep("arm-quit-unsure");
    bench.person.press_key(render::Key::q, true);
    bench.person.frames(2);
    EXPECT_TRUE(view_state.quit); // a person has read it
}

} // namespace
} // namespace millwright::panels
