// The Machine workspace at the other end of different links: what can be chosen, what a machine cannot do,
// and a link that is lost and made again.
#include "core/base/files.h"
#include "core/emulators/grbl/grbl_emulator.h"
#include "core/links/tcp.h"
#include "tests/ui/person/grbl_bench.h"
#include "tests/ui/person/person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::panels {
namespace {

using actions::LinkState;
using drivers::DriverState;
using test::Person;
using testing::HasSubstr;
using testing::StartsWith;

class MachineLink : public ::testing::Test {
protected:
    Person person{{1280, 720}};

    [[nodiscard]] actions::ConnectionView machine() { return person.app().look().connection; }
    [[nodiscard]] bool is(DriverState state) {
        return machine().connected() && machine().status.state == state;
    }

    /// By the drop-down and the field, as a person does it.
    void choose(const std::string& driver, const std::string& address) {
        person.app().run("view.machine");
        person.frames(3);
        person.click("inspector/connection/driver");
        person.click("inspector/connection/driver/" + driver);
        person.frames(2);
        ASSERT_EQ(person.app().view_state().manual.choice.driver, driver);
        person.fill_in("inspector/connection/address", address);
    }
    void connect() {
        person.click("inspector/connection/machine_connect");
        ASSERT_TRUE(person.live_until([this] { return machine().connected(); }))
            << (machine().failure ? machine().failure->message : "");
    }
    /// The Grbl at `port` goes away while it moves.
    void lose(std::unique_ptr<emulators::GrblServer>& grbl, std::uint16_t port) {
        choose("grbl", "tcp:127.0.0.1:" + std::to_string(port));
        connect();
        person.app().run("machine.reset");
        ASSERT_TRUE(person.live_until([this] { return is(DriverState::idle); }));
        person.fill_in("lower/command", "G1 X80 F300");
        ASSERT_TRUE(person.live_until([this] { return is(DriverState::running); }));
        grbl.reset();
        ASSERT_TRUE(person.live_until([this] { return machine().status.link_lost; }));
    }
};

/// A listener that takes whatever comes.
class Receiver {
public:
    explicit Receiver(std::uint16_t port = 0) : server_(port) { server_.open(); }

    [[nodiscard]] std::uint16_t port() const { return server_.port(); }
    [[nodiscard]] std::string address() const { return "tcp:127.0.0.1:" + std::to_string(port()); }
    [[nodiscard]] const std::string& text() { return text_ += server_.read(); }
    [[nodiscard]] std::string last_line() {
        const std::string& all = text();
        const std::size_t end = all.rfind('\n');
        const std::size_t before = end == std::string::npos || end == 0 ? end : all.rfind('\n', end - 1);
        return before == std::string::npos ? std::string() : all.substr(before + 1, end - before - 1);
    }

private:
    links::TcpServer server_;
    std::string text_;
};

TEST_F(MachineLink, SendsACoordinateStreamAndMakesALostLinkAgainWithoutMoving) {
    auto receiver = std::make_unique<Receiver>();
    choose("stream", receiver->address());
    person.keep("machine-stream-choice");
    connect();
    person.app().view_state().manual.step = 1.0;
    person.frames(2);
    person.click("hand/jog/plus_X");
    ASSERT_TRUE(person.live_until([&] { return receiver->last_line().starts_with("1.0000 "); }))
        << receiver->text();
    EXPECT_THAT(receiver->text(), StartsWith("# millwright-stream 1 period_s 0.01 "));
    EXPECT_EQ(person.refusal("inspector/finding/probe"), "This machine cannot probe.");

    const std::uint16_t port = receiver->port();
    const std::string last = receiver->last_line();
    receiver.reset();
    ASSERT_TRUE(person.live_until([this] { return machine().status.link_lost; }));
    person.frames(3);
    EXPECT_TRUE(is(DriverState::alarm));
    EXPECT_FALSE(person.sees("inspector/connection/machine_reset"));
    person.keep("machine-stream-lost");

    receiver = std::make_unique<Receiver>(port);
    person.click("inspector/connection/machine_reconnect");
    ASSERT_TRUE(person.live_until([this] { return is(DriverState::idle); }));
    ASSERT_TRUE(person.live_until([&] { return !receiver->text().empty(); }));
    person.frames(20);
    EXPECT_EQ(std::ranges::count(receiver->text(), '\n'), 1) << receiver->text(); // the heading alone
    person.click("hand/jog/minus_X");
    ASSERT_TRUE(person.live_until([&] { return receiver->last_line().starts_with("0.0000 "); }))
        << receiver->text();
    const std::string text = receiver->text();
    const std::size_t heading = text.find('\n') + 1;
    EXPECT_EQ(text.substr(heading, text.find('\n', heading) - heading), last); // it begins where it was
}

/// At a port of this computer, 0 for any that is free; which one it is.
std::pair<std::uint16_t, std::unique_ptr<emulators::GrblServer>> serve_grbl(std::uint16_t port,
                                                                            SteadyClock& clock) {
    auto listener = std::make_unique<links::TcpServer>(port);
    listener->open();
    const std::uint16_t opened = listener->port();
    std::vector<std::unique_ptr<links::Link>> links;
    links.push_back(std::move(listener));
    return {opened, std::make_unique<emulators::GrblServer>(std::move(links), clock)};
}

TEST_F(MachineLink, MakesALostGrblLinkAgainAndNothingGoesOn) {
    SteadyClock clock;
    auto [port, grbl] = serve_grbl(0, clock);
    ASSERT_NO_FATAL_FAILURE(lose(grbl, port));

    // There is no answer yet: that is shown, and it can be connected later.
    person.frames(3);
    person.click("inspector/connection/machine_reconnect");
    ASSERT_TRUE(person.live_until([this] { return machine().link == LinkState::none; }));
    ASSERT_TRUE(machine().failure.has_value());

    auto again = serve_grbl(port, clock).second;
    person.frames(3);
    connect();
    person.frames(30);
    EXPECT_FALSE(machine().status.link_lost);
    const auto last_motion =
        again->with_controller([](emulators::GrblEmulator& it) { return it.truth().last_motion; });
    EXPECT_LE(last_motion, 0.0);
    EXPECT_FALSE(again->with_controller([](emulators::GrblEmulator& it) { return it.moving(); }));
}

TEST_F(MachineLink, AfterReconnectAGrblThatWasResetInMotionIsNotTrusted) {
    SteadyClock clock;
    auto [port, grbl] = serve_grbl(0, clock);
    ASSERT_NO_FATAL_FAILURE(lose(grbl, port));
    ASSERT_FALSE(machine().status.position_lost);
    const auto again = serve_grbl(port, clock).second; // at zero, as a board that was reset
    person.frames(3);
    person.click("inspector/connection/machine_reconnect");
    ASSERT_TRUE(person.live_until([this] { return !machine().status.link_lost; }));
    ASSERT_TRUE(person.live_until([this] { return machine().status.position_lost; }));
    EXPECT_THAT(machine().status.position_doubt,
                HasSubstr("the machine was running when it was last connected"));
    person.keep("machine-reset-in-motion");
}

/// As behind a link that broke in a job: the controller goes on with what it has.
TEST_F(MachineLink, AGrblThatStillMovesIsConnectedAndStopped) {
    SteadyClock clock;
    auto listener = std::make_unique<links::TcpServer>(0);
    listener->open();
    choose("grbl", "tcp:127.0.0.1:" + std::to_string(listener->port()));
    std::vector<std::unique_ptr<links::Link>> links;
    links.push_back(std::move(listener));
    emulators::GrblServer server(std::move(links), clock);
    const auto moves = [&] {
        return server.with_controller([](emulators::GrblEmulator& grbl) { return grbl.moving(); });
    };
    server.with_controller([](emulators::GrblEmulator& grbl) { grbl.receive("$X\nG91\nG1 X-150 F100\n"); });
    ASSERT_TRUE(person.live_until([&] { return moves(); }));
    connect();
    ASSERT_TRUE(is(DriverState::running));
    person.frames(3);
    person.keep("machine-found-moving");
    EXPECT_FALSE(person.refusal("hand/jog/plus_X").empty());
    EXPECT_TRUE(person.refusal("emergency/machine_emergency_stop").empty());
    person.press_key(render::Key::f10);
    ASSERT_TRUE(person.live_until([&] { return is(DriverState::holding) && !moves(); }));
    person.press_key(render::Key::f11);
    ASSERT_TRUE(person.live_until([&] { return is(DriverState::running) && moves(); }));
    person.press_key(render::Key::f12);
    ASSERT_TRUE(person.live_until([&] { return is(DriverState::idle); }));
    EXPECT_FALSE(moves());
}

/// A link that is made again is a new driver, which cannot know that the old one was reset under way.
TEST_F(MachineLink, RemembersThatThePositionMayBeLost) {
    test::GrblBench grbl;
    choose("grbl", grbl.port());
    connect();
    const auto doubt = [this] { return machine().status.position_doubt; };
    person.frames(3);
    person.click("hand/messages/machine_trust_position"); // it stood at zero, and somebody looks
    ASSERT_TRUE(person.live_until([&] { return doubt().empty(); }));
    person.frames(3);
    EXPECT_FALSE(person.sees("alarm/message"));
    const auto tops = [this] {
        return std::array{person.place("hand/position/zero_X").y,
                          person.place("hand/jog/plus_X").y,
                          person.place("inspector/job/machine_run").y,
                          person.place("inspector/finding/machine_home").y};
    };
    const auto before = tops();
    grbl.raise_alarm();
    ASSERT_TRUE(person.live_until([&] { return is(DriverState::alarm); }));
    person.frames(3);
    EXPECT_TRUE(person.sees("alarm/message"));
    EXPECT_EQ(tops(), before); // an alarm moves no button
    person.keep("machine-alarm");
    person.click("inspector/connection/machine_reset");
    ASSERT_TRUE(person.live_until([&] { return is(DriverState::idle); }));
    EXPECT_THAT(doubt(), HasSubstr("alarm 1"));

    const auto connect_again = [&] {
        person.click("inspector/connection/machine_disconnect");
        ASSERT_TRUE(person.live_until([this] { return machine().link == LinkState::none; }));
        person.frames(3);
        connect();
        person.frames(3);
    };
    connect_again();
    EXPECT_THAT(doubt(), HasSubstr("alarm 1"));
    person.keep("machine-position-doubt");
    person.click("hand/messages/machine_trust_position");
    ASSERT_TRUE(person.live_until([&] { return doubt().empty(); }));
    connect_again();
    EXPECT_THAT(doubt(), Not(HasSubstr("alarm 1")));
}

TEST_F(MachineLink, RunsAProgramOnTheCordicProcessorWithoutAnAddress) {
    write_file(person.folder() / "part.ngc", "G21 G90 G94 G17\nG1 X10 F3000\nY5\nX0\nM2\n");
    person.open(person.folder() / "part.ngc");
    person.app().run("view.machine");
    person.frames(3);
    person.click("inspector/connection/driver");
    person.click("inspector/connection/driver/cordic");
    person.frames(2);
    EXPECT_FALSE(person.sees("inspector/connection/address"));
    connect();
    ASSERT_TRUE(person.live_until([this] { return is(DriverState::idle); }));
    person.frames(3);
    person.keep("machine-cordic");
    person.click("inspector/job/machine_run");
    const auto job = [this] { return person.app().look().job; };
    ASSERT_TRUE(person.live_until([&] { return job().outcome || job().failure; }, 90.0));
    ASSERT_TRUE(job().outcome) << job().failure->message;
    EXPECT_EQ(job().outcome->end, jobs::JobEnd::done) << job().outcome->sentence;
    EXPECT_NEAR(job().outcome->position[0], 0.0, 0.01);
    EXPECT_NEAR(job().outcome->position[1], 5.0, 0.01);
}

TEST_F(MachineLink, SaysWhyLinuxCncIsNotConnected) {
    choose("linuxcnc", "tcp:127.0.0.1:9");
    EXPECT_TRUE(person.sees("inspector/connection/axes"));
    person.click("inspector/connection/machine_connect");
    ASSERT_TRUE(person.live_until([this] { return machine().failure.has_value(); }));
    EXPECT_THAT(machine().failure->message, HasSubstr("127.0.0.1:9"));
    person.frames(3);
    person.keep("machine-linuxcnc");
    // Each kind keeps its own address.
    choose("grbl", "/dev/no-such-port");
    person.click("inspector/connection/driver");
    person.click("inspector/connection/driver/linuxcnc");
    person.frames(2);
    EXPECT_EQ(person.app().view_state().manual.choice.address, "tcp:127.0.0.1:9");
}

} // namespace
} // namespace millwright::panels
