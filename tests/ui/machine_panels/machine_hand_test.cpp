// A Grbl controller (emulated, in real time, at a pseudo-terminal) in the Machine workspace, with real mouse,
// keys and focus. What stops a jog: letting go, losing the focus, another workspace, a question, a window
// that hangs, a lost link.
#include "core/base/files.h"
#include "tests/ui/person/at_machine.h"
#include "tests/ui/person/grbl_bench.h"
#include "tests/ui/person/person.h"
#include "ui/machine_panels/jog_gate.h"
#include "ui/window/window.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <thread>

namespace millwright::panels {
namespace {

using actions::LinkState;
using actions::Workspace;
using drivers::DriverState;
using test::GrblBench;
using test::Person;

using Clock = std::chrono::steady_clock;

constexpr double jog_speed_mm_per_min = 1500.0;
/// What the promise of 100 ms may be late by on a computer that has other things to do: the frame in which
/// the event is seen, and threads that wait for their turn. (The promise itself is proven in emulated time.)
constexpr double allowed_delay = 2.0; // s

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class MachineByHand : public ::testing::Test {
protected:
    GrblBench grbl;
    Person person{{1280, 720}};

    /// Frames as they come, until `done` or the time is over.
    bool live_until(const std::function<bool()>& done, double seconds = 20.0) {
        const auto start = Clock::now();
        while (seconds_since(start) < seconds) {
            person.frames(1);
            if (done()) {
                return true;
            }
        }
        return done();
    }
    void live(double seconds) {
        (void)live_until([] { return false; }, seconds);
    }

    [[nodiscard]] actions::ConnectionView machine() { return person.app().look().connection; }
    [[nodiscard]] bool is(DriverState state) {
        return machine().connected() && machine().status.state == state;
    }

    /// As the controller itself reported it: place and state in one report.
    [[nodiscard]] bool rests_at(std::size_t axis, double mm) {
        return is(DriverState::idle) && std::abs(machine().status.position[axis] - mm) < 0.01;
    }

    void connect() {
        person.app().run("view.machine");
        person.app().view_state().manual.choice = {"grbl", grbl.port()};
        person.app().view_state().manual.speed_mm_per_min = jog_speed_mm_per_min;
        person.frames(3);
        person.click("inspector/connection/machine_connect");
        ASSERT_TRUE(live_until([this] { return machine().connected(); }))
            << (machine().failure ? machine().failure->message : "");
        if (is(DriverState::alarm)) { // with homing on, Grbl begins locked
            person.app().run("machine.reset");
        }
        ASSERT_TRUE(live_until([this] { return is(DriverState::idle); }));
    }

    void press_on(std::string_view path) {
        person.hover(person.place(path).centre());
        person.hold_button(true);
    }

    /// Holds X+ until the machine moves.
    void start_jog() {
        press_on("hand/jog/plus_X");
        ASSERT_TRUE(person.hold_until([this] { return grbl.moving(); }));
        live(0.4);
    }

    /// s from now until the machine moved last, beyond the time that braking from full speed takes.
    double time_to_stop(const std::function<void()>& what) {
        EXPECT_TRUE(person.hold_until([this] { return grbl.moving(); })); // slow frames let its dead man in
        const double before = grbl.time();
        what();
        EXPECT_TRUE(live_until([this] { return !grbl.moving(); }));
        live(0.5);
        EXPECT_FALSE(grbl.moving());
        const double braking = jog_speed_mm_per_min / 60.0 / GrblBench::acceleration;
        return grbl.last_motion() - before - braking;
    }

    void expect_prompt(double seconds) {
        RecordProperty("stopped_after_ms", fmt::format("{:.0f}", 1e3 * seconds));
        fmt::print("             stopped after {:.0f} ms\n", 1e3 * seconds);
        EXPECT_LT(seconds, 0.1 + allowed_delay);
    }
};

TEST_F(MachineByHand, ShowsTheConnectedMachineWithItsPositionsOffsetsAndSettings) {
    connect();
    EXPECT_EQ(machine().axes.size(), 3U);
    EXPECT_TRUE(live_until([this] { return !machine().settings.empty() && !machine().offsets.empty(); }));
    for (const char* path : {"hand/position/axes/X",
                             "hand/position/zero_all",
                             "hand/jog/plus_Z",
                             "lower/console",
                             "lower/command",
                             "inspector/connection/machine_disconnect",
                             "emergency/machine_emergency_stop"}) {
        EXPECT_TRUE(person.sees(path)) << path;
    }
    person.keep("machine-console");
    person.click("lower/tabs/offsets");
    person.frames(2);
    EXPECT_TRUE(person.sees("lower/offsets/G54"));
    person.keep("machine-offsets");
    person.click("lower/tabs/settings");
    person.frames(2);
    person.click("lower/settings/$1");
    EXPECT_TRUE(person.sees("lower/value"));
    person.keep("machine-settings");
}

TEST_F(MachineByHand, SaysWhyNoLinkWasMade) {
    person.app().run("view.machine");
    person.app().view_state().manual.choice = {"grbl", "/dev/no-such-port"};
    person.frames(3);
    person.click("inspector/connection/machine_connect");
    ASSERT_TRUE(live_until([this] { return machine().failure.has_value(); }));
    EXPECT_EQ(machine().link, LinkState::none);
    person.frames(2);
    EXPECT_TRUE(person.sees("inspector/connection/machine_connect"));
}

TEST_F(MachineByHand, StopsWhenTheButtonIsLetGo) {
    connect();
    start_jog();
    expect_prompt(time_to_stop([this] { person.hold_button(false); }));
    EXPECT_GT(grbl.position()[0], 1.0);
    EXPECT_DOUBLE_EQ(grbl.position()[1], 0.0);
    EXPECT_TRUE(live_until([this] { return is(DriverState::idle); }));
}

TEST_F(MachineByHand, StopsWhenTheMouseLeavesTheButton) {
    connect();
    start_jog();
    expect_prompt(time_to_stop([this] { person.hover({640.0F, 300.0F}); }));
    person.hover(person.place("hand/jog/plus_X").centre()); // it is still down, and over the button again
    live(0.5);
    EXPECT_FALSE(grbl.moving());
    person.hold_button(false);
    live(0.1);
    start_jog();
    person.hold_button(false);
}

TEST_F(MachineByHand, StopsWithoutTheFocusAndWaitsForAnotherPress) {
    connect();
    start_jog();
    expect_prompt(time_to_stop([this] { person.set_focused(false); }));
    person.set_focused(true); // the button is still down
    live(0.5);
    EXPECT_FALSE(grbl.moving());
    person.hold_button(false);
    live(0.7);
    person.frames(JogGate::quiet_frames + 1);
    start_jog();
    person.hold_button(false);
}

TEST_F(MachineByHand, AKeyThatIsStillHeldBeginsNothingAnew) {
    connect();
    person.app().run("machine.arm_keys");
    const auto jog = [this] {
        person.hold_keys({render::Key::right});
        ASSERT_TRUE(person.hold_until([this] { return grbl.moving(); }));
    };
    const auto nothing_begins = [this](const char* after) {
        const testing::ScopedTrace trace(__FILE__, __LINE__, after);
        EXPECT_TRUE(live_until([this] { return !grbl.moving(); }));
        const double before = grbl.position()[0];
        live(1.0);
        EXPECT_DOUBLE_EQ(grbl.position()[0], before);
        person.hold_keys({});
        live(0.7);
        person.frames(JogGate::quiet_frames + 1);
    };
    jog();
    person.set_focused(false);
    person.hold_keys({}); // as GLFW tells it
    live(0.3);
    person.set_focused(true);
    live(0.1);
    person.hold_keys({render::Key::right}); // it repeats, for it is still down
    nothing_begins("another window");

    jog();
    person.app().run("view.program");
    live(0.2);
    person.app().run("view.machine");
    nothing_begins("another workspace");

    jog();
    person.hold_keys({});
}

TEST_F(MachineByHand, StopsInAnotherWorkspace) {
    connect();
    start_jog();
    expect_prompt(time_to_stop([this] { person.app().run("view.program"); }));
    person.hold_button(false);
}

TEST_F(MachineByHand, StopsWhenSomethingIsAsked) {
    connect();
    start_jog();
    expect_prompt(time_to_stop([this] { person.app().run("file.open"); }));
    person.hold_button(false);
}

TEST_F(MachineByHand, StopsWhenTheWindowHangs) {
    connect();
    const auto console = person.app().look().console;
    std::int64_t before = console->end();
    const auto cancelled_since = [&](std::int64_t from) {
        std::vector<drivers::ConsoleLine> lines;
        (void)console->read(from, lines);
        return std::ranges::any_of(lines, [](const drivers::ConsoleLine& line) {
            return line.sent && line.text.find("jog cancel") != std::string::npos;
        });
    };
    start_jog();
    bool cancelled = false;
    constexpr int tries = 10; // a slow frame may have had it cancelled before: then it is jogged again
    for (int n = 0; n < tries && !cancelled; ++n) {
        ASSERT_TRUE(person.hold_until([this] { return grbl.moving(); }));
        const std::int64_t next = console->end();
        constexpr int most_looks = 60'000;
        for (int look = 0; look < most_looks && grbl.moving(); ++look) { // no frame
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        ASSERT_FALSE(grbl.moving());
        ASSERT_TRUE(cancelled_since(before)) << "it came to the end of its way";
        cancelled = cancelled_since(next);
        before = console->end();
    }
    EXPECT_TRUE(cancelled);
    person.hold_button(false);
}

TEST_F(MachineByHand, StopsWhenTheWindowCloses) {
    connect();
    start_jog();
    expect_prompt(time_to_stop([this] { person.app().run("file.quit"); }));
}

TEST_F(MachineByHand, TellsOfALostLinkAndOffersToMakeItAgain) {
    connect();
    start_jog();
    grbl.vanish();
    ASSERT_TRUE(live_until([this] { return is(DriverState::alarm); }));
    person.hold_button(false);
    person.frames(3);
    EXPECT_FALSE(machine().status.message.empty());
    EXPECT_TRUE(person.sees("inspector/connection/machine_reconnect"));
    EXPECT_EQ(person.refusal("hand/jog/plus_X"), "The link is lost: reconnect first.");
    EXPECT_EQ(person.refusal("inspector/job/machine_run"), "The link is lost: reconnect first.");
    person.keep("machine-lost");
}

TEST_F(MachineByHand, JogsByArmedKeysOnly) {
    connect();
    person.hold_keys({render::Key::right});
    live(0.3);
    EXPECT_FALSE(grbl.moving());
    person.hold_keys({});
    live(0.1);
    person.app().run("machine.arm_keys");
    person.hold_keys({render::Key::up});
    ASSERT_TRUE(person.hold_until([this] { return grbl.moving(); }));
    live(0.3);
    expect_prompt(time_to_stop([this] { person.hold_keys({}); }));
    EXPECT_GT(grbl.position()[1], 0.5);
    EXPECT_DOUBLE_EQ(grbl.position()[0], 0.0);
}

/// An arrow would go from button to button, too, and the space bar press the one it came to.
TEST_F(MachineByHand, ArmedKeysWalkThroughNoButtons) {
    connect();
    person.app().view_state().manual.step = 1.0;
    person.frames(2);
    person.click("hand/jog/plus_X");
    ASSERT_TRUE(live_until([this] { return is(DriverState::idle) && grbl.position()[0] > 0.99; }));
    person.app().run("machine.arm_keys");
    person.frames(2);
    person.press_key(render::Key::up);
    ASSERT_TRUE(live_until([this] { return is(DriverState::idle) && grbl.position()[1] > 0.99; }));
    person.press_key(render::Key::space);
    live(0.5);
    EXPECT_NEAR(grbl.position()[0], 1.0, 0.01);
    EXPECT_NEAR(grbl.position()[1], 1.0, 0.01);
    EXPECT_NEAR(grbl.position()[2], 0.0, 0.01);
}

TEST_F(MachineByHand, TheSpindlesSpeedIsShownAsItIsTold) {
    connect();
    person.click("lower/tabs/console");
    person.click("lower/command");
    person.type("M3 S900");
    person.press_key(render::Key::enter);
    EXPECT_TRUE(live_until([this] { return machine().status.spindle_rpm > 899.0; }));
    person.type("G4 P0.1");
    person.press_key(render::Key::enter);
    live(1.0);
    EXPECT_NEAR(machine().status.spindle_rpm, 900.0, 1.0);
}

TEST_F(MachineByHand, StepsGoAsFarAsTheySay) {
    connect();
    person.app().view_state().manual.step = 1.0;
    person.frames(2);
    person.click("hand/jog/plus_X");
    person.click("hand/jog/minus_Y");
    ASSERT_TRUE(
        live_until([this] { return is(DriverState::idle) && !grbl.moving() && grbl.position()[1] < -0.9; }));
    EXPECT_NEAR(grbl.position()[0], 1.0, 0.01);
    EXPECT_NEAR(grbl.position()[1], -1.0, 0.01);
}

TEST_F(MachineByHand, NeverGoesOnMovingAfterAnySequenceOfKeysMouseAndFocus) {
    connect();
    person.app().run("machine.arm_keys");
    std::mt19937 random(20261121);
    const auto one_of = [&](int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); };
    constexpr std::array keys{render::Key::left, render::Key::right, render::Key::up, render::Key::page_down};
    const std::array<std::string, 3> buttons{"hand/jog/plus_X", "hand/jog/minus_Y", "hand/jog/plus_Z"};
    int moved = 0;
    for (int round = 0; round < 60; ++round) {
        switch (one_of(7)) {
        case 0:
            person.hold_keys({keys[static_cast<std::size_t>(one_of(4))]});
            break;
        case 1:
            person.hold_keys({});
            break;
        case 2:
            person.app().run("view.machine");
            person.frames(1);
            press_on(buttons[static_cast<std::size_t>(one_of(3))]);
            break;
        case 3:
            person.hold_button(false);
            break;
        case 4:
            person.set_focused(one_of(2) == 0);
            break;
        case 5:
            person.app().run(one_of(2) == 0 ? "view.grid" : "view.machine");
            break;
        default:
            person.hover({static_cast<float>(one_of(1280)), static_cast<float>(one_of(720))});
            break;
        }
        live(0.02 * (1 + one_of(3)));
        moved += grbl.moving() ? 1 : 0;
        if (round % 6 == 5) { // whatever is still held now, one of these ends it
            switch (one_of(3)) {
            case 0:
                person.set_focused(false);
                break;
            case 1:
                person.app().run("view.design");
                break;
            default:
                person.hold_keys({});
                person.hold_button(false);
                break;
            }
            live(0.1); // what is on its way arrives
            EXPECT_TRUE(live_until([this] { return !grbl.moving(); }, allowed_delay)) << "round " << round;
            live(0.1);
            EXPECT_FALSE(grbl.moving()) << "round " << round;
            person.set_focused(true);
            person.hold_keys({});
            person.hold_button(false);
            person.app().run("view.machine");
            live(0.6); // so long it takes no keys after another window had them
        }
    }
    EXPECT_GT(moved, 2); // the sequences do move it
}

TEST_F(MachineByHand, SendsALineByEnterAloneAndTellsOfARefusal) {
    connect();
    person.click("lower/command");
    person.type("G1 X2 F600");
    person.click("lower/filter"); // the field is left: nothing is sent
    live(0.3);
    EXPECT_DOUBLE_EQ(grbl.position()[0], 0.0);
    person.fill_in("lower/command", "G1 X2 F600");
    ASSERT_TRUE(live_until([this] { return rests_at(0, 2.0); }));
    person.fill_in("lower/command", "G1 X5 F0");
    ASSERT_TRUE(live_until(
        [this] { return machine().status.answer.state == drivers::CommandAnswer::State::refused; }));
    EXPECT_NEAR(grbl.position()[0], 2.0, 0.01);
    person.keep("machine-refused");
    ASSERT_TRUE(live_until([this] { return is(DriverState::idle); })); // the field takes lines again
    person.frames(2);
    // The arrow brings the last line back.
    person.click("lower/command");
    person.press_key(render::Key::up);
    person.press_key(render::Key::up);
    person.press_key(render::Key::enter);
    EXPECT_EQ(person.app().view_state().manual.console.commands.back(), "G1 X2 F600");
}

/// A line takes its time, and who goes on typing means the field: keys that jog must not get there.
TEST_F(MachineByHand, KeepsTheKeyboardInTheCommandLineWhileALineIsExecuted) {
    connect();
    person.app().run("machine.arm_keys");
    person.click("lower/command");
    person.type("G4 P1.5");
    person.press_key(render::Key::enter);
    person.hold_keys({render::Key::up}); // brings the line back
    live(0.3);
    person.hold_keys({});
    person.frames(2);
    person.type("G0 X3");
    const auto lines_with = [&](const std::string& text) {
        const auto lines = grbl.lines();
        return std::count(lines.begin(), lines.end(), text);
    };
    ASSERT_TRUE(live_until([&] {
        if (is(DriverState::idle) && lines_with("G0X3") == 0) {
            person.press_key(render::Key::enter); // refused as long as the dwell lasts, and the text stays
        }
        return lines_with("G0X3") > 0;
    }));
    EXPECT_TRUE(live_until([this] { return rests_at(0, 3.0); }));
    EXPECT_EQ(grbl.position()[1], 0.0);
    EXPECT_EQ(lines_with("G4P1.5"), 1);
}

TEST_F(MachineByHand, MakesThisPlaceTheZero) {
    connect();
    person.fill_in("lower/command", "G1 X3 Y4 F1200");
    ASSERT_TRUE(live_until([this] { return rests_at(1, 4.0); }));
    person.click("hand/position/zero_X");
    ASSERT_TRUE(live_until([this] { return std::abs(machine().status.work_position()[0]) < 0.01; }));
    EXPECT_NEAR(machine().status.work_position()[1], 4.0, 0.01);
    EXPECT_NEAR(machine().status.position[0], 3.0, 0.01);
}

TEST_F(MachineByHand, ExplainsAnAlarmAndMovesAgainOnlyWhenUnlocked) {
    connect();
    grbl.raise_alarm();
    ASSERT_TRUE(live_until([this] { return is(DriverState::alarm); }));
    person.frames(3);
    EXPECT_FALSE(machine().status.message.empty());
    person.keep("machine-alarm");
    press_on("hand/jog/plus_X");
    live(0.4);
    EXPECT_FALSE(grbl.moving());
    person.hold_button(false);
    person.click("inspector/connection/machine_reset");
    ASSERT_TRUE(live_until([this] { return is(DriverState::idle); }));
    start_jog();
    person.hold_button(false);
}

TEST_F(MachineByHand, RunsAFileHoldsResumesAndEnds) {
    connect();
    const auto file = person.folder() / "square.ngc";
    write_file(file, "G21 G90\nG1 X10 F900\nG1 Y10\nG1 X0\nG1 Y0\nM2\n");
    person.open(file);
    person.app().run("view.machine");
    person.frames(3);
    test::press_run(person);
    ASSERT_TRUE(live_until([this] { return grbl.position()[0] > 4.0; }));
    person.keep("machine-job");
    person.app().run("machine.hold");
    ASSERT_TRUE(live_until([this] { return is(DriverState::holding) && !grbl.moving(); }));
    EXPECT_TRUE(person.app().look().job.running);
    person.app().run("machine.resume");
    ASSERT_TRUE(live_until([this] { return !person.app().look().job.running; }, 40.0));
    const auto job = person.app().look().job;
    ASSERT_TRUE(job.outcome) << (job.failure ? job.failure->message : "");
    EXPECT_EQ(job.outcome->end, jobs::JobEnd::done);
    EXPECT_EQ(job.outcome->executed_blocks, 6);
    EXPECT_NE(job.outcome->log_file.string().find("square"), std::string::npos);
}

TEST_F(MachineByHand, StopsAtOnceByTheRedButton) {
    connect();
    person.fill_in("lower/command", "G1 X80 F1200");
    ASSERT_TRUE(live_until([this] { return grbl.moving(); }));
    person.click("emergency/machine_emergency_stop");
    EXPECT_TRUE(live_until([this] { return !grbl.moving(); }, 2.0));
    EXPECT_TRUE(live_until([this] { return is(DriverState::alarm); }));
}

TEST_F(MachineByHand, LeavesTheMachineAtRestWhenItIsDisconnected) {
    connect();
    person.fill_in("lower/command", "G1 X80 F600");
    ASSERT_TRUE(live_until([this] { return grbl.moving(); }));
    person.app().run("machine.disconnect");
    ASSERT_TRUE(live_until([this] { return machine().link == LinkState::none; }));
    EXPECT_FALSE(grbl.moving());
}

} // namespace
} // namespace millwright::panels
