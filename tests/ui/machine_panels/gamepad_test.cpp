// A gamepad moves a Grbl controller (emulated, in real time) as long as somebody holds it, and not longer.
#include "tests/ui/person/grbl_bench.h"
#include "tests/ui/person/person.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace millwright::panels {
namespace {

using drivers::DriverState;
using render::Gamepad;
using test::GrblBench;
using test::Person;

class JogByGamepad : public ::testing::Test {
protected:
    GrblBench grbl;
    Person person{{1280, 800}};

    void SetUp() override {
        person.app().run("view.machine");
        person.app().view_state().manual.choice.driver = "grbl";
        person.app().view_state().manual.choice.address = grbl.port();
        person.frames(3);
        person.click("inspector/connection/machine_connect");
        const auto state = [this] { return person.app().look().connection.status.state; };
        ASSERT_TRUE(person.live_until([&] { return person.app().look().connection.connected(); }));
        if (state() == DriverState::alarm) {
            person.app().run("machine.reset");
        }
        ASSERT_TRUE(person.live_until([&] { return state() == DriverState::idle; }));
    }

    static Gamepad pushed(float x, float y, bool bumper = true) {
        Gamepad pad;
        pad.left_x = x;
        pad.left_y = y;
        pad.left_bumper = bumper;
        return pad;
    }
    void start(const Gamepad& pad) {
        person.hold_gamepad(pad);
        ASSERT_TRUE(person.hold_until([this] { return grbl.moving(); }));
    }
    /// It comes to rest, and stays there for many frames.
    void expect_stop(const std::function<void()>& what) {
        what();
        // A starved program lets it rest between two pieces of a jog: only the driver knows when that is
        // over.
        ASSERT_TRUE(person.live_until([this] {
            const auto& status = person.app().look().connection.status;
            return !grbl.moving() && status.state == DriverState::idle;
        }));
        const auto still = grbl.position();
        person.frames(20);
        EXPECT_EQ(grbl.position(), still);
    }
    /// Frames in which it could have begun.
    void expect_rest() {
        person.frames(20);
        EXPECT_FALSE(grbl.moving());
        EXPECT_EQ(grbl.position(), (std::array<double, 3>{0.0, 0.0, 0.0}));
    }
};

TEST_F(JogByGamepad, NeedsToBeArmedAndABumperToBeHeld) {
    person.hold_gamepad(pushed(1.0F, 0.0F));
    expect_rest(); // not armed
    person.app().run("machine.arm_gamepad");
    person.hold_gamepad(pushed(1.0F, 0.0F, false));
    expect_rest(); // no bumper
    person.hold_gamepad(pushed(0.2F, -0.2F));
    expect_rest(); // a stick that does not come back to its middle
    person.hold_gamepad(pushed(std::numeric_limits<float>::quiet_NaN(), 0.0F));
    expect_rest();
    person.keep("machine-gamepad");
    start(pushed(0.0F, 1.0F));
    expect_stop([this] { person.hold_gamepad(Gamepad{}); });
    EXPECT_GT(grbl.position()[1], 0.0);
    EXPECT_EQ(grbl.position()[0], 0.0);
}

TEST_F(JogByGamepad, StopsWhenTheStickRestsTheBumperRisesThePadIsGoneOrTheFocusIs) {
    person.app().run("machine.arm_gamepad");
    start(pushed(1.0F, 0.0F));
    expect_stop([this] { person.hold_gamepad(pushed(0.0F, 0.0F)); });
    start(pushed(-1.0F, 0.0F));
    expect_stop([this] { person.hold_gamepad(pushed(-1.0F, 0.0F, false)); });
    start(pushed(1.0F, 1.0F));
    expect_stop([this] { person.hold_gamepad(std::nullopt); });
    start(pushed(0.0F, -1.0F));
    expect_stop([this] { person.set_focused(false); });
    person.set_focused(true); // it is still held: that takes letting go first
    person.frames(20);
    EXPECT_FALSE(grbl.moving());
}

TEST_F(JogByGamepad, GoesSlowerWhereTheStickIsPushedLess) {
    person.app().run("machine.arm_gamepad");
    person.app().view_state().manual.speed_mm_per_min = 1200.0;
    const auto speed = [this] { return person.app().look().connection.status.feed * 60.0; };
    const auto nearly = [&](double wanted) {
        return [&speed, wanted] { return std::abs(speed() - wanted) < 0.02 * wanted; };
    };
    person.hold_gamepad(pushed(1.0F, 0.0F));
    EXPECT_TRUE(person.hold_until(nearly(1200.0))) << speed();
    person.hold_gamepad(pushed(0.6F, 0.0F)); // half of the way beyond the dead zone
    EXPECT_TRUE(person.hold_until(nearly(600.0))) << speed();
    expect_stop([this] { person.hold_gamepad(Gamepad{}); });
}

TEST_F(JogByGamepad, GoesOneStepAPush) {
    person.app().run("machine.arm_gamepad");
    person.app().view_state().manual.step = 1.0;
    person.frames(2);
    person.hold_gamepad(pushed(0.0F, 1.0F));
    person.frames(30);
    ASSERT_TRUE(person.live_until([this] { return grbl.position()[1] > 0.99 && !grbl.moving(); }));
    person.frames(20);
    EXPECT_NEAR(grbl.position()[1], 1.0, 0.01);
}

} // namespace
} // namespace millwright::panels
