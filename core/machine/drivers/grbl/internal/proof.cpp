#include "core/machine/drivers/grbl/internal/proof.h"

#include <algorithm>

namespace millwright::machine::grbl {

namespace {

constexpr int segment_blocks =
    6; // that may have left the planner and still be under way: Grbl's segment buffer

} // namespace

Proof::Proof(const ProgramLines& program, int planner_blocks)
    : program_(&program), planner_blocks_(planner_blocks) {}

void Proof::acknowledged() {
    ++acknowledged_;
    disturbed();
}

/// Lines before `line` but for the last ones that hold `sure_moves` blocks or more.
int Proof::before(int line, int sure_moves) const {
    while (line > 0 && sure_moves > 0) {
        --line;
        sure_moves -= program_->lines[static_cast<std::size_t>(line)].surely_moves ? 1 : 0;
    }
    return line;
}

int Proof::bound(const StatusMessage& report) const {
    int used = planner_blocks_;
    if (report.free_blocks) {
        used = std::clamp(planner_blocks_ - *report.free_blocks, 0, planner_blocks_);
    }
    int result = before(acknowledged_, used + segment_blocks);
    if (report.line) {
        const auto& lines = program_->lines;
        const auto found = std::ranges::lower_bound(
            lines, *report.line - 1, {}, [](const ProgramLine& line) { return line.block; });
        const int at = static_cast<int>(found - lines.begin());
        // A line that is being planned may be in motion before it is acknowledged; none after it can be.
        const int by_line = at <= acknowledged_ ? before(at, segment_blocks) : 0;
        result = report.free_blocks ? std::min(result, by_line) : std::max(result, by_line);
    }
    return result;
}

void Proof::reported(const StatusMessage& report, bool all_answered) {
    if (program_ == nullptr) {
        return;
    }
    idle_reports_ = report.state == MachineState::idle && all_answered ? idle_reports_ + 1 : 0;
    const int now = bound(report);
    executed_ = std::max(executed_, std::min(now, last_bound_)); // one report could be a changed one
    last_bound_ = now;
    if (settled()) {
        executed_ = acknowledged_;
    }
}

} // namespace millwright::machine::grbl
