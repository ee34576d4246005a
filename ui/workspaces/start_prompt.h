// What a job would do on a real machine, for the person who is asked before it moves. Lengths mm, angles rad.
#pragma once

#include "core/drivers/driver.h"
#include "core/jobs/job.h"
#include "core/jobs/job_queue.h"
#include "core/jobs/program_check.h"
#include "ui/workspaces/latest_work.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::actions {

struct ConnectionView;

/// The job that is to be started, and the machine as it was when that was asked.
struct StartWish {
    std::shared_ptr<const jobs::Job> job;     ///< never null
    std::optional<jobs::QueuedJobId> queued;  ///< nothing: the program that is shown
    std::string machine;                      ///< "grblHAL 1.1f at /dev/ttyACM0"
    jobs::ProgramCheckSettings program_check; ///< from its present position, with its offsets
    drivers::MachineLimits limits;
    drivers::Capabilities can;
    drivers::DriverStatus status; ///< of the machine
    std::string gouges;           ///< FrameState::gouge_warning() of its program; empty: none
};

/// What a check of its whole program found.
struct StartCheck {
    std::shared_ptr<const StartWish> wish;
    jobs::ProgramCheck program_check;
    std::vector<Diagnostic> faults; ///< why it cannot be started
    std::vector<Diagnostic> warnings;
    int tool_stops = 0; ///< tool changes that are made here
    std::string tool;   ///< jobs::tool_before_start() of the job
};

[[nodiscard]] StartWish
start_wish(jobs::Job job, std::optional<jobs::QueuedJobId> queued, const ConnectionView& machine);

/// Reads the whole program. Throws nothing but Cancelled: what is wrong is a fault.
[[nodiscard]] StartCheck check_start(const std::shared_ptr<const StartWish>& wish, const Progress& progress);

using StartChecker = LatestWork<std::shared_ptr<const StartWish>, StartCheck>;

} // namespace millwright::actions
