// A whole session at the arm with real mouse and keys, at an emulated PMAC over TCP: connect, home, jog every
// axis, teach three points, play them, run the three lines of the thesis, pull the plug in the middle,
// recover.
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/project/taught_points.h"
#include "tests/ui/person/arm_at_pmac.h"
#include "ui/workspaces/arm_workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::panels {
namespace {

using drivers::DriverState;
using project::TaughtPoint;

/// Tolerances between the picture and the card, which follow each other.
constexpr double near_deg = 0.05, near_mm = 5.0;
constexpr double longest_s = 120.0;

class ArmAtPmacShow : public ::testing::Test {
protected:
    ArmAtPmacShow() {
        // Saved, so that the dialogs begin in its folder.
        person_.press_key(render::Key::s, true);
        person_.frames(2);
        person_.fill_in("dialogs/files/name", (person_.folder() / "show.json").string());
        const TaughtPoint ready{"Ready", {0.0, -90.0, 90.0, 0.0, 0.0}, false, 50.0};
        project::write_taught_points({ready}, person_.folder() / "ready.json");
        write_file(person_.folder() / "thesis.mot",
                   "G1 X300 Y0 Z0 F150 ;\nG1 X0 Y0 Z-100 ;\nG1 X-300 Y0 Z100 ;\n");
    }

    [[nodiscard]] Vec3 tip() { return person_.app().arm().tool().translation(); }
    [[nodiscard]] drivers::DriverStatus status() { return person_.app().look().connection.status; }
    [[nodiscard]] const std::vector<TaughtPoint>& points() { return person_.project().arm.points; }
    void keep(const std::string& name) { person_.keep("arm-show-" + name); }

    void choose_pmac() {
        person_.click("hand/connection/driver");
        person_.click("hand/connection/driver/pmac");
        person_.fill_in("hand/connection/address", bench_.pmac.address());
    }
    void choose_file(const char* action, const char* name) {
        person_.click("menu/arm");
        person_.click(std::string("menu/arm/") + action);
        person_.frames(2);
        person_.click(std::string("dialogs/files/entries/") + name);
        person_.click("dialogs/files/open");
    }
    /// What `begin` began has come to its end.
    void follow(const std::function<void()>& begin, const std::function<void()>& watch = {}) {
        const double before = bench_.pmac.last_motion();
        begin();
        ASSERT_TRUE(person_.live_until([&] { return bench_.pmac.last_motion() > before; }))
            << status().message;
        ASSERT_TRUE(person_.live_until(
            [&] {
                if (watch) {
                    watch();
                }
                return bench_.rests();
            },
            longest_s));
        ASSERT_TRUE(bench_.is(DriverState::idle)) << status().message;
        let_the_picture_follow();
    }
    void let_the_picture_follow() {
        ASSERT_TRUE(person_.live_until([&] {
            for (int motor = 1; motor <= 4; ++motor) {
                const double drawn = to_degrees(person_.app().arm().joints()[motor - 1]);
                if (std::abs(drawn - bench_.pmac.degrees(motor)) > near_deg) {
                    return false;
                }
            }
            return bench_.rests();
        }));
    }
    void jog(const char* way) {
        const int motor = std::string_view(way).back() - '0';
        const double before = bench_.pmac.degrees(motor);
        bench_.jog(way, motor);
        person_.hold_button(false);
        let_the_picture_follow();
        EXPECT_GT(std::abs(bench_.pmac.degrees(motor) - before), 0.2) << way;
    }
    void play_points() {
        follow([&] { person_.click("lower/arm_play_points"); });
        for (int motor = 1; motor <= 4; ++motor) {
            EXPECT_NEAR(bench_.pmac.degrees(motor),
                        points().back().joints_deg[static_cast<std::size_t>(motor) - 1],
                        0.1);
        }
    }

    test::ArmAtPmac bench_;
    test::Person& person_ = bench_.person;
};

TEST_F(ArmAtPmacShow, ConnectsHomesJogsTeachesPlaysRunsAFileLosesThePlugAndRecovers) {
    choose_pmac();
    bench_.connect();
    EXPECT_FALSE(status().position_known);
    EXPECT_TRUE(person_.sees("inspector/joints/not_known"));
    keep("connected");

    person_.click("hand/power/arm_enable");
    ASSERT_TRUE(person_.live_until([&] { return bench_.pmac.powered() && status().powered; }));
    follow([&] { person_.click("hand/power/machine_home"); });
    EXPECT_TRUE(status().position_known);
    EXPECT_FALSE(person_.sees("inspector/joints/not_known"));

    for (const char* way : {"hand/jog/plus_1", "hand/jog/plus_2", "hand/jog/plus_3", "hand/jog/plus_4"}) {
        jog(way);
    }
    person_.click("lower/tabs/points");
    for (const char* way : {"hand/jog/plus_1", "hand/jog/plus_2", "hand/jog/minus_1"}) {
        jog(way);
        person_.click("lower/arm_teach");
    }
    ASSERT_EQ(points().size(), 3U);
    keep("taught");
    play_points();
    keep("played");

    // The thesis begins with the upper arm upright and the forearm level.
    choose_file("arm_open_points", "ready.json");
    play_points();
    double farthest = 0.0, lowest = 1e9;
    std::vector<actions::CardPlace> way;
    follow([&] { choose_file("arm_play_file", "thesis.mot"); },
           [&] {
               farthest = std::max(farthest, tip().x());
               lowest = std::min(lowest, tip().z());
               if (const auto& place = person_.app().arm().card_run().place(); place && !place->sending) {
                   EXPECT_GE(place->time, way.empty() ? 0.0 : way.back().time);
                   if (way.size() % 300 == 100) {
                       keep("under-way-" + std::to_string(way.size()));
                   }
                   way.push_back(*place);
               }
           });
    ASSERT_FALSE(way.empty()); // the window showed how far it was
    EXPECT_GT(way.back().share, 0.9);
    EXPECT_GT(way.back().line, way.back().lines - 8);
    EXPECT_LT(way.front().share, 0.3);
    EXPECT_FALSE(person_.app().arm().card_run().place());
    EXPECT_NEAR(farthest, 1100.0, near_mm);
    EXPECT_NEAR(lowest, 550.0, near_mm);
    EXPECT_NEAR((tip() - Vec3(800.0, 0.0, 650.0)).norm(), 0.0, near_mm); // where it began
    keep("file");

    choose_file("arm_play_file", "thesis.mot");
    ASSERT_TRUE(person_.live_until([&] { return tip().x() > 900.0; }, longest_s)) << status().message;
    person_.click("timeline/machine_hold");
    ASSERT_TRUE(person_.live_until([&] { return bench_.is(DriverState::holding); }));
    const auto let_pass = [&](double seconds) {
        const double begin = bench_.pmac.time();
        ASSERT_TRUE(person_.live_until([&] { return bench_.pmac.time() > begin + seconds; }));
    };
    constexpr double braking = 1.0; // s: the card's I195 as it leaves the factory
    let_pass(braking);
    double held = bench_.pmac.degrees(2);
    ASSERT_TRUE(person_.live_until([&] {
        let_pass(0.1);
        const double before = std::exchange(held, bench_.pmac.degrees(2));
        return std::abs(held - before) < 0.1 * near_deg;
    }));
    keep("held");
    let_pass(0.5);
    EXPECT_NEAR(bench_.pmac.degrees(2), held, near_deg);
    person_.click("timeline/machine_resume");
    ASSERT_TRUE(person_.live_until([&] { return bench_.is(DriverState::running) && bench_.pmac.moving(); }));
    bench_.pmac.pull_plug();
    ASSERT_TRUE(person_.live_until([&] { return bench_.is(DriverState::alarm) && !bench_.pmac.moving(); }));
    EXPECT_FALSE(bench_.pmac.any_power());
    const double stopped = bench_.pmac.degrees(2);
    EXPECT_FALSE(person_.refusal("lower/arm_play_points").empty());
    EXPECT_FALSE(person_.refusal("lower/arm_teach").empty());
    EXPECT_TRUE(person_.sees("alarm/message"));
    EXPECT_FALSE(status().position_known); // the arm went on for a while, to an unknown position
    EXPECT_TRUE(person_.sees("inspector/joints/not_known"));
    keep("pulled");

    bench_.pmac.pull_plug(false);
    const double plugged = bench_.pmac.time();
    ASSERT_TRUE(person_.live_until([&] { return bench_.pmac.time() > plugged + 0.5; }));
    EXPECT_NEAR(bench_.pmac.degrees(2), stopped, near_deg); // nothing moves without a command
    EXPECT_FALSE(bench_.pmac.any_power());
    person_.click("hand/connection/machine_reset");
    ASSERT_TRUE(person_.live_until([&] { return bench_.is(DriverState::idle); }));
    EXPECT_FALSE(bench_.pmac.any_power());
    person_.click("hand/power/arm_enable");
    ASSERT_TRUE(person_.live_until([&] { return bench_.pmac.powered() && status().powered; }));
    play_points();
    keep("recovered");
}

// The settings of the fifth motor are loaded while "Axis 5" is off.
TEST_F(ArmAtPmacShow, PlayNamesTheFifthMotorThatIsNotDrivenAndTheRemedy) {
    write_file(person_.folder() / "axis-5.ini", read_file("assets/samples/pmac-axis-5.ini"));
    choose_pmac();
    bench_.connect();
    const int before = status().answer.number;
    choose_file("arm_card_settings", "axis-5.ini");
    ASSERT_TRUE(person_.live_until([&] {
        return status().answer.number > before &&
               status().answer.state == drivers::CommandAnswer::State::done && bench_.is(DriverState::idle);
    })) << status().answer.text;

    person_.click("hand/power/arm_enable");
    ASSERT_TRUE(person_.live_until([&] { return bench_.pmac.powered() && status().powered; }));
    follow([&] { person_.click("hand/power/machine_home"); });
    ASSERT_TRUE(status().position_known && bench_.pmac.powered()) << status().message;
    constexpr double settled = 0.2; // s of the card
    ASSERT_TRUE(person_.live_until([&] { return bench_.pmac.time() > bench_.pmac.last_motion() + settled; }));
    const double moved = bench_.pmac.last_motion();

    person_.click("lower/tabs/points");
    choose_file("arm_open_points", "ready.json");
    ASSERT_EQ(person_.refusal("lower/arm_play_points"), "");
    person_.click("lower/arm_play_points");
    ASSERT_TRUE(person_.live_until([&] { return !status().message.empty(); }));
    const std::string refusal = "'&1B1R' is rejected: ERR012, a motor is in open loop; the card's settings "
                                "assign to coordinate system 1 also motor 5 (71.1111B), which is not driven "
                                "here: connect with its axis (\"Axis 5\", --axes XYZAB), or load settings "
                                "without it";
    EXPECT_EQ(status().message, refusal);
    EXPECT_THAT(person_.app().view_state().log, testing::Contains(testing::StartsWith(refusal)));
    person_.frames(3);
    keep("axis-5-off");
    EXPECT_TRUE(bench_.is(DriverState::idle));
    EXPECT_EQ(bench_.pmac.last_motion(), moved) << "nothing moved";
}

} // namespace
} // namespace millwright::panels
