// The Arm workspace at an emulated PMAC over TCP, in real time.
#include "core/base/units.h"
#include "tests/ui/panels/person.h"
#include "tests/ui/panels/pmac_bench.h"
#include "ui/actions/arm_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::panels {
namespace {

using machine::DriverState;
using test::Person;
using test::PmacBench;
using widgets::Point;
using widgets::Rect;

struct Bench {
    Bench() : person({1280, 800}) {
        person.workshop().run("view.arm");
        person.workshop().session().hand.choice.kind = machine::DriverKind::pmac;
        person.workshop().session().hand.choice.address = pmac.address();
        person.workshop().session().hand.arm_percent = 100;
        person.frames(4);
    }
    void connect() {
        person.click("hand/connection/machine_connect");
        ASSERT_TRUE(person.live_until([&] { return is(DriverState::idle); }));
    }
    [[nodiscard]] bool is(DriverState state) {
        const auto machine = person.workshop().look().controller;
        return machine.connected() && machine.status.state == state;
    }
    /// Whatever ended it, nothing moves any more and nobody says that it does.
    [[nodiscard]] bool rests() {
        const bool told = is(DriverState::idle) || is(DriverState::stopped) || is(DriverState::alarm);
        return told && !pmac.moving();
    }
    void give_power() {
        if (is(DriverState::alarm)) {
            person.workshop().run("machine.reset");
            (void)person.live_until([&] { return is(DriverState::idle); });
        }
        if (!pmac.powered()) {
            person.click("hand/power/arm_enable");
            (void)person.live_until([&] { return pmac.powered() || is(DriverState::alarm); });
        }
    }
    void point_at(const char* path) {
        const Rect rect = person.place(path);
        person.hover({rect.x + 0.5F * rect.w, rect.y + 0.5F * rect.h});
    }
    /// Presses on a jog's button until the motor has gone some way, and goes on holding it. A computer that
    /// is so busy that the card hears nothing for 50 ms makes the card end the jog: then once more.
    void jog(const char* path, int motor) {
        constexpr int tries = 20;
        for (int n = 0; n < tries; ++n) {
            give_power();
            const double before = pmac.degrees(motor);
            point_at(path);
            person.hold_button(true);
            const auto moved = [&] { return std::abs(pmac.degrees(motor) - before) > 0.3; };
            (void)person.live_until([&] { return moved() || is(DriverState::alarm); });
            if (moved() && is(DriverState::running)) {
                return;
            }
            person.hold_button(false);
            person.frames(2);
        }
        FAIL() << "no jog in " << tries << " tries: " << person.workshop().look().controller.status.message;
    }

    PmacBench pmac;
    Person person;
};

TEST(ArmAtPmacU2, NothingMovesAndNoMotorHasPowerByConnecting) {
    Bench bench;
    bench.connect();
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_LT(bench.pmac.last_motion(), 0.0);
    EXPECT_FALSE(bench.person.refusal("hand/jog/plus_5").empty()); // four channels
}

TEST(ArmAtPmacU2, AJogGivesNoPower) {
    Bench bench;
    bench.connect();
    bench.point_at("hand/jog/plus_1");
    bench.person.hold_button(true);
    bench.person.frames(30);
    bench.person.hold_button(false);
    bench.person.frames(2);
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_LT(bench.pmac.last_motion(), 0.0);
}

TEST(ArmAtPmacU2, AJogRunsAsLongAsItIsHeldAndThePictureFollows) {
    Bench bench;
    bench.connect();
    bench.jog("hand/jog/plus_1", 1);
    bench.person.keep("arm-pmac");
    bench.person.hold_button(false);
    ASSERT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
    EXPECT_GT(bench.pmac.degrees(1), 0.3);
    ASSERT_TRUE(bench.person.live_until([&] {
        return std::abs(to_degrees(bench.person.workshop().arm().joints()[0]) - bench.pmac.degrees(1)) < 0.1;
    }));
    EXPECT_NEAR(bench.pmac.degrees(2), 0.0, 0.1);
}

TEST(ArmAtPmacF2, LosingTheFocusEndsAJogThatIsStillHeld) {
    Bench bench;
    bench.connect();
    bench.jog("hand/jog/minus_3", 3);
    bench.person.set_focused(false);
    EXPECT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
}

TEST(ArmAtPmacF2, LeavingTheWorkspaceEndsAJog) {
    Bench bench;
    bench.connect();
    bench.jog("hand/jog/plus_4", 4);
    bench.person.workshop().run("view.design");
    EXPECT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
}

TEST(ArmAtPmacF2, AKillTakesThePowerAndNoJogGivesItBack) {
    Bench bench;
    bench.connect();
    bench.jog("hand/jog/plus_2", 2);
    bench.person.workshop().run("machine.emergency_stop");
    ASSERT_TRUE(
        bench.person.live_until([&] { return bench.is(DriverState::alarm) && !bench.pmac.any_power(); }));
    bench.person.frames(30); // the button is still held
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_FALSE(bench.person.refusal("hand/jog/plus_2").empty());
    EXPECT_FALSE(bench.person.refusal("hand/power/arm_enable").empty());
    bench.person.hold_button(false);
    bench.person.workshop().run("machine.reset");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::idle); }));
    EXPECT_FALSE(bench.pmac.any_power()); // looked at, and still without
    bench.person.keep("arm-killed");
}

TEST(ArmAtPmacU6, APulledPlugIsToldAndJogsAreRefused) {
    Bench bench;
    bench.connect();
    bench.pmac.vanish();
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::alarm); }));
    EXPECT_TRUE(
        bench.person.live_until([&] { return bench.person.workshop().look().controller.status.link_lost; }));
    EXPECT_FALSE(bench.person.refusal("hand/jog/plus_1").empty());
}

TEST(ArmAtPmacU6, ACardThatIsNotThereIsToldInTheWindow) {
    Bench bench;
    bench.person.workshop().session().hand.choice.address = "/dev/no-such-port";
    bench.person.click("hand/connection/machine_connect");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.person.sees("hand/connection/failure"); }));
}

TEST(ArmAtPmacU4, TheTerminalAsksTheCardAndShowsItsErrors) {
    Bench bench;
    bench.connect();
    bench.person.click("lower/tabs/console");
    bench.person.frames(2);
    bench.person.click("lower/command");
    bench.person.type("I122");
    bench.person.press_key(render::Key::enter);
    ASSERT_TRUE(bench.person.live_until([&] {
        return bench.person.workshop().look().controller.status.answer.state ==
               machine::CommandAnswer::State::done;
    }));
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::idle); }));
    bench.person.click("lower/command");
    bench.person.type("NONSENSE");
    bench.person.press_key(render::Key::enter);
    ASSERT_TRUE(bench.person.live_until([&] {
        return bench.person.workshop().look().controller.status.answer.state ==
               machine::CommandAnswer::State::refused;
    }));
    bench.person.keep("arm-terminal");
}

TEST(ArmAtPmac, TakesNoGCode) {
    Bench bench;
    bench.connect();
    bench.person.workshop().run("view.machine");
    bench.person.wait_idle();
    const auto now = bench.person.workshop().look();
    EXPECT_FALSE(bench.person.workshop().catalogue().find("machine.run").permission(now).allowed);
}

} // namespace
} // namespace millwright::panels
