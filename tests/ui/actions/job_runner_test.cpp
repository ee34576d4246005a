#include "ui/actions/app_controller.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace millwright::actions {
namespace {

namespace fs = std::filesystem;

class AppControllerOnDisk : public ::testing::Test {
protected:
    AppControllerOnDisk()
        : folder_(fs::temp_directory_path() / ("workshop_" + std::to_string(::getpid()))),
          app_({.assets = "assets",
                .log_folder = folder_ / "jobs",
                .settings = {},
                .recovery = {},
                .wake = [] {}}) {
        app_.view_state().workspace = Workspace::machine;
        app_.wait_idle();
    }
    ~AppControllerOnDisk() override { fs::remove_all(folder_); }

    fs::path folder_;
    AppController app_;
};

// The machine was not connected yet, took no notice, and the job ran to its end.
TEST_F(AppControllerOnDisk, AStopInTheMomentInWhichAJobBeginsIsNotLost) {
    app_.view_state().machine_speed = 1.0;
    for (const char* const stop : {"machine.emergency_stop", "machine.stop"}) {
        for (int n = 0; n < 5; ++n) {
            app_.run("machine.run");
            app_.run(stop);
            app_.wait_idle();
            const JobView job = app_.look().job;
            EXPECT_FALSE(job.running);
            EXPECT_TRUE(job.failure || (job.outcome && job.outcome->end != jobs::JobEnd::done)) << stop;
        }
    }
}

TEST_F(AppControllerOnDisk, HoldsResumesAndStopsAJob) {
    app_.view_state().machine_speed = 50.0;
    app_.run("machine.run");
    const auto state = [&] {
        const auto report = app_.look().job.report;
        return report ? report->driver.state : drivers::DriverState::disconnected;
    };
    while (app_.look().job.running && state() != drivers::DriverState::running) {
        std::this_thread::yield();
    }
    app_.advance(0.01);
    app_.run("machine.hold");
    while (app_.look().job.running && state() != drivers::DriverState::holding) {
        std::this_thread::yield();
    }
    EXPECT_EQ(state(), drivers::DriverState::holding);
    app_.run("machine.stop");
    app_.wait_idle();
    const auto outcome = app_.look().job.outcome;
    ASSERT_TRUE(outcome.has_value());
    EXPECT_EQ(outcome->end, jobs::JobEnd::stopped);
    EXPECT_LT(outcome->executed_blocks, outcome->blocks);

    // The timeline stays where the machine stands, until somebody moves it.
    app_.advance(0.01);
    const auto moment = app_.look().moment();
    ASSERT_TRUE(moment.has_value());
    EXPECT_TRUE(app_.look().at_machine());
    EXPECT_LT((moment->axes - outcome->position).cwiseAbs().maxCoeff(), 1e-6);
    app_.view_state().playback.time = 0.0;
    app_.advance(0.01);
    EXPECT_FALSE(app_.look().at_machine());
}

TEST_F(AppControllerOnDisk, AJobThatCannotBeLoggedDoesNotStart) {
    fs::create_directories(folder_);
    std::FILE* blocker = std::fopen((folder_ / "jobs").c_str(), "w");
    ASSERT_NE(blocker, nullptr);
    std::fclose(blocker);
    app_.run("machine.run");
    app_.wait_idle();
    EXPECT_TRUE(app_.look().job.failure.has_value());
    EXPECT_FALSE(app_.look().job.outcome.has_value());
}

TEST_F(AppControllerOnDisk, ARefusedActionTellsItsReasonAndChangesNothing) {
    const project::Project before = app_.look().project;
    app_.run("edit.undo");
    EXPECT_EQ(app_.look().project, before);
    EXPECT_EQ(app_.view_state().log.back(), "There is nothing to undo.");
}

} // namespace
} // namespace millwright::actions
