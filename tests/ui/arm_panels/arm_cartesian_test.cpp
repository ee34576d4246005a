// U5: jogs along the axes of the base and of the tool, at an emulated PMAC over TCP, in real time.
#include "core/base/units.h"
#include "tests/ui/person/arm_at_pmac.h"
#include "ui/workspaces/arm_workspace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>

namespace millwright::panels {
namespace {

using drivers::DriverState;

class ArmAtPmacU5 : public ::testing::Test {
protected:
    /// The forearm bent, so that the tip can go anywhere.
    void be_ready() {
        constexpr double bent_deg = 20.0;
        bench_.connect();
        bench_.give_power();
        tell("ZZ");
        ASSERT_TRUE(person_.live_until([&] { return status().position_known && bench_.rests(); }));
        tell("#3J=3000");
        ASSERT_TRUE(person_.live_until(
            [&] { return bench_.pmac.degrees(3) > bent_deg - 0.2 && bench_.is(DriverState::idle); }));
        let_the_picture_follow();
    }
    void tell(const std::string& line) {
        person_.app().connection().tell([&](drivers::Driver& driver) { (void)driver.command(line); });
    }
    [[nodiscard]] drivers::DriverStatus status() { return person_.app().look().connection.status; }
    [[nodiscard]] Frame tool() { return person_.app().arm().tool(); }
    void let_the_picture_follow() {
        ASSERT_TRUE(person_.live_until([&] {
            double off = 0.0;
            for (int motor = 1; motor <= 4; ++motor) {
                const double drawn = to_degrees(person_.app().arm().joints()[motor - 1]);
                off = std::max(off, std::abs(drawn - bench_.pmac.degrees(motor)));
            }
            return off < 0.02 && bench_.rests();
        }));
    }
    /// Held until the tip has gone some way; a window that is too busy ends the jog, which then begins anew.
    void hold(const std::string& button) {
        constexpr int tries = 20;
        constexpr double far_mm = 8.0;
        const Vec3 from = tool().translation();
        const auto far = [&] { return (Vec3(tool().translation()) - from).norm() > far_mm; };
        for (int n = 0; n < tries && !far(); ++n) {
            bench_.point_at(("hand/jog/" + button).c_str());
            person_.hold_button(true);
            (void)person_.live_until([&] { return far() || (n > 0 && bench_.rests()); }, 10.0);
            person_.hold_button(false);
            ASSERT_TRUE(person_.live_until([&] { return bench_.rests(); }));
        }
        ASSERT_TRUE(far()) << button << ": " << status().message;
        let_the_picture_follow();
    }

    test::ArmAtPmac bench_;
    test::Person& person_ = bench_.person;
};

TEST_F(ArmAtPmacU5, TheTipGoesAlongAnAxisOfTheBaseOrOfTheToolAndNowhereElse) {
    ASSERT_NO_FATAL_FAILURE(be_ready());
    const std::pair<const char*, const char*> cases[] = {
        {"base", "minus_Z"}, {"base", "plus_Y"}, {"tool", "minus_x"}, {"tool", "plus_z"}};
    for (const auto& [frame, button] : cases) {
        person_.click(std::string("hand/jog/frame/") + frame);
        const Frame before = tool();
        const std::string name(button);
        const auto axis =
            static_cast<Eigen::Index>(std::string("xyz").find(static_cast<char>(std::tolower(name.back()))));
        const Mat3 axes = std::string(frame) == "tool" ? Mat3(before.linear()) : Mat3(Mat3::Identity());
        const Vec3 wanted = (name.starts_with("plus") ? 1.0 : -1.0) * axes.col(axis);
        ASSERT_NO_FATAL_FAILURE(hold(name)) << name;
        const Vec3 way = tool().translation() - before.translation();
        const double along = way.dot(wanted);
        EXPECT_GT(along, 5.0) << name;
        EXPECT_LT((way - along * wanted).norm(), 0.1 * along + 0.5) << name;
        person_.keep("arm-jog-" + std::string(frame) + "-" + name);
    }
}

} // namespace
} // namespace millwright::panels
