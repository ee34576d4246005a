// Tool changes of a program that goes to a controller without them: where they are, and whether what this
// program would send at them can be done. docs/reference/tool-change.md.
#pragma once

#include "core/jobs/job.h"
#include "core/jobs/program_check.h"

#include <string>
#include <string_view>
#include <vector>

namespace millwright::jobs {

/// A tool change of a program.
struct ToolCall {
    int line = 0, column = 0; ///< of the M6, from 1
    int tool = 0;             ///< 0: there is no T word before it
    bool again = false;       ///< the last change was to the same tool
    std::string name;         ///< from the program's comments; may be empty
};

[[nodiscard]] std::vector<ToolCall> tool_calls(std::string_view text);

/// `text` with blanks in place of each M6: what a controller is sent of it, with the same lines and columns.
[[nodiscard]] std::string without_tool_changes(std::string_view text);

/// The text of a job as its controller executes it: without tool changes where they are made here.
[[nodiscard]] std::string controller_text(const Job& job);

/// ProgramCheckSettings::watched of a job: the lines at which it stops.
[[nodiscard]] std::vector<int> watched_lines(const Job& job);

/// What the driver is given of `job`, whose tool changes are made here; `found` is its check with
/// watched_lines().
[[nodiscard]] drivers::ToolChanges tool_changes(const Job& job, const ProgramCheck& found);

/// The machine before a job.
struct ToolChangePlace {
    const drivers::DriverStatus& status;
    const std::vector<drivers::StoredOffset>& offsets;
    const drivers::MachineLimits& limits;
    bool laser = false; ///< it is a laser's mode
};

/// Why the tool changes of `job` cannot be made here; empty also where it has none.
[[nodiscard]] std::vector<Diagnostic> tool_change_faults(const Job& job,
                                                         const ProgramCheck& found,
                                                         const drivers::Capabilities& able,
                                                         const ToolChangePlace& place);

/// What a person has to confirm before a job, because it cannot be read from the machine: which tool is in
/// the spindle, where the job begins at a line or measures a tool before its first. Empty: nothing. `found`
/// as for tool_changes().
[[nodiscard]] std::string tool_before_start(const Job& job, const ProgramCheck& found);

} // namespace millwright::jobs
