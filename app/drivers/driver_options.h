// Which options belong to which driver: one that a driver does not have would be taken and do nothing.
// And the options about tool changes.
#pragma once

#include "core/drivers/tool_change.h"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace millwright::app {

/// Throws UsageError for an option that was given and that `driver` does not have.
void expect_options_of_driver(const CLI::App& command, const std::string& driver);

/// The options --tool-change, --tool-sensor, --spin-up and --right-tool.
struct ToolChangeChoice {
    std::string way;            ///< stop, probe or macro=FILE; empty: left to the controller
    std::vector<double> sensor; ///< X, Y, height for travelling, deepest Z, and perhaps the feed
    double spin_up = 3.0;       ///< s, after a tool change
    bool right_tool = false;    ///< a person has looked: the spindle has the tool that the first line needs
};

/// Adds them to `command`; `choice` must outlive it.
void add_tool_change_options(CLI::App& command, ToolChangeChoice& choice);

/// How the tool changes of a job are made here; nothing: they are left to the controller. Throws UsageError
/// for what does not fit together, Error for a file that cannot be read.
[[nodiscard]] std::optional<drivers::ToolChangePlan> tool_change_plan(const ToolChangeChoice& choice);

} // namespace millwright::app
