// What the numbers of a tool say about themselves (settings.h), and the tool that they describe.
#pragma once

#include "core/project/settings.h"
#include "core/project/tool_input.h"
#include "core/toolpath/tool.h"

#include <string>

namespace millwright::project {

[[nodiscard]] std::span<const NumberSetting<ToolInput>> tool_numbers();
[[nodiscard]] std::span<const Choice<toolpath::CutterKind>> cutter_kinds();

/// Whether a cutter of that kind has the number called `id`; lead and tilt all have.
[[nodiscard]] bool has_number(toolpath::CutterKind kind, std::string_view id);

/// What is wrong with the shapes of cutter and holder as a sentence; empty if nothing is.
[[nodiscard]] std::string fault_of(const ToolInput& input);

/// Throws Error with fault_of(input) if there is one.
[[nodiscard]] toolpath::Tool tool_of(const ToolInput& input);

/// In one line for people: "ball, diameter 6 mm, length 40 mm, lead 10 deg".
[[nodiscard]] std::string tool_text(const ToolInput& input);

} // namespace millwright::project
