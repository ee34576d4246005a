#include "ui/machine_panels/job_time_left.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace millwright::panels {

namespace {

/// A controller that plans for itself tells lines and no times: then those of our plan, from the line that it
/// is at as far as is known.
std::optional<double> left_by_lines(const FrameState& now, const jobs::JobReport& report) {
    if (!now.job_is_shown() || !now.in_file() || !now.opened->motion || !now.job.listing) {
        return std::nullopt;
    }
    const std::vector<int>& lines = now.job.listing->line_of_block;
    const auto at =
        static_cast<std::size_t>(std::max({0, report.driver.executed_blocks, report.driver.block}));
    if (at >= lines.size()) {
        return 0.0;
    }
    const plan::PlannedMotion& plan = *now.opened->motion;
    const std::vector<int>& planned = plan.listing->line_of_block;
    const auto next = std::ranges::find_if(planned, [&](int line) { return line >= lines[at]; });
    if (next == planned.end()) {
        return 0.0;
    }
    const auto behind = std::ranges::find_if(next, planned.end(), [&](int line) { return line > *next; });
    const auto start = [&](auto block) {
        return block == planned.end() ? plan.trajectory->duration()
                                      : plan.trajectory->start_of(static_cast<int>(block - planned.begin()));
    };
    const bool is_on_it = *next == lines[at] && static_cast<int>(at) == report.driver.block;
    const double done = is_on_it ? report.driver.fraction * (start(behind) - start(next)) : 0.0;
    return plan.trajectory->duration() - start(next) - done;
}

} // namespace

std::optional<double> job_time_left(const FrameState& now, const jobs::JobReport& report) {
    if (now.connection.connected() && now.connection.can.takes_text()) {
        return left_by_lines(now, report);
    }
    // What begins at a line is a job of its own, with a way in and times that are not the program's.
    const bool of_program = now.job_is_shown() && now.job.from_line <= 1;
    const bool has_own = report.planned_time > 0.0 || !now.job_is_shown();
    const double total = has_own ? report.planned_time : now.duration();
    const double done = has_own && !of_program ? report.driver.planned_time : now.time();
    return total > 0.0 ? std::optional(total - done) : std::nullopt;
}

} // namespace millwright::panels
