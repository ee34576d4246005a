// Tool files: a cutting tool in a file of its own, so that several projects can use it. JSON:
// docs/reference/cutter.md.
#pragma once

#include "core/project/tool_input.h"

#include <filesystem>
#include <string>

namespace millwright::project {

/// Throws Error with file, line and field for anything wrong in it.
[[nodiscard]] ToolInput read_tool(const std::filesystem::path& file);

/// The text of a tool file. Throws Error if the tool has a fault.
[[nodiscard]] std::string tool_file_text(const ToolInput& tool);

} // namespace millwright::project
