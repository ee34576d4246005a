#include "ui/workspaces/run_check.h"

#include "ui/workspaces/frame_state.h"
#include "ui/workspaces/start_prompt.h"
#include "ui/workspaces/tool_changes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace millwright::actions {

namespace {

bool same_positions(const kinematics::AxisPositions& a, const kinematics::AxisPositions& b) {
    constexpr double noise = 1e-3; // mm or rad: of scales read at rest
    return a.size() == b.size() && (a.size() == 0 || !((a - b).cwiseAbs().maxCoeff() > noise)); // NaN is NaN
}

bool same_offsets(const std::vector<drivers::StoredOffset>& a, const std::vector<drivers::StoredOffset>& b) {
    return std::ranges::equal(a, b, [](const drivers::StoredOffset& x, const drivers::StoredOffset& y) {
        return x.name == y.name && same_positions(x.value, y.value);
    });
}

bool same(const std::optional<double>& a, const std::optional<double>& b) {
    return a.has_value() == b.has_value() && (!a || !(*a < *b || *a > *b));
}

bool same_limits(const drivers::MachineLimits& a, const drivers::MachineLimits& b) {
    return same(a.spindle_rpm, b.spindle_rpm) && std::ranges::equal(a.axes, b.axes, [](auto& x, auto& y) {
               return x.letter == y.letter && same(x.min, y.min) && same(x.max, y.max) &&
                      same(x.travel, y.travel) && same(x.speed, y.speed);
           });
}

bool same_abilities(const drivers::Capabilities& a, const drivers::Capabilities& b) {
    return a.takes == b.takes && a.dialect == b.dialect && a.mist == b.mist &&
           a.program.tool_changes == b.program.tool_changes && a.laser == b.laser && a.firmware == b.firmware;
}

bool same_machine(const ConnectionView& a, const ConnectionView& b) {
    return a.link == b.link && a.choice.driver == b.choice.driver && a.axes == b.axes &&
           a.status.modes == b.status.modes && a.status.tool == b.status.tool &&
           a.status.position_doubt == b.status.position_doubt &&
           a.status.position_lost == b.status.position_lost && same_abilities(a.can, b.can) &&
           same_limits(a.limits, b.limits) && same_positions(a.status.position, b.status.position) &&
           same_offsets(a.offsets, b.offsets);
}

/// With the time of the macro.
RunWish finished(RunWish wish) {
    if (const auto& change = wish.source.tool_change; change && !change->macro_file.empty()) {
        std::error_code failure; // of a file that is not there, which the check reports
        wish.macro_written = std::filesystem::last_write_time(change->macro_file, failure);
    }
    return wish;
}

jobs::Job job_of(const RunWish& wish) {
    if (!wish.queued) {
        return wish.approach ? wish.approach->job.value() : make_job(wish.source);
    }
    jobs::Job job = *wish.queued;
    if (!job.tool_change) {
        job.tool_change = wish.source.tool_change;
    }
    return job;
}

} // namespace

RunWish run_wish(const FrameState& now) {
    return finished(
        {job_source(now), nullptr, now.view_state.start_at.on ? now.approach : nullptr, now.connection, {}});
}

RunWish run_wish(const FrameState& now, std::shared_ptr<const jobs::Job> queued) {
    JobSource source;
    source.as_text = queued->program == nullptr;
    if (source.as_text) {
        source.tool_change = tool_change_plan(now.view_state.manual, now.connection);
    }
    return finished({std::move(source), std::move(queued), nullptr, now.connection, {}});
}

widgets::Permission run_check_passed(const FrameState& now) {
    return now.run_check ? refused_for(now.run_check->faults) : widgets::Permission{};
}

widgets::Permission next_check_passed(const FrameState& now) {
    return now.next_check ? refused_for(now.next_check->faults) : widgets::Permission{};
}

bool asks_the_same(const RunWish& a, const RunWish& b) {
    return a.source == b.source && a.queued == b.queued && a.approach == b.approach &&
           a.macro_written == b.macro_written && same_machine(a.machine, b.machine);
}

RunCheck check_run(const std::shared_ptr<const RunWish>& wish, const Progress& progress) {
    RunCheck check{wish, {}};
    try {
        jobs::Job job = job_of(*wish);
        read_macro(job);
        const auto start = std::make_shared<const StartWish>(start_wish(std::move(job), {}, wish->machine));
        check.faults =
            wish->source.as_text ? check_start(start, progress).faults : jobs::preflight(*start->job);
    } catch (const Error& error) {
        check.faults.push_back(error.diagnostic());
    }
    return check;
}

} // namespace millwright::actions
