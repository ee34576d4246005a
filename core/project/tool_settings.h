// What the numbers of a tool say about themselves (setting_tables.h), and the tool that they describe.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/program/program.h"
#include "core/project/setting_tables.h"
#include "core/project/tool_input.h"
#include "core/toolpath/tool.h"

#include <optional>
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

/// From the spindle's gauge line to the tip, to a micrometre: as it was entered, else cutter and holder
/// together. Nullopt of a point without an entered one: the machine file's own tool is taken.
[[nodiscard]] std::optional<double> gauge_length_mm(const ToolInput& input);

/// The machine with the tool in its spindle. Throws Error if the head swings and no file gives the length of
/// its own tool.
[[nodiscard]] kinematics::MachineModel machine_with(const ToolInput& tool,
                                                    const kinematics::MachineModel& machine);

/// What the program calls on `machine`, which has the tool. Nullopt for number 0, and for a point, which is
/// no tool, without a gauge length.
[[nodiscard]] std::optional<program::ProgramTool> program_tool(const ToolInput& input,
                                                               const kinematics::MachineModel& machine);

/// What its comment says of the tool. Nullopt of a point.
[[nodiscard]] std::optional<program::ProgramCutter> program_cutter(const ToolInput& input);

/// Which length the program was made for, in one line for people.
[[nodiscard]] std::string tool_length_text(const ToolInput& input, const kinematics::MachineModel& machine);

/// In one line for people: "ball, diameter 6 mm, length 40 mm, lead 10 deg".
[[nodiscard]] std::string tool_text(const ToolInput& input);

} // namespace millwright::project
