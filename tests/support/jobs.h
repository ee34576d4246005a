// Jobs, clocks without time and folders for tests of the machine room.
#pragma once

#include "core/base/clock.h"
#include "core/jobs/job.h"
#include "core/motion/planner.h"
#include "core/posts/writer.h"
#include "tests/support/programs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <mutex>
#include <string>

namespace millwright::test {

/// Time passes only when somebody waits.
class ManualClock final : public Clock {
public:
    [[nodiscard]] double now() const override {
        const std::scoped_lock lock(mutex_);
        return now_;
    }
    void wait(double seconds) override {
        const std::scoped_lock lock(mutex_);
        now_ += seconds;
    }

private:
    mutable std::mutex mutex_;
    double now_ = 100.0;
};

/// A folder that is gone after the test.
class TemporaryFolder {
public:
    TemporaryFolder() {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ =
            std::filesystem::path(::testing::TempDir()) /
            (std::string(test->test_suite_name()) + "." + test->name() + "." + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() { std::filesystem::remove_all(folder_); }

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

private:
    std::filesystem::path folder_;
};

/// A job on the thesis's machine.
inline jobs::Job job_of(program::Program program) {
    jobs::Job job;
    job.name = "test";
    job.project = "test project";
    job.machine = std::make_shared<const kinematics::MachineModel>(machine("rotary-tilt-listing"));
    job.listing = std::make_shared<const program::Listing>(posts::write_gcode(program, {}));
    job.program = std::make_shared<const program::Program>(std::move(program));
    return job;
}

inline jobs::Job dome_job() {
    return job_of(post_over("dome", machine("rotary-tilt-listing"), 5, 6).program);
}

inline drivers::Work work_of(const jobs::Job& job) {
    const auto trajectory = motion::plan(*job.program, *job.machine, job.planner, {});
    return {job.program, std::make_shared<const motion::Trajectory>(trajectory), job.listing};
}

} // namespace millwright::test
