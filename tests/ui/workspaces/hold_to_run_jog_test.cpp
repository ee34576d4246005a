// Moving by hand as long as a window wants it in every frame, at the virtual machine in real time.
#include "ui/workspaces/hold_to_run_jog.h"

#include "core/kinematics/machine_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>

namespace millwright::actions {
namespace {

using Clock = std::chrono::steady_clock;

TEST(HoldToRunJog, GivesASlowWindowMoreTimeThanAQuickOneAndAHungOneNone) {
    EXPECT_DOUBLE_EQ(HoldToRunJog::dead_man_for(0.0), 0.1);
    EXPECT_DOUBLE_EQ(HoldToRunJog::dead_man_for(0.06), 0.1); // a frame of the arm in software
    EXPECT_DOUBLE_EQ(HoldToRunJog::dead_man_for(0.12), 0.18);
    EXPECT_DOUBLE_EQ(HoldToRunJog::dead_man_for(5.0), 0.25);
}

TEST(HoldToRunJog, IsNotInterruptedByFramesThatAreSlowOneLikeAnother) {
    const auto folder = std::filesystem::temp_directory_path() / ("jog_hand_" + std::to_string(::getpid()));
    MachineConnection connection(folder, [] {});
    const auto model = std::make_shared<const kinematics::MachineModel>(
        kinematics::read_machine("assets/machines/router-xyz.json"));
    connection.connect(machine::DriverChoice{}, model, nullptr);
    connection.wait_idle();
    const auto driver = connection.driver();
    ASSERT_TRUE(driver);
    driver->trust_position();
    HoldToRunJog jog(connection);
    JogWish wish{kinematics::AxisPositions::Zero(model->axis_count()), 1.0};
    wish.direction[0] = 1.0;
    constexpr int wanted = 5, most_frames = 500;
    int looks = 0, frames = 0;
    auto last = Clock::now();
    for (int n = 0; n < most_frames && looks < wanted; ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(130));
        const bool goes_on = driver->status().activity == drivers::Activity::jog;
        const auto now = Clock::now();
        const double frame = std::chrono::duration<double>(now - std::exchange(last, now)).count();
        if (frame > 0.17) { // the computer was too busy: it is pressed anew
            jog.follow(std::nullopt, true);
            frames = 0;
        }
        jog.follow(wish, true);
        if (++frames > 3) { // by now it knows how slow a frame is
            EXPECT_TRUE(goes_on) << frame;
            ++looks;
        }
    }
    EXPECT_EQ(looks, wanted) << "in " << most_frames << " frames no five were as long as asked for";
    jog.let_go();
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace millwright::actions
