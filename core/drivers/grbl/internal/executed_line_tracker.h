// What of a program Grbl has executed for certain. Grbl acknowledges a line when it has planned it, not when
// it has executed it, and its planner runs ahead of its motors. docs/reference/grbl.md tells why each rule
// holds.
#pragma once

#include "core/drivers/grbl/internal/messages.h"
#include "core/drivers/grbl/internal/program_lines.h"

#include <algorithm>
#include <optional>

namespace millwright::drivers::grbl {

class ExecutedLineTracker {
public:
    ExecutedLineTracker() = default;
    /// `planner_blocks`: that the controller's planner holds at most; `segment_blocks`: that may have left it
    /// and still be under way.
    ExecutedLineTracker(const ProgramLines& program, int planner_blocks, int segment_blocks);

    /// The first `lines` are executed already.
    void begin_at(int lines) { acknowledged_ = executed_ = lines; }
    /// One more line was acknowledged.
    void acknowledged();
    /// A report that came after all acknowledgements so far. `all_answered`: nothing else is under way.
    void reported(const StatusMessage& report, bool all_answered);
    /// Something came that is no report: two reports in a row are no longer in a row.
    void disturbed() { idle_reports_ = 0; }

    [[nodiscard]] int acknowledged_lines() const { return acknowledged_; }
    [[nodiscard]] int executed_lines() const { return executed_; }
    /// The line that seems to be in execution, by the last report; where that tells nothing of it, the first
    /// that is not executed for certain. Proves nothing.
    [[nodiscard]] int line_at_hand() const { return std::max(executed_, at_hand_); }
    /// Whether the machine was at rest in the last two reports with every acknowledged line done.
    [[nodiscard]] bool settled() const { return idle_reports_ >= 2; }

private:
    [[nodiscard]] int before(int line, int sure_moves) const;
    [[nodiscard]] int bound(const StatusMessage& report) const;
    [[nodiscard]] bool pauses_next() const;
    /// Where in the program the line with that number of Ln stands.
    [[nodiscard]] int reported_line(int number) const;
    [[nodiscard]] int at_hand(const StatusMessage& report) const;
    /// Blocks of the planner that are taken; nothing: the report does not say.
    [[nodiscard]] std::optional<int> used_blocks(const StatusMessage& report) const;

    const ProgramLines* program_ = nullptr;
    int planner_blocks_ = 0;
    int segment_blocks_ = 0;
    int acknowledged_ = 0;
    int executed_ = 0;
    int at_hand_ = 0;
    int last_bound_ = 0;
    int idle_reports_ = 0;
};

} // namespace millwright::drivers::grbl
