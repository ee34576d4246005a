// What Run would be refused for: worked out in the background each time that the program or the machine has
// changed, by the checks that are made before a job is sent.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"
#include "ui/workspaces/approach.h"
#include "ui/workspaces/job_source.h"
#include "ui/workspaces/latest_work.h"
#include "ui/workspaces/machine_connection.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace millwright::actions {

struct FrameState;

/// The job that is shown, or the next one of the queue, and the machine that would get it.
struct RunWish {
    JobSource source;                         ///< of a queued job its tool changes alone
    std::shared_ptr<const jobs::Job> queued;  ///< null: the job that is shown
    std::shared_ptr<const Approach> approach; ///< of a job from a line; null: from its beginning
    ConnectionView machine;                   ///< at rest
    std::filesystem::file_time_type
        macro_written; ///< of the tool change's macro, so that a repaired one is read
};

struct RunCheck {
    std::shared_ptr<const RunWish> wish;
    std::vector<Diagnostic> faults; ///< in their order; empty: nothing stands against it
};

/// Of what is shown. Only where job_ready() says yes.
[[nodiscard]] RunWish run_wish(const FrameState& now);
/// Of a job of the queue.
[[nodiscard]] RunWish run_wish(const FrameState& now, std::shared_ptr<const jobs::Job> queued);
/// Why what is shown is not run: the first of the faults of FrameState::run_check. While that is not known it
/// is allowed, since the same is checked again before anything is sent.
[[nodiscard]] widgets::Permission run_check_passed(const FrameState& now);
/// The same of the next job of the queue and FrameState::next_check.
[[nodiscard]] widgets::Permission next_check_passed(const FrameState& now);
/// Both have the same faults: positions within 0.001 mm, or rad, are the same.
[[nodiscard]] bool asks_the_same(const RunWish& a, const RunWish& b);
/// Reads the whole program. Throws nothing but Cancelled: what is wrong is a fault.
[[nodiscard]] RunCheck check_run(const std::shared_ptr<const RunWish>& wish, const Progress& progress);

using RunChecker = LatestWork<std::shared_ptr<const RunWish>, RunCheck>;

} // namespace millwright::actions
