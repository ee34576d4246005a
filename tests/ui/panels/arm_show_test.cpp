// A whole session at the arm with real mouse and keys, at an emulated PMAC over TCP in real time: connect,
// home, jog every axis, teach three points, play them, run the three lines of the thesis, pull the plug in
// the middle, recover.
#include "core/base/files.h"
#include "core/base/units.h"
#include "tests/ui/panels/arm_at_pmac.h"
#include "ui/actions/arm_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace millwright::panels {
namespace {

using machine::DriverState;

class ArmAtPmacShow : public ::testing::TestWithParam<render::PixelSize> {
protected:
    ArmAtPmacShow() : bench_(GetParam()) {}

    [[nodiscard]] actions::ArmBench& arm() { return bench_.person.workshop().arm(); }
    [[nodiscard]] bool known() { return bench_.person.workshop().look().controller.status.message.empty(); }
    void keep(const std::string& name) {
        bench_.person.keep("arm-show-" + name + (GetParam().width > 1300 ? "" : "-small"));
    }
    /// Once more where a busy computer made the card stop by itself.
    void
    insist(const std::string& what, const std::function<void()>& begin, const std::function<bool()>& done) {
        constexpr int tries = 20;
        for (int n = 0; n < tries; ++n) {
            bench_.give_power();
            begin();
            if (bench_.person.live_until([&] { return done() || bench_.is(DriverState::alarm); }, 120.0) &&
                !bench_.is(DriverState::alarm)) {
                return;
            }
        }
        FAIL() << what << ": " << bench_.person.workshop().look().controller.status.message;
    }
    [[nodiscard]] bool stands_at(const project::TaughtPoint& point) {
        for (int motor = 1; motor <= 4; ++motor) {
            if (std::abs(bench_.pmac.degrees(motor) - point.joints_deg[static_cast<std::size_t>(motor) - 1]) >
                0.2) {
                return false;
            }
        }
        return bench_.is(DriverState::idle);
    }
    [[nodiscard]] const std::vector<project::TaughtPoint>& points() {
        return bench_.person.project().arm.points;
    }

    void home() {
        insist(
            "home",
            [&] { bench_.person.click("hand/power/machine_home"); },
            [&] { return bench_.is(DriverState::idle) && known(); });
    }
    void jog_every_axis() {
        for (int motor = 1; motor <= 4; ++motor) {
            const double before = bench_.pmac.degrees(motor);
            bench_.jog(("hand/jog/plus_" + std::to_string(motor)).c_str(), motor);
            bench_.person.hold_button(false);
            ASSERT_TRUE(bench_.person.live_until([&] { return bench_.rests(); }));
            EXPECT_GT(bench_.pmac.degrees(motor), before + 0.2);
        }
    }
    /// The picture has come to where the motors are.
    void let_the_picture_follow() {
        ASSERT_TRUE(bench_.person.live_until([&] {
            for (int motor = 1; motor <= 4; ++motor) {
                if (std::abs(to_degrees(arm().joints()[motor - 1]) - bench_.pmac.degrees(motor)) > 0.05) {
                    return false;
                }
            }
            return bench_.rests();
        }));
    }
    void teach_three() {
        bench_.person.click("lower/tabs/points");
        bench_.person.frames(2);
        for (const char* way : {"hand/jog/plus_1", "hand/jog/plus_2", "hand/jog/minus_1"}) {
            bench_.jog(way, std::string_view(way).back() - '0');
            bench_.person.hold_button(false);
            let_the_picture_follow();
            bench_.person.click("lower/arm_teach");
        }
        ASSERT_EQ(points().size(), 3U);
    }
    void play_points() {
        insist(
            "play",
            [&] { bench_.person.click("lower/arm_play_points"); },
            [&] { return stands_at(points().back()); });
    }

    test::ArmAtPmac bench_;
};

TEST_P(ArmAtPmacShow, ConnectsHomesJogsTeachesPlaysRunsAFileLosesThePlugAndRecovers) {
    bench_.connect();
    home();
    jog_every_axis();
    teach_three();
    keep("taught");
    play_points();
    keep("played");

    // The thesis begins with the upper arm upright and the forearm level.
    bench_.person.workshop().edit(
        "Stand ready",
        [](project::Project& draft) {
            draft.arm.points = {{"Ready", {0.0, -90.0, 90.0, 0.0, 0.0}, false, 50.0}};
        },
        {});
    bench_.person.frames(2);
    const auto file = bench_.person.folder() / "thesis.mot";
    write_file(file, "G1 X300 Y0 Z0 F150 ;\nG1 X0 Y0 Z-100 ;\nG1 X-300 Y0 Z100 ;\n");
    double farthest = 0.0, lowest = 1e9;
    const auto run_file = [&] {
        play_points();
        let_the_picture_follow();
        farthest = 0.0;
        lowest = 1e9;
        bench_.person.workshop().play_motion_file(file);
    };
    const auto watch = [&] {
        const Vec3 tip = arm().tool().translation();
        farthest = std::max(farthest, tip.x());
        lowest = std::min(lowest, tip.z());
    };
    insist("the thesis's file", run_file, [&] {
        watch();
        return farthest > 1050.0 && stands_at(points().back());
    });
    EXPECT_NEAR(farthest, 1100.0, 15.0);
    EXPECT_NEAR(lowest, 550.0, 15.0);
    keep("file");

    insist("on the way", run_file, [&] {
        watch();
        return farthest > 950.0 && bench_.is(DriverState::running);
    });
    bench_.pmac.pull_plug();
    ASSERT_TRUE(
        bench_.person.live_until([&] { return bench_.is(DriverState::alarm) && !bench_.pmac.moving(); }));
    EXPECT_FALSE(bench_.pmac.any_power());
    const double stopped = bench_.pmac.degrees(2);
    EXPECT_FALSE(bench_.person.refusal("lower/arm_play_points").empty());
    keep("pulled");
    bench_.pmac.pull_plug(false);
    bench_.person.frames(30);
    EXPECT_NEAR(bench_.pmac.degrees(2), stopped, 0.2); // nothing moves by itself
    EXPECT_FALSE(bench_.pmac.any_power());
    play_points(); // looked at, unlocked, given power
    keep("recovered");
    for (const std::string& cut : bench_.person.desktop().ui().cut_texts()) {
        ADD_FAILURE() << cut;
    }
}

INSTANTIATE_TEST_SUITE_P(Screens,
                         ArmAtPmacShow,
                         ::testing::Values(render::PixelSize{1280, 800}, render::PixelSize{1600, 1000}),
                         [](const auto& screen) { return "Wide" + std::to_string(screen.param.width); });

} // namespace
} // namespace millwright::panels
