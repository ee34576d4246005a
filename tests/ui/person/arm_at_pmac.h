// A person in the Arm workspace with an emulated PMAC at a TCP port, in real time.
#pragma once

#include "tests/ui/person/person.h"
#include "tests/ui/person/pmac_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::test {

struct ArmAtPmac {
    explicit ArmAtPmac(const render::PixelSize& screen = {1280, 800}) : person(screen) {
        person.app().run("view.arm");
        person.app().view_state().manual.choice.driver = "pmac";
        person.app().view_state().manual.choice.address = pmac.address();
        person.app().view_state().manual.arm_percent = 100;
        person.frames(4);
    }
    void connect() {
        person.click("hand/connection/machine_connect");
        ASSERT_TRUE(person.live_until([&] { return is(drivers::DriverState::idle); }));
    }
    [[nodiscard]] bool is(drivers::DriverState state) {
        const auto machine = person.app().look().connection;
        return machine.connected() && machine.status.state == state;
    }
    /// Whatever ended it, nothing moves any more and no motion is reported.
    [[nodiscard]] bool rests() {
        const bool told = is(drivers::DriverState::idle) || is(drivers::DriverState::stopped) ||
                          is(drivers::DriverState::alarm);
        return told && !pmac.moving();
    }
    /// The number of the notice that came last of those on show; 0 without any.
    [[nodiscard]] int newest_notice() {
        constexpr int most = 200;
        int newest = 0;
        for (int n = 1; n <= most; ++n) {
            newest = person.sees("notices/" + std::to_string(n)) ? n : newest;
        }
        return newest;
    }
    void give_power() {
        if (is(drivers::DriverState::alarm)) {
            person.app().run("machine.reset");
            (void)person.live_until([&] { return is(drivers::DriverState::idle); });
        }
        if (!pmac.powered()) {
            person.click("hand/power/arm_enable");
            const auto told = [&] { return person.app().look().connection.status.powered; };
            (void)person.live_until(
                [&] { return (pmac.powered() && told()) || is(drivers::DriverState::alarm); });
        }
    }
    void point_at(const char* path) {
        const widgets::Rect rect = person.place(path);
        person.hover({rect.x + 0.5F * rect.w, rect.y + 0.5F * rect.h});
    }
    /// Presses on a jog's button until the motor has gone some way, and goes on holding it. A window that
    /// is so busy that it draws nothing for 100 ms ends the jog: then once more.
    void jog(const char* path, int motor) {
        constexpr int tries = 20;
        for (int n = 0; n < tries; ++n) {
            give_power();
            const double before = pmac.degrees(motor);
            point_at(path);
            person.hold_button(true);
            const auto moved = [&] { return std::abs(pmac.degrees(motor) - before) > 0.3; };
            (void)person.live_until([&] { return moved() || is(drivers::DriverState::alarm); });
            if (moved() && is(drivers::DriverState::running)) {
                return;
            }
            person.hold_button(false);
            person.frames(2);
        }
        FAIL() << "no jog in " << tries << " tries: " << person.app().look().connection.status.message;
    }

    PmacBench pmac;
    Person person;
};

} // namespace millwright::test
