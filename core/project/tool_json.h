// A tool as JSON: in a project and in a tool file alike.
#pragma once

#include "core/base/json.h"
#include "core/project/tool_input.h"

#include <nlohmann/json_fwd.hpp>

namespace millwright::project {

/// Throws Error with the place of what is wrong.
[[nodiscard]] ToolInput tool_from(const JsonValue& value);
[[nodiscard]] nlohmann::ordered_json json_of(const ToolInput& tool);

} // namespace millwright::project
