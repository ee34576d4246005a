// The options --tool-change, --tool-sensor, --spin-up and --right-tool.
#pragma once

#include "core/drivers/tool_change.h"

#include <optional>

namespace CLI {
class App;
}

namespace millwright::app {

struct ControllerChoice;

/// Adds them to `command`; `choice` must outlive it.
void add_tool_change_options(CLI::App& command, ControllerChoice& choice);

/// How the tool changes of a job are made here; nothing: they are left to the controller. Throws UsageError
/// for what does not fit together, Error for a file that cannot be read.
[[nodiscard]] std::optional<drivers::ToolChangePlan> tool_change_plan(const ControllerChoice& choice);

} // namespace millwright::app
