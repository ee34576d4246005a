#include "ui/actions/workshop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace millwright::actions {
namespace {

namespace fs = std::filesystem;

class WorkshopOnDisk : public ::testing::Test {
protected:
    WorkshopOnDisk()
        : folder_(fs::temp_directory_path() / ("workshop_" + std::to_string(::getpid()))),
          workshop_({.assets = "assets",
                     .log_folder = folder_ / "jobs",
                     .settings = {},
                     .recovery = {},
                     .wake = [] {}}) {
        workshop_.session().workspace = Workspace::machine;
        workshop_.wait_idle();
    }
    ~WorkshopOnDisk() override { fs::remove_all(folder_); }

    fs::path folder_;
    Workshop workshop_;
};

// The machine was not connected yet, took no notice, and the job ran to its end.
TEST_F(WorkshopOnDisk, AStopInTheMomentInWhichAJobBeginsIsNotLost) {
    workshop_.session().machine_speed = 1.0;
    for (const char* const stop : {"machine.emergency_stop", "machine.stop"}) {
        for (int n = 0; n < 5; ++n) {
            workshop_.run("machine.run");
            workshop_.run(stop);
            workshop_.wait_idle();
            const JobView job = workshop_.look().job;
            EXPECT_FALSE(job.running);
            EXPECT_TRUE(job.failure || (job.outcome && job.outcome->end != jobs::JobEnd::done)) << stop;
        }
    }
}

TEST_F(WorkshopOnDisk, HoldsResumesAndStopsAJob) {
    workshop_.session().machine_speed = 50.0;
    workshop_.run("machine.run");
    const auto state = [&] {
        const auto report = workshop_.look().job.report;
        return report ? report->driver.state : drivers::DriverState::disconnected;
    };
    while (workshop_.look().job.running && state() != drivers::DriverState::running) {
        std::this_thread::yield();
    }
    workshop_.advance(0.01);
    workshop_.run("machine.hold");
    while (workshop_.look().job.running && state() != drivers::DriverState::holding) {
        std::this_thread::yield();
    }
    EXPECT_EQ(state(), drivers::DriverState::holding);
    workshop_.run("machine.stop");
    workshop_.wait_idle();
    const auto outcome = workshop_.look().job.outcome;
    ASSERT_TRUE(outcome.has_value());
    EXPECT_EQ(outcome->end, jobs::JobEnd::stopped);
    EXPECT_LT(outcome->executed_blocks, outcome->blocks);

    // The timeline stays where the machine stands, until somebody moves it.
    workshop_.advance(0.01);
    const auto moment = workshop_.look().moment();
    ASSERT_TRUE(moment.has_value());
    EXPECT_TRUE(workshop_.look().at_machine());
    EXPECT_LT((moment->axes - outcome->position).cwiseAbs().maxCoeff(), 1e-6);
    workshop_.session().playback.time = 0.0;
    workshop_.advance(0.01);
    EXPECT_FALSE(workshop_.look().at_machine());
}

TEST_F(WorkshopOnDisk, AJobThatCannotBeLoggedDoesNotStart) {
    fs::create_directories(folder_);
    std::FILE* blocker = std::fopen((folder_ / "jobs").c_str(), "w");
    ASSERT_NE(blocker, nullptr);
    std::fclose(blocker);
    workshop_.run("machine.run");
    workshop_.wait_idle();
    EXPECT_TRUE(workshop_.look().job.failure.has_value());
    EXPECT_FALSE(workshop_.look().job.outcome.has_value());
}

TEST_F(WorkshopOnDisk, ARefusedActionTellsItsReasonAndChangesNothing) {
    const project::Project before = workshop_.look().project;
    workshop_.run("edit.undo");
    EXPECT_EQ(workshop_.look().project, before);
    EXPECT_EQ(workshop_.session().log.back(), "There is nothing to undo.");
}

} // namespace
} // namespace millwright::actions
