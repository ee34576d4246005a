#include "core/drivers/grbl/internal/executed_line_tracker.h"

#include "core/drivers/stripped_line.h"

#include <algorithm>

namespace millwright::drivers::grbl {

namespace {

constexpr int at_rest = 0; // of Hold: nothing is on its way from the planner to the motors any more

} // namespace

ExecutedLineTracker::ExecutedLineTracker(const ProgramLines& program, int planner_blocks, int segment_blocks)
    : program_(&program), planner_blocks_(planner_blocks), segment_blocks_(segment_blocks) {}

void ExecutedLineTracker::acknowledged() {
    ++acknowledged_;
    disturbed();
}

/// Lines before `line` but for the last ones that hold `sure_moves` blocks or more.
int ExecutedLineTracker::before(int line, int sure_moves) const {
    while (line > 0 && sure_moves > 0) {
        --line;
        sure_moves -= program_->lines[static_cast<std::size_t>(line)].surely_moves ? 1 : 0;
    }
    return line;
}

std::optional<int> ExecutedLineTracker::used_blocks(const StatusMessage& report) const {
    return report.free_blocks
               ? std::optional(std::clamp(planner_blocks_ - *report.free_blocks, 0, planner_blocks_))
               : std::nullopt;
}

int ExecutedLineTracker::reported_line(int number) const {
    const auto& lines = program_->lines;
    const auto found =
        std::ranges::lower_bound(lines, number - 1, {}, [](const ProgramLine& line) { return line.block; });
    return static_cast<int>(found - lines.begin());
}

/// Grbl acknowledges M0 when it is resumed. An acknowledgement that came twice would have led behind it.
bool ExecutedLineTracker::pauses_next() const {
    if (acknowledged_ >= std::ssize(program_->lines)) {
        return false;
    }
    const std::string& text = program_->lines[static_cast<std::size_t>(acknowledged_)].text;
    return drivers::has_code(text, "M0") || drivers::has_code(text, "M00");
}

int ExecutedLineTracker::at_hand(const StatusMessage& report) const {
    if (report.line && *report.line > 0) {
        return std::min(reported_line(*report.line), acknowledged_);
    }
    const std::optional<int> used = used_blocks(report);
    return used ? before(acknowledged_, *used) : 0;
}

int ExecutedLineTracker::bound(const StatusMessage& report) const {
    const std::optional<int> used = used_blocks(report);
    if (report.state == MachineState::hold && report.sub_state == at_rest && used == 0 && pauses_next()) {
        return acknowledged_; // a hold in the middle of a block would leave that in the planner
    }
    int result = before(acknowledged_, used.value_or(planner_blocks_) + segment_blocks_);
    if (report.line) {
        const int at = reported_line(*report.line);
        // A line that is being planned may be in motion before it is acknowledged; none after it can be.
        const int by_line = at <= acknowledged_ ? before(at, segment_blocks_) : 0;
        result = report.free_blocks ? std::min(result, by_line) : std::max(result, by_line);
    }
    return result;
}

void ExecutedLineTracker::reported(const StatusMessage& report, bool all_answered) {
    if (program_ == nullptr) {
        return;
    }
    idle_reports_ = report.state == MachineState::idle && all_answered ? idle_reports_ + 1 : 0;
    const int now = bound(report);
    at_hand_ = at_hand(report);
    executed_ = std::max(executed_, std::min(now, last_bound_)); // one report could be a changed one
    last_bound_ = now;
    if (settled()) {
        executed_ = acknowledged_;
    }
}

} // namespace millwright::drivers::grbl
