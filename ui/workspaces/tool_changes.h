// What a person has set for tool changes (M6) of jobs on a controller that has none, for each port.
#pragma once

#include "core/drivers/tool_change.h"
#include "core/jobs/job.h"

#include <optional>
#include <string>
#include <string_view>

namespace millwright::actions {

struct ConnectionView;
struct ManualSettings;

struct ToolChangeSettings {
    bool here = true;             ///< false: a program with M6 is refused
    drivers::ToolChangePlan plan; ///< without its macro's text, which is read when a job is started

    friend bool operator==(const ToolChangeSettings&, const ToolChangeSettings&) = default;
};

/// Of the machine that is connected or was last.
[[nodiscard]] ToolChangeSettings tool_change_settings(const ManualSettings& manual,
                                                      const ConnectionView& machine);

/// As Job::tool_change has it, without the macro's text.
[[nodiscard]] std::optional<drivers::ToolChangePlan> tool_change_plan(const ManualSettings& manual,
                                                                      const ConnectionView& machine);

/// Reads the file of a job's macro. Throws Error if it cannot be read.
void read_macro(jobs::Job& job);

/// A job waits for another tool: a person has the machine.
[[nodiscard]] bool waits_for_tool(const drivers::DriverStatus& status);

/// For the settings of the window, one line, and back; nothing: it is none.
[[nodiscard]] std::string to_text(const ToolChangeSettings& settings);
[[nodiscard]] std::optional<ToolChangeSettings> tool_changes_of(std::string_view text);

} // namespace millwright::actions
